use super::*;
use crate::Color;
use crate::color::Primaries;
use crate::texture::Textures;
use etendue_brdf::{BeckmannLambda, Bsdf, Density};
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum, hash_u32};

struct Studio {
    textures: Textures,
    materials: Materials,
}

impl Studio {
    fn new() -> Self {
        Self { textures: Textures::default(), materials: Materials::default() }
    }

    fn grey(&mut self, x: f32) -> TextureId {
        self.textures.constant(Color::splat(x))
    }

    fn add(&mut self, material: Material) -> MaterialId {
        self.materials.add(material).expect("a valid material")
    }

    fn diffuse(&mut self, albedo: f32) -> MaterialId {
        let reflectance = self.grey(albedo);
        self.add(Material::Diffuse { reflectance })
    }

    /// The model looked at from `wo`.
    fn at(&self, id: MaterialId, wo: Vec3) -> PreparedBsdf<'_> {
        self.materials.prepare(id, &self.textures, [0.5; 2].into(), Side::of(wo), Primaries)
    }
}

const UP: Vec3 = Vec3::new(0.6, 0.0, 0.8);
const DOWN: Vec3 = Vec3::new(0.6, 0.0, -0.8);

/// One material of every kind.
fn every_kind(s: &mut Studio) -> Vec<MaterialId> {
    let (white, half, tenth) = (s.grey(1.0), s.grey(0.5), s.grey(0.1));
    let eta = Ior::new(1.5).expect("an index");
    let index = ConductorIndex::Complex { eta: tenth, k: white };
    let beckmann = Distribution::Beckmann { lambda: BeckmannLambda::Walter };
    let rough = |distribution| Roughness {
        distribution,
        masking: Masking::Separable,
        alpha_u: tenth,
        alpha_v: half,
    };
    let plastic = |surface| Material::Plastic {
        surface,
        diffuse_reflectance: half,
        specular_reflectance: white,
        scattering: InternalScattering::NonLinear,
    };
    let internal = InternalReflectance::Mitsuba;
    let alpha = Alpha::clamped(0.2);
    let rough_surface = PlasticSurface::rough(eta, beckmann, alpha, Masking::Separable, internal);
    let dielectric = |roughness| Material::Dielectric {
        eta,
        dispersion: None,
        nesting: None,
        roughness,
        specular_reflectance: white,
        specular_transmittance: half,
    };
    let conductor =
        |roughness| Material::Conductor { index, roughness, specular_reflectance: half };
    let rough_diffuse = |form| Material::RoughDiffuse { reflectance: half, sigma: half, form };
    let mut all = Vec::from([s.diffuse(0.5)]);
    for material in [
        rough_diffuse(OrenNayarForm::Full),
        rough_diffuse(OrenNayarForm::Qualitative),
        conductor(None),
        conductor(Some(rough(Distribution::Ggx))),
        plastic(PlasticSurface::smooth(eta, internal)),
        plastic(rough_surface),
    ] {
        let id = s.add(material);
        all.push(id);
        let two_sided = s.add(Material::TwoSided { front: id, back: all[0] });
        all.push(two_sided);
        all.push(s.add(Material::Mask { opacity: half, nested: two_sided }));
    }
    let principled = |spec_trans| {
        Material::Principled(Box::new(PrincipledTextures {
            base_color: half,
            roughness: half,
            anisotropic: tenth,
            metallic: tenth,
            spec_trans,
            eta,
            spec_tint: half,
            sheen: half,
            sheen_tint: tenth,
            flatness: half,
            clearcoat: half,
            clearcoat_gloss: half,
            sampling_rates: [1.0; 3],
        }))
    };
    let thin = PrincipledThinTextures {
        base_color: half,
        roughness: half,
        anisotropic: tenth,
        spec_trans: Some(half),
        eta: white,
        spec_tint: half,
        sheen: half,
        sheen_tint: tenth,
        flatness: half,
        diff_trans: half,
        sampling_rates: [1.0; 4],
    };
    for material in [
        principled(None),
        principled(Some(half)),
        Material::PrincipledThin(Box::new(thin)),
        dielectric(None),
        dielectric(Some(rough(beckmann))),
        Material::ThinDielectric { eta, specular_reflectance: half, specular_transmittance: white },
        Material::Null,
    ] {
        all.push(s.add(material));
    }
    made_of(s, &mut all);
    all
}

