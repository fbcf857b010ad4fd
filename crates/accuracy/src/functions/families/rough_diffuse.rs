//! Rough matte surfaces.

use std::rc::Rc;

use etendue_brdf::{
    Eon, EonAlbedo, Lambert, OrenNayar, OrenNayarFujii, OrenNayarQualitative, ParameterError,
    Reflectance, Roughness, Sigma,
};
use etendue_math::Real;
use etendue_math::glam::DVec3;

use super::directions::{Pair, albedo_probe, models, pairs};
use crate::functions::domain::Domain;
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::{Effort, Reference, Uncertainty, VCavities};
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "rough-diffuse", title: "Rough diffuse reflection", build };

/// Deviation of the facets' slope angle, and their albedo.
const MATERIALS: [(f64, f64); 6] =
    [(0.1, 0.5), (0.3, 0.5), (0.6, 0.5), (0.1, 0.9), (0.3, 0.9), (0.6, 0.9)];
/// Polar angles of viewer and light, in degrees.
const POLAR: [f64; 6] = [5.0, 20.0, 35.0, 50.0, 65.0, 80.0];
const AZIMUTHS: [f64; 7] = [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0];
/// Polar angles of the facets, of half as many a check.
const NODES: usize = 64;
const FEWER_NODES: usize = 32;

fn material(case: usize) -> String {
    let (sigma, albedo) = MATERIALS[case];
    format!("σ {sigma}, ρ {albedo}")
}

fn build(effort: Effort) -> Setup {
    let (polar, azimuths) =
        effort.choose((&POLAR[..], &AZIMUTHS[..]), (&POLAR[2..5], &AZIMUTHS[..2]));
    let cases = 0..MATERIALS.len();
    let views: &[f64] = effort.choose(&[20.0, 50.0, 80.0], &[50.0]);
    let probe = |case: usize, theta: f64| match effort {
        Effort::Full => albedo_probe::<14>(case, &material(case), theta),
        Effort::Quick => albedo_probe::<6>(case, &material(case), theta),
    };
    let domain = Rc::new(Domain {
        words: "σ 0.1, 0.3 and 0.6 rad, facet albedo ρ 0.5 and 0.9; polar angles of viewer and light from 5° to 80° in steps \
                of 15°, azimuths between them from 0° to 180° in steps of 30°"
            .to_owned(),
        points: cases.clone().flat_map(|case| pairs(case, polar, azimuths)).collect(),
        place: |pair: &Pair| format!("{}, {}", material(pair.case), pair.words()),
        probes: cases.flat_map(|case| views.iter().map(move |&theta| (case, theta))).map(|(c, t)| probe(c, t)).collect(),
    });
    let compute = {
        let domain = Rc::clone(&domain);
        move || match effort {
            Effort::Full => reference::<NODES, FEWER_NODES>(&domain),
            Effort::Quick => reference::<24, 12>(&domain),
        }
    };
    Setup {
        quantity: "scattering function f(wo, wi) in sr⁻¹",
        judged_by: ErrorKind::RmsRelative,
        variants: variants(&domain),
        // The published fit against what it was fitted to.
        bound: 0.05,
        ground: Box::new(Rc::clone(&domain)),
        reference: "symmetric V-cavities with Gaussian slope angles and Lambertian facets, shadowing, masking and one \
                    interreflection, integrated numerically over slope and azimuth: the surface of the paper of 1994",
        compute: Box::new(compute),
        prose: vec![
            "The exact variant is the full model of the paper, a fit of this very surface. The qualitative model leaves \
             interreflection out. Fujii's model and EON know a roughness between 0 and 1 instead of a slope; it is set to σ \
             here, as their authors do, so that part of their error is another meaning of the parameter. EON returns the \
             light of all bounces, the reference that of two.",
        ],
        advice: "To reproduce measured or published surfaces described by σ, the full model. For a material whose \
                 energy must add up in a path tracer, EON: no closer to this surface, but it loses and gains nothing; \
                 its approximate albedo costs a fraction of the exact one and differs by far less than the models do \
                 among each other. For the shape alone, Fujii's model, which is both cheaper and closer than the \
                 qualitative one. Lambert's reflector is what all of them become when the surface is smooth.",
    }
}

fn checked<M>(model: impl Fn(f64, f64) -> Result<M, ParameterError>) -> Vec<M> {
    let model = |&(sigma, albedo): &(f64, f64)| model(sigma, albedo);
    // The materials are constants inside every domain.
    MATERIALS.iter().map(model).collect::<Result<_, _>>().expect("materials of this file")
}

fn white<T: Scalar>(albedo: f64) -> Result<Reflectance<T>, ParameterError> {
    Reflectance::new(T::lit(albedo))
}

fn full<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Variant {
    let model = |s, a| Ok(OrenNayar::new(white::<T>(a)?, Sigma::new(T::lit(s))?));
    models("full Oren–Nayar", domain, checked(model))
}

fn variants(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let mut all = vec![full::<f64>(domain), full::<f32>(domain)];
    all.extend(cheaper::<f64>(domain));
    all.extend(cheaper::<f32>(domain));
    all
}

fn cheaper<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let qualitative = |s, a| Ok(OrenNayarQualitative::new(white::<T>(a)?, Sigma::new(T::lit(s))?));
    let fujii = |s, a| Ok(OrenNayarFujii::new(white::<T>(a)?, Roughness::new(T::lit(s))?));
    let eon = |albedo: EonAlbedo| {
        move |s, a| Ok(Eon::new(white::<T>(a)?, Roughness::new(T::lit(s))?).with_albedo(albedo))
    };
    vec![
        models("qualitative", domain, checked(qualitative)),
        models("Fujii", domain, checked(fujii)),
        models("EON, exact albedo", domain, checked(eon(EonAlbedo::Exact))),
        models("EON, approximate albedo", domain, checked(eon(EonAlbedo::Approximate))),
        models("Lambert", domain, checked(|_, a| Ok(Lambert::new(white::<T>(a)?)))),
    ]
}

fn reference<const N: usize, const FEWER: usize>(domain: &Domain<Pair>) -> Reference {
    let surfaces = MATERIALS.map(|(sigma, albedo)| VCavities::new::<N>(sigma, albedo));
    let coarse = MATERIALS.map(|(sigma, albedo)| VCavities::new::<FEWER>(sigma, albedo));
    let eval = |surfaces: &[VCavities], pair: &Pair| {
        let [wo, wi]: [DVec3; 2] = pair.vectors::<f64>();
        surfaces[pair.case].eval(wo, wi)
    };
    let values = domain.values(|pair| eval(&surfaces, pair));
    let energies = domain.energies(|pair| eval(&surfaces, pair));
    let check = domain.values(|pair| eval(&coarse, pair));
    let squares: f64 = values.iter().zip(&check).map(|(v, c)| Real::sqr(c / v - 1.0)).sum();
    let energy = domain
        .energies(|pair| eval(&coarse, pair))
        .iter()
        .zip(&energies)
        .map(|(c, e)| (c - e).abs())
        .fold(0.0, f64::max);
    let rms = (squares / values.len() as f64).sqrt();
    let method = "the difference from half as many nodes in either angle, which exceeds it";
    Reference { values, energies, uncertainty: Some(Uncertainty { rms, energy, method }) }
}
