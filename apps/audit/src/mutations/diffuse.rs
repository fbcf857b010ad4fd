//! Diffuse reflectors.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "1/3 for 1/π: wrong constant",
        file: "crates/brdf/src/diffuse/lambert.rs",
        find: "self.reflectance.scale(C::Real::FRAC_1_PI)",
        replace: "self.reflectance.scale(C::Real::lit(1.0 / 3.0))",
        filters: &["lambert"],
    },
    Mutation {
        fault: "accepts directions from below: lost domain test",
        file: "crates/brdf/src/diffuse/lambert.rs",
        find: "        if !both_above(wo, wi) {\n            return (C::black(), C::Real::ZERO);\n        }\n",
        replace: "        let _ = both_above(wo, wi);\n",
        filters: &["lambert"],
    },
    Mutation {
        fault: "A with 0.57 for 0.33: the variant's constant",
        file: "crates/brdf/src/diffuse/oren_nayar_qualitative.rs",
        find: "sigma.share(0.33)",
        replace: "sigma.share(0.57)",
        filters: &["oren-nayar-qualitative"],
    },
    Mutation {
        fault: "B with 0.57 for 0.09: the variant's constant in the wrong place",
        file: "crates/brdf/src/diffuse/oren_nayar_qualitative.rs",
        find: "sigma.share(0.09)",
        replace: "sigma.share(0.57)",
        filters: &["oren-nayar-qualitative"],
    },
    Mutation {
        fault: "tan β of the larger angle: swapped angle",
        file: "crates/brdf/src/diffuse/oren_nayar_qualitative.rs",
        find: "projection / wo.z().max(wi.z())",
        replace: "projection / wo.z().min(wi.z())",
        filters: &["oren-nayar-qualitative"],
    },
    Mutation {
        fault: "lobe without its clamp: negative behind",
        file: "crates/brdf/src/diffuse/oren_nayar_qualitative.rs",
        find: "(wo.x() * wi.x() + wo.y() * wi.y()).max(C::Real::ZERO)",
        replace: "(wo.x() * wi.x() + wo.y() * wi.y())",
        filters: &["oren-nayar-qualitative"],
    },
    Mutation {
        fault: "C2 with 0.40 for 0.45: wrong coefficient",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "C::Real::lit(0.45) * self.share * difference",
        replace: "C::Real::lit(0.40) * self.share * difference",
        filters: &["oren-nayar"],
    },
    Mutation {
        fault: "C4 with 0.33 for 0.13: wrong constant",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "sigma.share(0.13)",
        replace: "sigma.share(0.33)",
        filters: &["oren-nayar"],
    },
    Mutation {
        fault: "published f1 below 0: lost clamp",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "(rho * C::Real::FRAC_1_PI * (direct + rho * twice)).max(C::Real::ZERO)",
        replace: "rho * C::Real::FRAC_1_PI * (direct + rho * twice)",
        filters: &["oren-nayar"],
    },
    Mutation {
        fault: "1 − |cos φ| by subtraction: naive form",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "let one_minus_abs_cos_phi = sin_phi * sin_phi / (T::ONE + cos_phi.abs());",
        replace: "let one_minus_abs_cos_phi = T::ONE - cos_phi.abs() + T::ZERO * sin_phi;",
        filters: &["oren-nayar", "OrenNayar"],
    },
    Mutation {
        fault: "sin α − (2β/π)³ by subtraction at grazing: naive form",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "if self.cos_beta > T::HALF {",
        replace: "if self.cos_beta > -T::ONE {",
        filters: &["oren-nayar", "OrenNayar"],
    },
    Mutation {
        fault: "interreflection without ρ²: missing factor",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "(direct + rho * twice)",
        replace: "(direct + twice)",
        filters: &["oren-nayar"],
    },
    Mutation {
        fault: "azimuth of the normal divides by 0: lost test",
        file: "crates/brdf/src/diffuse/oren_nayar.rs",
        find: "let (cos_phi, sin_phi) = if product > T::ZERO {",
        replace: "let (cos_phi, sin_phi) = if product > -T::ONE {",
        filters: &["oren-nayar", "OrenNayar"],
    },
    Mutation {
        fault: "weight without π: missing factor",
        file: "crates/brdf/src/diffuse/cosine.rs",
        find: "let weight = f.scale(BsdfReal::<B>::PI);",
        replace: "let weight = f;",
        filters: &["oren-nayar"],
    },
];