/// Adds materials made of those that are there.
fn made_of(s: &mut Studio, all: &mut Vec<MaterialId>) {
    let (quarter, glossy, glass) = (s.grey(0.25), all[7], all[all.len() - 4]);
    let half = s.grey(0.5);
    let normal = s.textures.constant(Color::new(0.7, 0.4, 0.9));
    for nested in [all[0], glossy, glass] {
        let blend = s.add(Material::Blend { weight: quarter, parts: [nested, all[1]] });
        let options = Perturbation::default();
        all.push(blend);
        all.push(s.add(Material::NormalMap { normal, options, nested: blend }));
        all.push(s.add(Material::Mask { opacity: half, nested: blend }));
    }
    let two_sided = s.add(Material::TwoSided { front: all[0], back: all[1] });
    all.push(s.add(Material::Blend { weight: half, parts: [two_sided, all[0]] }));
    all.push(s.add(Material::NormalMap {
        normal,
        options: Perturbation { flip_invalid_normals: false, use_shadowing_function: true },
        nested: two_sided,
    }));
}

#[test]
fn every_kind_of_material_samples_what_it_evaluates() {
    let mut s = Studio::new();
    for id in every_kind(&mut s) {
        for (wo, i) in [UP, DOWN].into_iter().flat_map(|wo| (0..32_u8).map(move |i| (wo, i))) {
            let bsdf = s.at(id, wo);
            let x = (f32::from(i) + 0.5) / 32.0;
            let u = [x, (f32::from(i) * 0.618).fract()];
            let Some(sample) = bsdf.sample(wo, x, u) else { continue };
            let Density::Continuous(pdf) = sample.density else { continue };
            let (value, density) = bsdf.eval_pdf(wo, sample.wi);
            assert_eq!(value, bsdf.eval(wo, sample.wi));
            assert_eq!(density, bsdf.pdf(wo, sample.wi));
            let expected = value.scale(sample.wi.z.abs() / density);
            // Facets of width 0.1 amplify the rounding of a direction, 1e-7, by 1/α² and more
            // towards grazing angles.
            let close = |a: f32, b: f32| (a - b).abs() <= 1e-3 * b.abs();
            assert!(close(pdf, density), "{:?} {pdf} {density}", s.materials.get(id));
            assert!(close(sample.weight.g, expected.g), "{:?}", s.materials.get(id));
        }
    }
}

#[test]
fn two_sided_materials_have_a_back_and_others_are_black_there() {
    let mut s = Studio::new();
    let (light, dark) = (s.diffuse(0.8), s.diffuse(0.2));
    let both = s.add(Material::TwoSided { front: light, back: dark });
    let same = s.add(Material::TwoSided { front: light, back: light });
    let albedo = |s: &Studio, id, wo| s.at(id, wo).albedo(wo).map(|c| c.r);
    assert_eq!([albedo(&s, both, UP), albedo(&s, both, DOWN)], [Some(0.8), Some(0.2)]);
    assert_eq!(albedo(&s, same, DOWN), Some(0.8));
    assert_eq!(albedo(&s, light, DOWN), Some(0.0));
    assert_eq!(s.at(both, UP).eval(UP, DOWN), Color::black());
}

#[test]
fn masks_let_light_pass_and_multiply() {
    let mut s = Studio::new();
    let half = s.grey(0.5);
    let paper = s.diffuse(0.8);
    let once = s.add(Material::Mask { opacity: half, nested: paper });
    let twice = s.add(Material::Mask { opacity: half, nested: once });
    let f = 0.8 * f32::FRAC_1_PI;
    assert_eq!(s.at(once, UP).eval(UP, UP).r, 0.5 * f);
    assert_eq!(s.at(twice, UP).eval(UP, UP).r, 0.25 * f);
    let passed = s.at(twice, DOWN).sample(DOWN, 0.9, [0.5; 2]).expect("it is passed");
    assert_eq!((passed.wi, passed.density), (-DOWN, Density::Delta(0.75)));
    assert!(s.at(once, UP).lobes().delta && !s.at(paper, UP).lobes().delta);
}

