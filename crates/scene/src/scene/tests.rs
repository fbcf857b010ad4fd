use super::*;
use crate::Color;
use crate::camera::{FieldOfView, FovAxis, Projection};
use crate::color::Primaries;
use crate::geometry::{
    Animation, GeometryBuilder, Placement, Ray, Rectangle, Shape, ShapeId, Shutter, Sphere,
    Transform, TriangleMesh,
};
use crate::light::{
    AreaLight, ConstantLight, DirectionalLight, EnvironmentLight, LightError, LightSample,
    PointLight, ProjectorLight, SpotLight,
};
use crate::material::Material;
use crate::texture::{
    AttributeTexture, Bitmap, BitmapImage, Checkerboard, Filter, Texture, TextureId, UvTransform,
    Wrap,
};
use alloc::vec;
use etendue_brdf::{Bsdf, Density};
use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Spectrum};

fn camera() -> Camera {
    let field_of_view = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
    let projection = Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
    Camera::new(projection, Transform::IDENTITY, 0.1, 10.0, [4, 3]).expect("a valid camera")
}

fn parts() -> SceneParts {
    SceneParts {
        geometry: GeometryBuilder::new().build(),
        surfaces: vec![],
        materials: Materials::default(),
        textures: Textures::default(),
        lights: vec![],
        media: Media::default(),
        camera: camera(),
        film: Film::new([4, 3]),
        sampling: SamplingSettings::default(),
        path: PathSettings::default(),
    }
}

/// A grey floor in the plane z = 0, and above it a shape that emits downwards.
fn lit_by(shape: Shape, radiance: impl FnOnce(&mut Textures) -> TextureId) -> Scene {
    let mut parts = parts();
    let radiance = radiance(&mut parts.textures);
    let reflectance = parts.textures.constant(Color::new(0.5, 0.5, 0.5));
    let grey = parts.materials.add(Material::Diffuse { reflectance }).expect("a simple material");
    let mut builder = GeometryBuilder::new();
    let wide = Transform::scale(DVec3::splat(10.0)).expect("a scaling");
    builder.add_shape(Shape::Rectangle(Rectangle::new(&wide).expect("a floor")));
    let emitter = builder.add_shape(shape);
    parts.geometry = builder.build();
    let surface = |light, name: &str| SurfaceInfo {
        material: grey,
        light,
        boundary: None,
        name: name.into(),
    };
    parts.surfaces = vec![surface(None, "floor"), surface(Some(LightId(0)), "emitter")];
    parts.lights = vec![Light::Area(AreaLight { shape: emitter, radiance })];
    Scene::new(parts).expect("a scene")
}

fn white(textures: &mut Textures) -> TextureId {
    textures.constant(Color::new(1.0, 1.0, 1.0))
}

/// A point of the floor.
fn floor(scene: &Scene) -> SurfacePoint {
    let ray = Ray::new(Vec3::new(0.3, -0.2, 0.1), -Vec3::Z);
    let hit = scene.geometry.intersect(&ray).expect("the floor is below");
    scene.geometry.surface_point(&ray, &hit)
}

fn uniforms(n: u16) -> impl Iterator<Item = [f32; 2]> {
    let at = move |i| (f32::from(i) + 0.5) / f32::from(n);
    (0..n).flat_map(move |i| (0..n).map(move |j| [at(i), at(j)]))
}

/// Facing down at height 2: 2 wide along x, 4 along y.
fn ceiling() -> Rectangle {
    let up = Transform::translate(DVec3::new(0.0, 0.0, 2.0)).expect("a translation");
    let turn = Transform::rotate(DVec3::X, 180.0).expect("a rotation");
    let size = Transform::scale(DVec3::new(1.0, 2.0, 1.0)).expect("a scaling");
    let placed = up.compose(&turn).and_then(|m| m.compose(&size)).expect("a regular map");
    Rectangle::new(&placed).expect("a rectangle")
}

/// The same in two triangles.
fn ceiling_mesh() -> TriangleMesh {
    let corner = |x, y| Vec3::new(x, y, 2.0);
    let corners = vec![corner(-1.0, -2.0), corner(-1.0, 2.0), corner(1.0, 2.0), corner(1.0, -2.0)];
    TriangleMesh::new(corners, vec![], vec![], vec![[0, 1, 2], [0, 2, 3]]).expect("two triangles")
}

fn sphere() -> Sphere {
    Sphere::new(DVec3::new(0.5, 0.0, 2.0), 0.75, &Transform::IDENTITY).expect("a sphere")
}

