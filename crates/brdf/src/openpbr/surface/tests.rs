//! Energy, reciprocity and limits of the composed surface.

use super::*;
use crate::quadrature::directional_albedo;
use crate::{
    Alpha, ComplexIor, Conductor, Eon, KullaContyConductor, Masking, Reflectance, RoughConductor,
    Roughness,
};
use crate::{Distribution, fresnel::F82Tint, laws};
use etendue_math::glam::DVec3;

type Parameters = OpenPbrParameters<f64>;

fn build(parameters: Parameters) -> OpenPbr<f64> {
    OpenPbr::new(parameters).unwrap()
}

fn everything() -> Parameters {
    Parameters {
        base_diffuse_roughness: 0.4,
        base_metalness: 0.3,
        specular_color: 0.7,
        specular_roughness: 0.5,
        specular_roughness_anisotropy: 0.4,
        coat_weight: 0.6,
        coat_color: 0.5,
        coat_roughness: 0.55,
        coat_darkening: 0.7,
        fuzz_weight: 0.5,
        fuzz_color: 0.6,
        ..Default::default()
    }
}

/// White, and as rough as the quadrature can follow.
fn white() -> Parameters {
    Parameters { base_color: 1.0, specular_roughness: 0.6, ..Default::default() }
}

fn viewer(z: f64) -> DVec3 {
    DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
}

fn albedos(parameters: Parameters) -> impl Iterator<Item = f64> {
    let model = build(parameters);
    [1.0, 0.8, 0.5, 0.3, 0.15, 0.05]
        .into_iter()
        .map(move |z| directional_albedo::<_, 128>(&model, viewer(z)))
}

#[test]
fn a_white_glossy_base_returns_what_it_receives() {
    for (changed, bound) in [
        (white(), 1e-3),
        (Parameters { specular_roughness: 1.0, ..white() }, 1e-3),
        (Parameters { specular_ior: 1.02, ..white() }, 4e-3),
        // The coupled product is exact over a Lambertian base; a rough one leans to the viewer.
        (Parameters { base_diffuse_roughness: 1.0, ..white() }, 8e-3),
    ] {
        for albedo in albedos(changed) {
            assert!((albedo - 1.0).abs() < bound && albedo < 1.001, "{changed:?} {albedo}");
        }
    }
}

#[test]
fn layers_never_gain_and_lose_what_is_stated() {
    let metal = Parameters { base_metalness: 1.0, ..white() };
    let coat = |p| Parameters { coat_weight: 1.0, coat_roughness: 0.6, ..p };
    let fuzz = |p| Parameters { fuzz_weight: 1.0, ..p };
    // Measured: 0.9980, 0.9956, 0.983, 0.894, 0.857 at the darkest angle.
    for (changed, least) in [
        (coat(white()), 0.997),
        (fuzz(white()), 0.995),
        (coat(metal), 0.982),
        (fuzz(metal), 0.89),
        (fuzz(coat(metal)), 0.85),
    ] {
        for albedo in albedos(changed) {
            // The tables' interpolation, and that of the quadrature.
            assert!(albedo > least && albedo < 1.0005, "{changed:?} {albedo}");
        }
    }
}

#[test]
fn anisotropic_metal_gains_as_stated() {
    let metal = Parameters {
        base_metalness: 1.0,
        specular_roughness: 1.0,
        specular_roughness_anisotropy: 0.9,
        ..white()
    };
    let albedo = directional_albedo::<_, 96>(&build(metal), viewer(0.4));
    // The largest of a grid of roughness, anisotropy, angle and azimuth.
    assert!((albedo - 1.0728).abs() < 1e-3, "{albedo}");
}

#[test]
fn a_coloured_coat_is_seen_as_its_colour_along_the_normal() {
    let p = Parameters { coat_weight: 1.0, coat_color: 0.3, coat_ior: 1.0, ..white() };
    let clear = Parameters { coat_color: 1.0, ..p };
    let ratio = build(p).eval(DVec3::Z, DVec3::Z) / build(clear).eval(DVec3::Z, DVec3::Z);
    // A logarithm and its exponential.
    assert!((ratio - 0.3).abs() < 1e-15, "{ratio}");
    // Along a slanted path there is more of it: of index 1, by 1/cos θ.
    let (wo, wi) = (viewer(0.5), viewer(0.25));
    let ratio = build(p).eval(wo, wi) / build(clear).eval(wo, wi);
    assert!((ratio - Real::powi(0.3, 3)).abs() < 1e-15, "{ratio}");
}

#[test]
fn a_smooth_coat_darkens_a_grey_base_as_the_interfaced_lambertian_does() {
    let p = Parameters {
        base_color: 0.5,
        specular_weight: 0.0,
        coat_weight: 1.0,
        coat_ior: 1.5,
        ..Default::default()
    };
    let got = directional_albedo::<_, 64>(&build(p), DVec3::Z);
    // Plastic with non-linear scattering is the exact series, 0.96 · ρ (1 − F_in)/(1 − ρ F_in).
    let internal = crate::fresnel::dielectric_average(1.0 / 1.5_f64);
    let want = 0.96 * 0.5 * (1.0 - internal) / (1.0 - 0.5 * internal);
    // The fit of F_avg is 0.1 % off.
    assert!((got - want).abs() < 2e-3, "{got} {want}");
}