#[test]
fn values_outside_their_domain_are_moved_into_it() {
    let mut s = Studio::new();
    let bright = s.diffuse(1.5);
    assert_eq!(s.at(bright, UP).albedo(UP), Some(Color::white()));
    let (zero, white) = (s.grey(0.0), s.grey(1.0));
    let roughness = Roughness {
        distribution: Distribution::Ggx,
        masking: Masking::HeightCorrelated,
        alpha_u: zero,
        alpha_v: zero,
    };
    let mirror = s.add(Material::Conductor {
        index: ConductorIndex::Mirror,
        roughness: Some(roughness),
        specular_reflectance: white,
    });
    let sample = s.at(mirror, UP).sample(UP, 0.5, [0.5; 2]).expect("a mirror reflects");
    // α = 10⁻⁴: within a few of it of the mirror direction, and all of the light.
    assert!((sample.wi - Vec3::new(-0.6, 0.0, 0.8)).length() < 1e-3);
    assert!((sample.weight.r - 1.0).abs() < 1e-3);
}

#[test]
fn equal_indices_are_invisible_even_when_rough() {
    let mut s = Studio::new();
    let (tenth, white) = (s.grey(0.1), s.grey(1.0));
    let roughness = Roughness {
        distribution: Distribution::Ggx,
        masking: Masking::HeightCorrelated,
        alpha_u: tenth,
        alpha_v: tenth,
    };
    let air = s.add(Material::Dielectric {
        eta: Ior::new(1.0).expect("an index"),
        dispersion: None,
        nesting: None,
        roughness: Some(roughness),
        specular_reflectance: white,
        specular_transmittance: white,
    });
    let sample = s.at(air, UP).sample(UP, 0.5, [0.5; 2]).expect("light passes");
    assert!((sample.wi + UP).length() < 1e-6); // one refraction's rounding
    assert_eq!((sample.weight, sample.density), (Color::white(), Density::Delta(1.0)));
}

#[test]
fn impossible_compositions_are_refused() {
    let mut s = Studio::new();
    let (white, unknown) = (s.grey(1.0), MaterialId(9));
    let refused = |s: &mut Studio, material| s.materials.add(material).err();
    let mask = Material::Mask { opacity: white, nested: unknown };
    assert_eq!(refused(&mut s, mask), Some(MaterialError::Unknown(9)));
    let glass = s.add(Material::ThinDielectric {
        eta: Ior::new(1.5).expect("an index"),
        specular_reflectance: white,
        specular_transmittance: white,
    });
    let paper = s.diffuse(0.5);
    let two = Material::TwoSided { front: paper, back: glass };
    assert_eq!(refused(&mut s, two), Some(MaterialError::TransmissiveSide));
    let two = Material::TwoSided { front: paper, back: unknown };
    assert_eq!(refused(&mut s, two), Some(MaterialError::Unknown(9)));
}

#[test]
fn blends_are_shares_of_their_parts_on_either_side() {
    let mut s = Studio::new();
    let (light, dark, quarter) = (s.diffuse(0.8), s.diffuse(0.4), s.grey(0.25));
    let blend = s.add(Material::Blend { weight: quarter, parts: [light, dark] });
    let both = s.add(Material::TwoSided { front: light, back: blend });
    let over = s.grey(7.0);
    let second = s.add(Material::Blend { weight: over, parts: [light, dark] });
    let albedo = |id, wo| s.at(id, wo).albedo(wo).map_or(f32::NAN, |c| c.r);
    // 0.75 · 0.8 + 0.25 · 0.4 = 0.7, in one rounding of each product.
    assert!((albedo(blend, UP) - 0.7).abs() < 1e-6 && albedo(blend, DOWN) == 0.0);
    assert!((albedo(both, DOWN) - 0.7).abs() < 1e-6 && albedo(both, UP) == 0.8);
    assert_eq!(albedo(second, UP), 0.4);
}