/// Solid angle of the ceiling seen from (0.3, −0.2, 0), by the corners' arctangents.
fn ceiling_solid_angle() -> f64 {
    let corner = |x: f64, y: f64| Real::atan(x * y / (2.0 * (x * x + y * y + 4.0).sqrt()));
    corner(0.7, 2.2) + corner(1.3, 2.2) + corner(0.7, 1.8) + corner(1.3, 1.8)
}

/// The mean over samples of 1/p, a primitive at a time.
fn sampled_solid_angle(scene: &Scene, primitives: u32) -> f64 {
    let point = floor(scene);
    let n = 64;
    let inverse = |primitive, u| match scene.sample_light(
        LightId(0),
        primitive,
        point.position,
        u,
        Primaries,
    ) {
        Some(LightSample { density: Density::Continuous(pdf), .. }) => 1.0 / f64::from(pdf),
        _ => 0.0,
    };
    let sum = |primitive| uniforms(n).map(|u| inverse(primitive, u)).sum::<f64>();
    (0..primitives).map(sum).sum::<f64>() / f64::from(n * n)
}

#[test]
fn area_lights_are_sampled_over_their_solid_angle() {
    // The midpoint rule on a smooth density; the fold of a triangle's map costs a little more.
    let rectangle = sampled_solid_angle(&lit_by(Shape::Rectangle(ceiling()), white), 1);
    assert!((rectangle / ceiling_solid_angle() - 1.0).abs() < 1e-4, "{rectangle}");
    let mesh = sampled_solid_angle(&lit_by(Shape::Mesh(ceiling_mesh()), white), 2);
    assert!((mesh / ceiling_solid_angle() - 1.0).abs() < 1e-3, "{mesh}");
    // A cone of sine r/d, sampled evenly.
    let sampled = sampled_solid_angle(&lit_by(Shape::Sphere(sphere()), white), 1);
    let squared_sine = 0.75 * 0.75 / (0.2 * 0.2 + 0.2 * 0.2 + 4.0_f64);
    let cone = 2.0 * f64::PI * (1.0 - Real::sqrt(1.0 - squared_sine));
    assert!((sampled / cone - 1.0).abs() < 1e-5, "{sampled} {cone}");
}

#[test]
fn a_sampled_point_is_seen_and_has_the_radiance_and_density_of_the_hit() {
    let textured = |textures: &mut Textures| {
        let image = BitmapImage::from_f32(2, 2, 1, &[1.0, 2.0, 3.0, 4.0]).expect("four texels");
        let uv = UvTransform::IDENTITY;
        textures.add(Texture::Bitmap(Bitmap::new(image, Filter::Bilinear, Wrap::Clamp, uv)))
    };
    for (shape, primitives) in [
        (Shape::Rectangle(ceiling()), 1),
        (Shape::Mesh(ceiling_mesh()), 2),
        (Shape::Sphere(sphere()), 1),
    ] {
        let scene = lit_by(shape, textured);
        let point = floor(&scene);
        for (primitive, u) in (0..primitives).flat_map(|i| uniforms(20).map(move |u| (i, u))) {
            let sample = scene
                .sample_light(LightId(0), primitive, point.position, u, Primaries)
                .expect("it is lit");
            let target = sample.target.expect("an area light has a place");
            assert!(!scene.geometry.occluded(&point.spawn_to(target)), "{u:?}");
            let ray = point.spawn(sample.direction);
            let hit = scene.geometry.intersect(&ray).expect("the light is in the way");
            let hit = scene.geometry.surface_point(&ray, &hit);
            let (light, radiance) =
                scene.emitted(&hit, -sample.direction, Primaries).expect("its front");
            assert_eq!(light, LightId(0));
            // Directions of unit length, 1e-7 off, at distances of 2; the texture's slope is 4, and
            // a grazing hit of the sphere is 1/√(2·10⁻⁷) less precise.
            assert!((radiance.r - sample.radiance.r).abs() < 2e-3, "{radiance:?} {sample:?}");
            let Density::Continuous(pdf) = sample.density else { panic!("no delta light") };
            let again = scene.light_pdf_hit(LightId(0), point.position, &hit);
            assert!((again / pdf - 1.0).abs() < 1e-4, "{again} {pdf}");
        }
    }
}

