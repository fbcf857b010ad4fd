//! A matte base under a rough dielectric interface.

use std::rc::Rc;

use etendue_brdf::fresnel::f0_from_ior;
use etendue_brdf::{
    Alpha, Bsdf, CoupledInterface, Distribution, InternalReflectance, InternalScattering, Ior,
    Lambert, Masking, Microfacets, OpticalDepth, Reflectance, RoughCoupled, RoughDielectric,
    RoughPlastic, StochasticLayers, TransmittanceTable,
};
use etendue_math::glam::DVec3;
use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Vec3, Vector3};
use etendue_sampling::{Pcg32, uniform};

use super::directions::{Pair, albedo_probe, models, pairs};
use super::monte_carlo::{self, AZIMUTHS, Mean, POLAR, VIEWS, WORDS};
use crate::functions::domain::Domain;
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::Effort;
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "layered", title: "A matte base under a rough coat", build };

/// Width of the interface and reflectance of the base.
const MATERIALS: [(f64, f64); 4] = [(0.1, 0.2), (0.1, 0.8), (0.3, 0.2), (0.3, 0.8)];
const ETA: f64 = 1.5;

fn material(case: usize) -> String {
    let (alpha, rho) = MATERIALS[case];
    format!("α {alpha}, ρ {rho}")
}

fn build(effort: Effort) -> Setup {
    let cases = 0..MATERIALS.len();
    let polar = effort.choose(&POLAR[..], &POLAR[1..3]);
    let views = effort.choose(&VIEWS[..], &VIEWS[1..2]);
    // Enough for the narrower lobe at grazing: 1e-3.
    let probe = |case| views.iter().map(move |&t| albedo_probe::<128>(case, &material(case), t));
    let domain = Rc::new(Domain {
        words: format!(
            "GGX interface with η 1.5 and α 0.1 and 0.3 over bases of reflectance 0.2 and 0.8; {WORDS}"
        ),
        points: cases.clone().flat_map(|case| pairs(case, polar, &AZIMUTHS)).collect(),
        place: |pair: &Pair| format!("{}, {}", material(pair.case), pair.words()),
        probes: cases.flat_map(probe).collect(),
    });
    let (paths, albedo_paths) = (effort.choose(20_000, 300), effort.choose(100_000, 2000));
    let compute = monte_carlo::reference(
        &domain,
        move |pair, address| value(pair, address, paths),
        move |case, wo, address| albedo(case, wo, address, albedo_paths),
    );
    Setup {
        quantity: "scattering function f(wo, wi) in sr⁻¹",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // Light that the rough interface turns within its lobe is treated as if it went straight through.
        bound: 0.1,
        ground: Box::new(Rc::clone(&domain)),
        reference: "light followed bounce by bounce between interface and base (position-free Monte Carlo)",
        compute,
        prose: vec![
            "Plastic transmits through a table of the interface and sums the reflections back and forth below it, with the base's \
             colour at every one, or, linear, as if the base were white. Albedo scaling gives the base what the interface does \
             not reflect towards the viewer: a look-up, no second direction, and not reciprocal. The coupled model has \
             Shirley's matte term below the rough lobe. Those two know the base only as it looks through the coat, darker \
             by the reflections in between: they are given what leaves again of the light that has entered, and albedo \
             scaling once more the bare ρ, as a stack of layers that know nothing of each other would. What facets scatter \
             more than once is lost, in the reference as in the models.",
        ],
        advice: "Plastic with reflections summed at every bounce: its error is that of the light that is followed itself. Linear \
                 plastic keeps hues and is wrong for dark bases. The coupled model needs no table and comes close, if it is \
                 given the colour that is seen; albedo scaling is hardly worse, but not reciprocal. With the bare colour \
                 under the coat it is too bright, by more than all that distinguishes these formulas otherwise.",
    }
}

fn interface<T: Scalar>(case: usize) -> Microfacets<T> {
    Microfacets::ggx(Alpha::clamped(T::lit(MATERIALS[case].0)))
}

fn base<T: Scalar>(case: usize) -> Reflectance<T> {
    Reflectance::clamped(T::lit(MATERIALS[case].1))
}

fn index<T: Scalar>() -> Ior<T> {
    Ior::new(T::lit(ETA)).expect("the index of glass")
}

