//! What facets scatter more than once.

use std::rc::Rc;

use etendue_brdf::microfacet::walk::ConductorWalk;
use etendue_brdf::{
    Alpha, Bsdf, ComplexIor, KullaContyConductor, Microfacets, RoughConductor, TurquinConductor,
};
use etendue_math::glam::DVec3;
use etendue_sampling::{Pcg32, uniform};

use super::directions::{Pair, albedo_probe, models, pairs};
use super::monte_carlo::{self, AZIMUTHS, Mean, POLAR, VIEWS, WORDS};
use crate::functions::domain::Domain;
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::Effort;
use crate::functions::variant::{Scalar, Variant};

pub(super) const INFO: FamilyInfo =
    FamilyInfo { name: "energy-compensation", title: "Multiple scattering between facets", build };

/// Width, and complex index: everything reflected, and a grey metal.
const MATERIALS: [(f64, [f64; 2]); 6] = [
    (0.3, [0.0, 1.0]),
    (0.6, [0.0, 1.0]),
    (1.0, [0.0, 1.0]),
    (0.3, [1.4, 1.6]),
    (0.6, [1.4, 1.6]),
    (1.0, [1.4, 1.6]),
];

fn material(case: usize) -> String {
    let (alpha, [eta, k]) = MATERIALS[case];
    if eta == 0.0 { format!("α {alpha}, F = 1") } else { format!("α {alpha}, {eta} + {k}i") }
}

fn metal<T: Scalar>(case: usize) -> (ComplexIor<T>, Microfacets<T>) {
    let (alpha, [eta, k]) = MATERIALS[case];
    let ior = ComplexIor::clamped(T::lit(eta), T::lit(k));
    (ior, Microfacets::ggx(Alpha::clamped(T::lit(alpha))))
}

fn build(effort: Effort) -> Setup {
    let cases = 0..MATERIALS.len();
    let polar = effort.choose(&POLAR[..], &POLAR[1..3]);
    let views = effort.choose(&VIEWS[..], &VIEWS[1..2]);
    let probe = |case| views.iter().map(move |&t| albedo_probe::<48>(case, &material(case), t));
    let domain = Rc::new(Domain {
        words: format!(
            "GGX facets with α 0.3, 0.6 and 1, which reflect everything or have the index 1.4 + 1.6i; {WORDS}"
        ),
        points: cases.clone().flat_map(|case| pairs(case, polar, &AZIMUTHS)).collect(),
        place: |pair: &Pair| format!("{}, {}", material(pair.case), pair.words()),
        probes: cases.flat_map(probe).collect(),
    });
    let (paths, albedo_paths) = (effort.choose(32_768, 128), effort.choose(60_000, 1000));
    let compute = monte_carlo::reference(
        &domain,
        move |pair, address| value(pair, address, paths),
        move |case, wo, address| albedo(case, wo, address, albedo_paths),
    );
    Setup {
        quantity: "scattering function f(wo, wi) in sr⁻¹",
        judged_by: ErrorKind::RmsRelative,
        variants: forms::<f64>(&domain).into_iter().chain(forms::<f32>(&domain)).collect(),
        // The compensating lobe is diffuse, which the walk's is not.
        bound: 0.2,
        ground: Box::new(Rc::clone(&domain)),
        reference: "a random walk from facet to facet of the surface that Smith's model describes, its first order replaced by \
                    the closed form",
        compute,
        prose: vec![
            "None is single scattering, the rough conductor by itself. The other two add what it loses: Turquin's by scaling the \
             lobe, Kulla and Conty's by a second, diffuse one.",
        ],
        advice: "Nothing where facets are smooth or dark, for little is lost there. Else Kulla and Conty's lobe: it is \
                 closest to the walk in energy and in shape, and reciprocal. Turquin's scaling costs about as much per \
                 evaluation and needs no second way of sampling, but is not reciprocal, and brightens the lobe instead \
                 of its surroundings. A random walk where its noise can be paid for: all of these are approximations \
                 of it.",
    }
}

fn forms<T: Scalar>(domain: &Rc<Domain<Pair>>) -> Vec<Variant> {
    let all = || (0..MATERIALS.len()).map(metal::<T>);
    // GGX facets of these widths are in the tables.
    let compensated =
        |(ior, facets)| KullaContyConductor::new(ior, facets).expect("a table for GGX");
    let scaled = |(ior, facets)| TurquinConductor::new(ior, facets).expect("a table for GGX");
    let single = |(ior, facets)| RoughConductor::new(ior, facets);
    vec![
        models("Kulla–Conty", domain, all().map(compensated).collect()),
        models("Turquin", domain, all().map(scaled).collect()),
        models("none", domain, all().map(single).collect::<Vec<RoughConductor<T>>>()),
    ]
}

/// The walk's value at a pair of directions. The same path gives the first order alone, which the closed form replaces.
fn value(pair: &Pair, address: u64, samples: u32) -> Mean {
    let (ior, facets) = metal::<f64>(pair.case);
    let walk = ConductorWalk::<f64>::new(ior, facets);
    let first = walk.with_max_order(1);
    let [wo, wi] = pair.vectors::<f64>();
    let multiple = Mean::of((0..u64::from(samples)).map(|sample| {
        let path = || Pcg32::new(sample, address);
        let eval = |walk: &ConductorWalk<f64>, mut rng: Pcg32| {
            walk.eval(wo, wi, &mut || uniform(&mut rng))
        };
        eval(&walk, path()) - eval(&first, path())
    }));
    let single = RoughConductor::new(ior, facets).eval(wo, wi);
    Mean { value: single + multiple.value, ..multiple }
}

fn albedo(case: usize, wo: DVec3, address: u64, samples: u32) -> Mean {
    let (ior, facets) = metal::<f64>(case);
    let walk = ConductorWalk::<f64>::new(ior, facets);
    Mean::of((0..u64::from(samples)).map(|sample| {
        let mut rng = Pcg32::new(sample, address);
        walk.sample(wo, &mut || uniform(&mut rng)).map_or(0.0, |path| path.weight)
    }))
}
