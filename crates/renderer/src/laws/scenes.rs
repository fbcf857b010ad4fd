//! Small scenes, and estimates with error bars.

use etendue_brdf::fresnel::Dispersion;
use etendue_brdf::{Distribution, Ior, Masking};
use etendue_math::glam::DVec3;
use etendue_math::{Real, Spectrum};
use etendue_scene::camera::{Camera, FieldOfView, FovAxis, Projection};
use etendue_scene::film::{Film, ReconstructionFilter};
use etendue_scene::geometry::{GeometryBuilder, Motion, Rectangle, Shape, Sphere, Transform};
use etendue_scene::light::{AreaLight, ConstantLight, Light, LightId};
use etendue_scene::material::{
    ConductorIndex, Material, MaterialId, Materials, RelativeDispersion, Roughness,
};
use etendue_scene::medium::{Boundary, Media, Medium, MediumId};
use etendue_scene::scene::{PathSettings, SamplerKind, SamplingSettings, SceneParts, SurfaceInfo};
use etendue_scene::texture::Textures;
use etendue_scene::{Color, Scene};

use crate::{Airlight, RenderSettings, Renderer, Strategy};

/// A scene under construction.
#[derive(Default)]
pub(super) struct Sketch {
    geometry: GeometryBuilder,
    surfaces: Vec<SurfaceInfo>,
    materials: Materials,
    pub(super) textures: Textures,
    lights: Vec<Light>,
    pub(super) media: Media,
}

impl Sketch {
    pub(super) fn grey(&mut self, albedo: f32) -> MaterialId {
        let reflectance = self.textures.constant(Color::splat(albedo));
        self.material(Material::Diffuse { reflectance })
    }

    pub(super) fn material(&mut self, material: Material) -> MaterialId {
        self.materials.add(material).expect("textures and materials exist")
    }

    /// Smooth glass of index 1.5.
    pub(super) fn glass(&mut self) -> MaterialId {
        let interface = self.interface(None, None);
        self.material(interface)
    }

    /// Glass of index 1.5, or one that depends on the wavelength; rough by GGX facets of width `alpha`.
    pub(super) fn interface(
        &mut self,
        dispersion: Option<Dispersion>,
        alpha: Option<f32>,
    ) -> Material {
        let white = self.textures.constant(Color::white());
        let relative = |interior| Box::new(RelativeDispersion { interior, exterior: 1.0 });
        Material::Dielectric {
            eta: Ior::new(1.5).expect("an index"),
            dispersion: dispersion.map(relative),
            nesting: None,
            roughness: alpha.map(|alpha| self.facets(alpha)),
            specular_reflectance: white,
            specular_transmittance: white,
        }
    }

    /// GGX facets.
    fn facets(&mut self, alpha: f32) -> Roughness {
        let alpha = self.textures.constant(Color::splat(alpha));
        Roughness {
            distribution: Distribution::Ggx,
            masking: Masking::HeightCorrelated,
            alpha_u: alpha,
            alpha_v: alpha,
        }
    }

    /// GGX facets of width `alpha`, each of which reflects everything.
    pub(super) fn rough_mirror(&mut self, alpha: f32) -> MaterialId {
        let white = self.textures.constant(Color::white());
        let roughness = self.facets(alpha);
        self.material(Material::Conductor {
            index: ConductorIndex::Mirror,
            roughness: Some(roughness),
            specular_reflectance: white,
        })
    }

    pub(super) fn shape(&mut self, shape: Shape, material: MaterialId) {
        self.geometry.add_shape(shape);
        self.surface(material);
    }

    pub(super) fn moving(&mut self, shape: Shape, material: MaterialId, motion: Motion) {
        self.geometry.add_moving_shape(shape, motion);
        self.surface(material);
    }

    fn surface(&mut self, material: MaterialId) {
        self.surfaces.push(SurfaceInfo {
            material,
            light: None,
            boundary: None,
            name: String::new(),
        });
    }

    pub(super) fn medium(&mut self, medium: Medium) -> MediumId {
        self.media.list.push(medium);
        MediumId(self.media.list.len() as u32 - 1)
    }

    /// A shape with a medium inside, and empty space outside.
    pub(super) fn filled(&mut self, shape: Shape, material: MaterialId, interior: MediumId) {
        self.shape(shape, material);
        self.fill(interior);
    }

    /// A medium inside the last shape, and empty space outside.
    pub(super) fn fill(&mut self, interior: MediumId) {
        let boundary = Boundary { interior: Some(interior), exterior: None };
        self.surfaces.last_mut().expect("a shape").boundary = Some(boundary);
    }

    pub(super) fn emitter(&mut self, shape: Shape, material: MaterialId, radiance: f32) {
        let radiance = self.textures.constant(Color::splat(radiance));
        let shape = self.geometry.add_shape(shape);
        let light = Some(LightId(self.lights.len() as u32));
        self.lights.push(Light::Area(AreaLight { shape, radiance }));
        self.surfaces.push(SurfaceInfo { material, light, boundary: None, name: String::new() });
    }