/// The table of an interface, for as long as the program runs: a model borrows it, and a family is set up once.
fn table<T: Scalar>(case: usize) -> &'static TransmittanceTable<T> {
    let alpha = Alpha::clamped(T::lit(MATERIALS[case].0));
    let (masking, internal) = (Masking::HeightCorrelated, InternalReflectance::Exact);
    Box::leak(Box::new(TransmittanceTable::new(
        index(),
        Distribution::Ggx,
        alpha,
        masking,
        internal,
    )))
}

fn forms<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let cases = 0..MATERIALS.len();
    let tables: Vec<_> = cases.clone().map(table::<T>).collect();
    let plastic = |scattering| {
        let model = |case: usize| RoughPlastic::new(tables[case], base::<T>(case), scattering);
        cases.clone().map(model).collect::<Vec<_>>()
    };
    let coupled = |interface_of: CoupledInterface<T>| {
        let model = |case: usize| {
            let colour = Reflectance::clamped(seen(tables[case], case));
            RoughCoupled::new(interface_of, interface(case), colour)
        };
        cases.clone().map(model).collect::<Vec<_>>()
    };
    let exact = CoupledInterface::dielectric(index()).expect("an index above 1");
    let schlick = CoupledInterface::schlick(Reflectance::clamped(f0_from_ior(T::lit(ETA))));
    let black = InternalScattering::Linear;
    let specular: Vec<_> = tables
        .iter()
        .map(|table| RoughPlastic::<T>::new(table, Reflectance::clamped(T::ZERO), black))
        .collect();
    let scaling = |colour: fn(&TransmittanceTable<T>, usize) -> T| {
        let matte = |case: usize| colour(tables[case], case) * T::FRAC_1_PI;
        let matte: Vec<T> = cases.clone().map(matte).collect();
        let (tables, specular) = (tables.clone(), specular.clone());
        move |&(case, [wo, wi]): &(usize, [Vec3<T>; 2])| {
            specular[case].eval(wo, wi) + matte[case] * tables[case].transmittance(wo.z())
        }
    };
    let directions = |pair: &Pair| (pair.case, pair.vectors::<T>());
    vec![
        models("plastic", domain, plastic(InternalScattering::NonLinear)),
        models("linear plastic", domain, plastic(InternalScattering::Linear)),
        models("coupled, exact k", domain, coupled(exact)),
        models("coupled, Schlick's k", domain, coupled(schlick)),
        Variant::new("albedo scaling", domain, directions, scaling(seen)),
        Variant::new("albedo scaling, bare colour", domain, directions, scaling(bare)),
    ]
}

/// The reflectance of the base below its table's interface as it is seen: what leaves again of the light that has entered.
///
/// ```text
/// ρ T̄ / (η² (1 − ρ F_in)),  T̄ = 2 ∫ T(μ) μ dμ
/// ```
fn seen<T: Scalar>(table: &TransmittanceTable<T>, case: usize) -> T {
    let rho = bare(table, case);
    let transmitted = gauss_legendre::<T, 32>()
        .into_iter()
        .fold(T::ZERO, |sum, (mu, w)| sum + T::TWO * w * mu * table.transmittance(mu));
    let eta = table.eta();
    rho * transmitted / (eta * eta * (T::ONE - rho * table.internal_reflectance()))
}

fn bare<T: Scalar>(_: &TransmittanceTable<T>, case: usize) -> T {
    T::lit(MATERIALS[case].1)
}

fn layers(case: usize) -> StochasticLayers<RoughDielectric<f64>, Lambert<f64>> {
    let glass = RoughDielectric::new(index(), interface(case)).expect("an index that is not 1");
    StochasticLayers::new(glass, Lambert::new(base(case)), OpticalDepth::clear())
}

fn value(pair: &Pair, address: u64, samples: u32) -> Mean {
    let layers = layers(pair.case);
    let [wo, wi] = pair.vectors::<f64>();
    Mean::of((0..u64::from(samples)).map(|sample| {
        let mut rng = Pcg32::new(sample, address);
        layers.eval(wo, wi, &mut || uniform(&mut rng))
    }))
}

fn albedo(case: usize, wo: DVec3, address: u64, samples: u32) -> Mean {
    let layers = layers(case);
    Mean::of((0..u64::from(samples)).map(|sample| {
        let mut rng = Pcg32::new(sample, address);
        layers.sample(wo, &mut || uniform(&mut rng)).map_or(0.0, |(_, weight)| weight)
    }))
}