#[test]
fn area_lights_emit_on_their_front_only() {
    let scene = lit_by(Shape::Rectangle(ceiling().flipped()), white);
    assert_eq!(
        scene.sample_light(LightId(0), 0, floor(&scene).position, [0.5; 2], Primaries),
        None
    );
    let ray = floor(&scene).spawn(Vec3::Z);
    let hit = scene.geometry.intersect(&ray).expect("the light is above");
    let back = scene.geometry.surface_point(&ray, &hit);
    assert_eq!(scene.emitted(&back, -Vec3::Z, Primaries), None);
    assert_eq!(
        scene.emitted(&back, Vec3::Z, Primaries),
        Some((LightId(0), Color::new(1.0, 1.0, 1.0)))
    );
    assert_eq!(scene.emitted(&floor(&scene), Vec3::Z, Primaries), None);
}

#[test]
fn bounds_and_power_are_those_of_the_primitives() {
    let scene = lit_by(Shape::Mesh(ceiling_mesh()), white);
    let lights = scene.finite_lights();
    assert_eq!(
        lights.iter().map(|l| (l.0, l.1)).collect::<Vec<_>>(),
        [(LightId(0), 0), (LightId(0), 1)]
    );
    for (_, _, bounds) in &lights {
        assert_eq!((bounds.axis, bounds.cos_theta_o, bounds.cos_theta_e), (-Vec3::Z, 1.0, 0.0));
        assert_eq!((bounds.bounds.min.z, bounds.bounds.max.x), (2.0, 1.0));
        // π A L with A = 4, to the rounding of luminance.
        assert!((bounds.power / (4.0 * f32::PI) - 1.0).abs() < 1e-6);
    }
    assert!((scene.light_power(LightId(0)) / (8.0 * f32::PI) - 1.0).abs() < 1e-6);
    let sphere = lit_by(Shape::Sphere(sphere()), white).finite_lights();
    assert_eq!(sphere.iter().map(|l| l.2.cos_theta_o).collect::<Vec<_>>(), [-1.0]);
    let dark = lit_by(Shape::Mesh(ceiling_mesh()), |t| t.constant(Color::black()));
    assert!(dark.finite_lights().is_empty());
}

#[test]
fn lights_without_surface_have_the_textbook_irradiance() {
    let mut parts = parts();
    let two = Color::new(2.0, 2.0, 2.0);
    let above = Transform::look_at(DVec3::Z * 2.0, DVec3::ZERO, DVec3::Y).expect("a view");
    let map = BitmapImage::from_f32(2, 2, 1, &[0.5; 4]).expect("four texels");
    let map = EnvironmentLight::new(map, Transform::IDENTITY, 1.0).expect("a map");
    parts.lights = vec![
        Light::Point(PointLight { position: Vec3::new(0.0, 0.0, 2.0), intensity: two }),
        Light::Spot(SpotLight::new(above, two, None, 20.0, 10.0).expect("a spot light")),
        Light::Directional(DirectionalLight { direction: Vec3::Z * -7.0, irradiance: two }),
        Light::Constant(ConstantLight { radiance: two }),
        Light::Environment(map),
    ];
    let picture = parts.textures.constant(two);
    let view = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
    let projector = ProjectorLight::new(above, picture, 1.0, view, [1, 1]);
    parts.lights.push(Light::Projector(projector.expect("a projector")));
    let scene = Scene::new(parts).expect("a scene without shapes");
    let lit = lit_by(Shape::Rectangle(ceiling()), white);
    let origin = SurfacePoint { position: Vec3::ZERO, ..floor(&lit) };
    let sample =
        |light| scene.sample_light(LightId(light), 0, origin.position, [0.3, 0.4], Primaries);
    for light in [0, 1] {
        let sample = sample(light).expect("it is lit");
        assert_eq!((sample.direction, sample.target), (Vec3::Z, Some(Vec3::Z * 2.0)));
        assert_eq!((sample.radiance.r, sample.density), (0.5, Density::Delta(1.0)));
    }
    let picture = sample(5).expect("it is lit");
    assert_eq!((picture.direction, picture.target), (Vec3::Z, Some(Vec3::Z * 2.0)));
    assert_eq!((picture.radiance.r, picture.density), (0.5 * f32::PI, Density::Delta(1.0)));
    let sun = sample(2).expect("it is lit");
    assert_eq!((sun.direction, sun.target, sun.radiance), (Vec3::Z, None, two));
    let sky = sample(3).expect("it is lit");
    assert_eq!(sky.density, Density::Continuous(scene.escaped(LightId(3), Vec3::X).1));
    assert_eq!(scene.background(sky.direction).r, 2.5);
    assert_eq!(scene.infinite_lights(), [LightId(2), LightId(3), LightId(4)]);
    assert_eq!(scene.finite_lights().len(), 3);
    assert_eq!(scene.escaped(LightId(2), Vec3::Z), (Color::black(), 0.0));
    assert_eq!(sample(9), None);
}