    pub(super) fn light(&mut self, light: Light) {
        self.lights.push(light);
    }

    pub(super) fn sky(&mut self, radiance: f32) {
        self.light(Light::Constant(ConstantLight { radiance: Color::splat(radiance) }));
    }

    /// Seen from `eye` towards `target`, `degrees` wide, by a film of box-filtered pixels.
    pub(super) fn seen(self, eye: DVec3, target: DVec3, degrees: f64, size: [u32; 2]) -> Scene {
        let up = if (target - eye).x.abs() < 1e-9 { DVec3::X } else { DVec3::Z };
        let to_world = Transform::look_at(eye, target, up).expect("a regular view");
        let field_of_view = FieldOfView::Angle { degrees, axis: FovAxis::X };
        let projection =
            Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
        let film = Film { filter: ReconstructionFilter::Box { radius: 0.5 }, ..Film::new(size) };
        Scene::new(SceneParts {
            geometry: self.geometry.build(),
            surfaces: self.surfaces,
            materials: self.materials,
            textures: self.textures,
            lights: self.lights,
            media: self.media,
            camera: Camera::new(projection, to_world, 1e-3, 1e4, size).expect("a camera"),
            film,
            sampling: SamplingSettings::default(),
            path: PathSettings::default(),
        })
        .expect("parts that fit together")
    }

    /// One pixel that sees one point.
    pub(super) fn point_seen(self, eye: DVec3, target: DVec3) -> Scene {
        self.seen(eye, target, 1e-3, [1, 1])
    }
}

/// A sphere on a floor under a lamp.
pub(super) fn lamp_over_sphere(size: [u32; 2]) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.7), sketch.grey(0.0));
    sketch.shape(rectangle(DVec3::ZERO, [4.0, 4.0], DVec3::Z), grey);
    sketch.shape(sphere(DVec3::new(0.0, 0.0, 0.7), 0.7), grey);
    sketch.emitter(rectangle(DVec3::new(1.0, 1.0, 3.0), [0.5, 0.5], -DVec3::Z), black, 10.0);
    sketch.sky(0.3);
    sketch.seen(DVec3::new(0.0, -4.0, 2.0), DVec3::ZERO, 50.0, size)
}

/// A sphere whose front is outside.
pub(super) fn sphere(centre: DVec3, radius: f64) -> Shape {
    Shape::Sphere(Sphere::new(centre, radius, &Transform::IDENTITY).expect("a sphere"))
}

/// A rectangle of half width and height `half`, centred on `centre`, that faces `towards`.
pub(super) fn rectangle(centre: DVec3, half: [f64; 2], towards: DVec3) -> Shape {
    let up = if towards.x.abs() < 1e-9 { DVec3::X } else { DVec3::Z };
    let place = Transform::look_at(centre, centre + towards, up).expect("a direction");
    let scale = Transform::scale(DVec3::new(half[0], half[1], 1.0)).expect("a size");
    let transform = place.compose(&scale).expect("a transform");
    Shape::Rectangle(Rectangle::new(&transform).expect("a rectangle"))
}

/// Independent samples on one thread.
pub(super) fn settings(max_depth: Option<u32>, strategy: Strategy) -> RenderSettings {
    RenderSettings {
        threads: 1,
        samples_per_pixel: 1,
        seed: 1,
        sampler: SamplerKind::Independent,
        path: PathSettings { max_depth, ..PathSettings::default() },
        strategy,
        airlight: Airlight::default(),
    }
}

/// A mean and its standard error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimate {
    pub(super) mean: f64,
    pub(super) error: f64,
}

/// The mean red channel of the first pixel.
pub(super) fn estimate(scene: &Scene, settings: RenderSettings, samples: u32) -> Estimate {
    let renderer = Renderer::new(scene, settings).expect("one thread");
    let (mut sum, mut squares) = (0.0_f64, 0.0_f64);
    for i in 0..u64::from(samples) {
        let x = f64::from(renderer.sample([0, 0], i).r);
        sum += x;
        squares += x * x;
    }
    let n = f64::from(samples);
    let mean = sum / n;
    Estimate { mean, error: (squares / n - mean * mean).safe_sqrt() / Real::sqrt(n) }
}

impl Estimate {
    /// Fixed seeds make each test a single draw: 4 standard errors, and 10⁻⁵ for rounding of
    /// estimates without noise.
    pub(super) fn assert_is(&self, expected: f64) {
        let allowed = 4.0 * self.error + 1e-5 * expected.abs();
        assert!((self.mean - expected).abs() <= allowed, "{self:?}, expected {expected}");
        assert!(self.error <= 0.02 * expected.abs(), "too noisy to tell: {self:?}");
    }
}

/// A scene whose skies have finite light, the sum of which is not: no scene with such lights is made, so they are put in afterwards.
pub(super) fn with_skies_that_overflow(mut scene: Scene) -> Scene {
    for light in &mut scene.lights {
        *light = Light::Constant(ConstantLight { radiance: Color::splat(3e38) });
    }
    scene
}