#[test]
fn bumps_are_the_normal_of_their_slope() {
    use crate::geometry::{GeometryBuilder, Located, Ray, Rectangle, Shape, Transform};
    use crate::texture::{Bitmap, BitmapImage, Filter, Texture, UvTransform, Wrap};

    let mut s = Studio::new();
    let image = BitmapImage::from_f32(4, 1, 1, &[0.0, 0.25, 0.5, 0.75]).expect("four texels");
    let ramp = Bitmap::new(image, Filter::Bilinear, Wrap::Clamp, UvTransform::IDENTITY);
    let height = s.textures.add(Texture::Bitmap(ramp));
    let flat = s.grey(0.5);
    let nested = s.diffuse(0.8);
    let options = Perturbation::default();
    let bumpy = s.add(Material::BumpMap { height, scale: 0.5, options, nested });
    let smooth = s.add(Material::BumpMap { height: flat, scale: 0.5, options, nested });
    // The height rises by 0.5 over u, and the square is 2 wide: n ∝ (−0.25, 0, 1).
    let n = Vec3::new(-0.25, 0.0, 1.0).normalize() * 0.5 + Vec3::splat(0.5);
    let normal = s.textures.constant(Color::from(n.to_array()));
    let mapped = s.add(Material::NormalMap { normal, options, nested });

    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Rectangle(Rectangle::new(&Transform::IDENTITY).expect("a square")));
    let geometry = builder.build();
    let ray = Ray::new(Vec3::new(0.1, 0.2, 1.0), -Vec3::Z);
    let hit = geometry.intersect(&ray).expect("the square is below");
    let surface = Located::new(&geometry, geometry.surface_point(&ray, &hit));
    let eval = |id| {
        let bsdf = s.materials.prepare(id, &s.textures, (&surface).into(), Side::Front, Primaries);
        bsdf.eval(UP, Vec3::new(-0.48, 0.6, 0.64)).r
    };
    // A few roundings of numbers of order 1.
    assert!((eval(bumpy) - eval(mapped)).abs() < 1e-6);
    assert!((eval(smooth) - eval(nested)).abs() < 1e-6);
    assert!((eval(bumpy) - eval(nested)).abs() > 0.01);
    let refused = s.materials.add(Material::NormalMap { normal, options, nested: bumpy });
    assert_eq!(refused.err(), Some(MaterialError::NestedBumps));
}

/// The share of light that comes back, over samples from one direction; in flux, for light that is refracted takes its radiance
/// along by η².
fn sampled_albedo(s: &Studio, id: MaterialId) -> f32 {
    let bsdf = s.at(id, Vec3::Z);
    let uniform = |i| (hash_u32(i) >> 8) as f32 / 16_777_216.0;
    let weights = (0..4096).map(|i| {
        let sample = bsdf.sample(Vec3::Z, uniform(3 * i), [uniform(3 * i + 1), uniform(3 * i + 2)]);
        sample.map_or(0.0, |s| s.weight.g * s.eta * s.eta)
    });
    weights.sum::<f32>() / 4096.0
}

#[test]
fn compensation_brings_back_what_facets_lose() {
    let mut s = Studio::new();
    let (white, alpha) = (s.grey(1.0), s.grey(0.9));
    let (distribution, masking) = (Distribution::Ggx, Masking::HeightCorrelated);
    let roughness = Some(Roughness { distribution, masking, alpha_u: alpha, alpha_v: alpha });
    let metal = s.add(Material::Conductor {
        index: ConductorIndex::Mirror,
        roughness,
        specular_reflectance: white,
    });
    let eta = Ior::new(1.5).expect("an index");
    let glass = s.add(Material::Dielectric {
        eta,
        dispersion: None,
        nesting: None,
        roughness,
        specular_reflectance: white,
        specular_transmittance: white,
    });
    let width = Alpha::clamped(0.9);
    let facets = etendue_brdf::Microfacets::new(distribution, width, width, masking);
    let tables = etendue_brdf::KullaContyDielectric::new(eta, facets).expect("isotropic facets");
    for (nested, how) in [
        (metal, Compensation::KullaContyMetal),
        (metal, Compensation::TurquinMetal),
        (glass, Compensation::KullaContyGlass(Arc::new(tables))),
    ] {
        let lossy = sampled_albedo(&s, nested);
        assert!(lossy < 0.95, "{how:?}: {lossy}");
        let whole = s.add(Material::Compensated { nested, how: how.clone() });
        let whole = sampled_albedo(&s, whole);
        // Tables are good to a few thousandths, Turquin's factor and 4096 samples to two hundredths.
        assert!((whole - 1.0).abs() < 0.03, "{how:?}: {whole}");
    }
    // Around something else it is that.
    let diffuse = s.diffuse(0.25);
    let same = s.add(Material::Compensated { nested: diffuse, how: Compensation::TurquinMetal });
    assert_eq!(s.at(same, UP).albedo(UP), Some(Color::splat(0.25)));
}