#[test]
fn a_scene_without_anything_works() {
    let scene = Scene::new(parts()).expect("an empty scene");
    assert_eq!(scene.background(Vec3::X), Color::black());
    assert!(scene.finite_lights().is_empty() && scene.infinite_lights().is_empty());
    assert_eq!(scene.light_power(LightId(0)), 0.0);
}

#[test]
fn parts_that_do_not_fit_are_refused() {
    let refused = |change: &dyn Fn(&mut SceneParts)| {
        let mut parts = parts();
        change(&mut parts);
        Scene::new(parts).err()
    };
    let info =
        SurfaceInfo { material: MaterialId(0), light: None, boundary: None, name: "lonely".into() };
    assert_eq!(
        refused(&|p| p.surfaces.push(info.clone())),
        Some(InvalidScene::SurfaceCount { surfaces: 1, shapes: 0 })
    );
    let area = AreaLight { shape: ShapeId(3), radiance: TextureId(0) };
    let area = Light::Area(area);
    assert_eq!(refused(&|p| p.lights.push(area.clone())), Some(InvalidScene::AreaLight(3)));
    let moving = |p: &mut SceneParts| {
        let (start, end) = (Transform::IDENTITY, Transform::translate(DVec3::X).expect("a shift"));
        let animation = Animation::new(vec![(0.0, start), (1.0, end)]).expect("keyframes");
        let exposure = Shutter::new(0.0, 1.0).expect("a shutter");
        let Placement::Moving(motion) = animation.during(exposure) else { panic!() };
        let mut builder = GeometryBuilder::new();
        let shape = builder.add_moving_shape(Shape::Sphere(sphere()), motion);
        p.geometry = builder.build();
        let radiance = white(&mut p.textures);
        let reflectance = p.textures.constant(Color::black());
        p.materials.add(Material::Diffuse { reflectance }).expect("a simple material");
        p.surfaces.push(SurfaceInfo { light: Some(LightId(0)), ..info.clone() });
        p.lights.push(Light::Area(AreaLight { shape, radiance }));
    };
    assert_eq!(refused(&moving), Some(InvalidScene::MovingLight(0)));
    let dark = DirectionalLight { direction: Vec3::ZERO, irradiance: Color::black() };
    assert_eq!(
        refused(&|p| p.lights.push(Light::Directional(dark))),
        Some(InvalidScene::Light { light: 0, error: LightError::Direction })
    );
    let nan = ConstantLight { radiance: Color::new(f32::NAN, 0.0, 0.0) };
    assert_eq!(
        refused(&|p| p.lights.push(Light::Constant(nan))),
        Some(InvalidScene::Light { light: 0, error: LightError::Emission })
    );
    let attribute = |p: &mut SceneParts| {
        let mesh = AttributeTexture { name: "vertex_color".into(), scale: 1.0 };
        let texture = Some(p.textures.add(Texture::Attribute(mesh)));
        let white = Color::new(1.0, 1.0, 1.0);
        let spot = SpotLight::new(Transform::IDENTITY, white, texture, 20.0, 10.0);
        p.lights.push(Light::Spot(spot.expect("a spot light")));
    };
    assert_eq!(refused(&attribute), Some(InvalidScene::NeedsSurface(0)));
    assert_eq!(refused(&|p| p.film.crop.size = [5, 1]), Some(InvalidScene::Crop));
}

#[test]
fn a_material_is_looked_up_where_the_surface_is_hit() {
    let mut scene = lit_by(Shape::Rectangle(ceiling()), white);
    let color0 = scene.textures.constant(Color::new(0.25, 0.25, 0.25));
    let color1 = scene.textures.constant(Color::new(0.75, 0.75, 0.75));
    let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
    let reflectance = scene.textures.add(Texture::Checkerboard(board));
    let material = scene.materials.add(Material::Diffuse { reflectance });
    scene.surfaces[0].material = material.expect("a simple material");
    let point = floor(&scene);
    for (uv, albedo) in [([0.1, 0.1], 0.25), ([0.6, 0.1], 0.75)] {
        let surface = scene.locate(SurfacePoint { uv, ..point });
        let bsdf = scene.prepare(&surface, Side::Front);
        assert_eq!(bsdf.albedo(Vec3::Z), Some(Color::new(albedo, albedo, albedo)));
    }
}
