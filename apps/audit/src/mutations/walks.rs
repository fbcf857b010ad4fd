//! Random walks between facets.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "upward rays leave by half of Λ: wrong factor",
        file: "crates/brdf/src/microfacet/walk.rs",
        find: "(-log / lambda).exp()",
        replace: "(-log / (lambda * T::HALF)).exp()",
        filters: &["ConductorWalk", "DielectricWalk"],
    },
    Mutation {
        fault: "downward rays fall by the cosine alone: lost projected area",
        file: "crates/brdf/src/microfacet/walk.rs",
        find: "(-w.z() / facets.projected_area(w) * log)",
        replace: "(-w.z() * log)",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "escape of the cosine's height: lost Λ",
        file: "crates/brdf/src/microfacet/walk.rs",
        find: "(facets.lambda(w) * c.ln()).exp()",
        replace: "c",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "area seen from below without Λ",
        file: "crates/brdf/src/microfacet/walk.rs",
        find: "-v.z() * facets.lambda(v)",
        replace: "-v.z()",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "facets weighted by 2 for 4: missing Jacobian",
        file: "crates/brdf/src/microfacet/walk/conductor.rs",
        find: "C::Real::lit(4.0) * visible_area",
        replace: "C::Real::TWO * visible_area",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "walk's value keeps the cosine: missing 1/cos θi",
        file: "crates/brdf/src/microfacet/walk/conductor.rs",
        find: "(x / wi.z()).min",
        replace: "x.min",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "weight of the path forgotten in its value: lost throughput",
        file: "crates/brdf/src/microfacet/walk/conductor.rs",
        find: "sum += (weight * self.phase(-w, wi))",
        replace: "sum += self.phase(-w, wi)",
        filters: &["ConductorWalk"],
    },
    Mutation {
        fault: "height kept across the surface: lost 1 − c",
        file: "crates/brdf/src/microfacet/walk/dielectric.rs",
        find: "c = (T::ONE - c).max(T::MIN_POSITIVE);",
        replace: "c = c.max(T::MIN_POSITIVE);",
        filters: &["DielectricWalk"],
    },
    Mutation {
        fault: "walk refracts inside as outside: wrong side",
        file: "crates/brdf/src/microfacet/walk/dielectric.rs",
        find: "let index = if crossed { far } else { near };",
        replace: "let index = if crossed { near } else { near };",
        filters: &["DielectricWalk"],
    },
    Mutation {
        fault: "walk's radiance not scaled: missing 1/η²",
        file: "crates/brdf/src/microfacet/walk/dielectric.rs",
        find: "weight: T::ONE / (eta * eta)",
        replace: "weight: T::ONE / eta",
        filters: &["DielectricWalk"],
    },
    Mutation {
        fault: "walk leaves on the wrong side",
        file: "crates/brdf/src/microfacet/walk/dielectric.rs",
        find: "let wi = if crossed == starts_below { w } else { w.flip_z() };",
        replace: "let wi = if starts_below { w.flip_z() } else { w };",
        filters: &["DielectricWalk"],
    },
];