#[test]
fn every_parameter_is_checked() {
    let broken = |change: fn(&mut Parameters)| {
        let mut parameters = everything();
        change(&mut parameters);
        OpenPbr::new(parameters).is_err()
    };
    assert!(broken(|p| p.base_color = 1.1));
    assert!(broken(|p| p.specular_weight = -0.1));
    assert!(broken(|p| p.specular_ior = 0.9));
    assert!(broken(|p| p.coat_ior = f64::INFINITY));
    assert!(broken(|p| p.coat_color = f64::NAN));
    assert!(broken(|p| p.fuzz_roughness = 1.1));
    assert!(broken(|p| p.specular_roughness_anisotropy = f64::NAN));
}

#[test]
fn it_obeys_the_laws_of_a_bsdf() {
    let model = build(everything());
    laws::reciprocal(&model, 1e-11);
    laws::sampling_matches_density(&model, 1e-9);
    laws::density_integrates_to_at_most_one(&model);
    laws::total(&model);
    let smooth = Parameters { coat_roughness: 0.0, ..everything() };
    laws::total(&build(smooth));
    laws::total(&build(Parameters { specular_roughness: 0.0, ..smooth }));
    let extreme = OpenPbrParameters::<f32> {
        base_color: 1.0,
        specular_weight: 1e4,
        specular_roughness: 1.0,
        specular_roughness_anisotropy: 1.0,
        coat_weight: 1.0,
        coat_color: 0.0,
        coat_ior: 1e4,
        fuzz_weight: 1.0,
        fuzz_roughness: 0.0,
        ..Default::default()
    };
    laws::total(&OpenPbr::new(extreme).unwrap());
    laws::total(&OpenPbr::new(OpenPbrParameters { specular_ior: 1.0, ..extreme }).unwrap());
}

#[test]
fn without_specular_coat_and_fuzz_it_is_eon() {
    let p = Parameters { base_diffuse_roughness: 0.6, specular_weight: 0.0, ..everything() };
    let p = Parameters { base_metalness: 0.0, coat_weight: 0.0, fuzz_weight: 0.0, ..p };
    let (model, eon) =
        (build(p), Eon::new(Reflectance::new(0.8).unwrap(), Roughness::new(0.6).unwrap()));
    for (z, wi) in [(1.0, viewer(0.3)), (0.4, DVec3::new(0.0, 0.6, 0.8)), (0.01, DVec3::Z)] {
        let (f, pdf) = model.eval_pdf(viewer(z), wi);
        let (want, want_pdf) = eon.eval_pdf(viewer(z), wi);
        // The mean of 32 ones, and a share of a sum.
        assert!((f / want - 1.0).abs() < 1e-13 && (pdf / want_pdf - 1.0).abs() < 1e-14, "{z}");
    }
}

#[test]
fn bare_metal_is_the_f82_conductor_with_its_compensation() {
    let roughness = 0.7_f64;
    let facets = Microfacets::ggx(Alpha::new(roughness * roughness).unwrap());
    let [base, edge] = [0.9, 0.6].map(|c| Reflectance::new(c).unwrap());
    let white_metal = RoughConductor::<f64>::new(ComplexIor::perfect(), facets);
    let compensated = KullaContyConductor::<f64>::new(ComplexIor::perfect(), facets).unwrap();
    let metal =
        Parameters { base_metalness: 1.0, specular_roughness: roughness, ..Default::default() };
    let (white, colored) = (
        build(Parameters { base_color: 1.0, ..metal }),
        build(Parameters { base_color: 0.9, specular_color: 0.6, ..metal }),
    );
    let tint = F82Tint::new(base, edge);
    for (z, wi) in [(1.0, viewer(0.3)), (0.4, DVec3::new(0.0, 0.6, 0.8)), (0.05, -viewer(-0.1))] {
        let wo = viewer(z);
        let want = compensated.eval(wo, wi);
        // A few roundings each way.
        assert!((white.eval(wo, wi) / want - 1.0).abs() < 1e-13, "{z}");
        let single = white_metal.eval(wo, wi);
        let (_, cos) = half_vector(wo, wi).unwrap();
        let f = tint.average();
        let lost = crate::microfacet::FacetLoss::new(&facets).unwrap().average();
        // White facets return all they lose; these F_ms of it, the series in closed form.
        let multiple = (want - single) * f * f * (1.0 - lost) / (1.0 - f * lost);
        let want = single * tint.reflectance(cos) + multiple;
        assert!((colored.eval(wo, wi) / want - 1.0).abs() < 1e-12, "{z}");
    }
}

#[test]
fn smooth_metal_is_the_mirror() {
    let p = Parameters { base_metalness: 1.0, specular_roughness: 0.0, ..Default::default() };
    let model = build(p);
    assert_eq!(model.lobes(), Lobes::DELTA);
    let sample = model.sample(viewer(1.0), 0.9, [0.5; 2]).unwrap();
    assert_eq!((sample.wi, sample.density), (DVec3::Z, Density::Delta(1.0)));
    assert!((sample.weight - 0.8).abs() < 1e-15);
    let conductor = Conductor::<f64>::new(
        ComplexIor::perfect(),
        Distribution::Ggx,
        [0.0; 2],
        Masking::HeightCorrelated,
    );
    assert_eq!(conductor.unwrap().lobes(), model.lobes());
}
