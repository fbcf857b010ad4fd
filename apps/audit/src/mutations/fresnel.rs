//! Fresnel reflectances.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "η² − 1 of a rounded square: naive form",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "k: excess * (eta + T::ONE), given: eta, side: Side::Above",
        replace: "k: eta * eta - T::ONE, given: eta, side: Side::Above",
        filters: &["fresnel", "dielectric"],
    },
    Mutation {
        fault: "1/η − 1 of a rounded quotient: naive form",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "let (inverse, excess) = (T::ONE / eta, -(eta - T::ONE) / eta);",
        replace: "let (inverse, excess) = (T::ONE / eta, T::ONE / eta - T::ONE);",
        filters: &["dielectric"],
    },
    Mutation {
        fault: "radicand rounded at the critical angle: lost second half",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "        if self.k < T::ZERO && g2.abs() <= self.k * T::lit(-1.0 / 256.0) {\n            g2 = self.critical_radicand(c);\n        }\n",
        replace: "",
        filters: &["dielectric", "fresnel"],
    },
    Mutation {
        fault: "parallel amplitude with the wrong sign",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "let q = (c * sum - T::ONE) / (c * (self.k / sum) + T::ONE);",
        replace: "let q = (c * sum + T::ONE) / (c * (self.k / sum) + T::ONE);",
        filters: &["dielectric", "fresnel"],
    },
    Mutation {
        fault: "one polarisation counted twice: swapped quantity",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "(T::HALF * (rs + rp)).min(limit)",
        replace: "(T::HALF * (rs + rs)).min(limit)",
        filters: &["dielectric", "fresnel"],
    },
    Mutation {
        fault: "transmittance with η for 1/η: swapped factor",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "let p = self.eta * c + g / self.eta;",
        replace: "let p = c / self.eta + g * self.eta;",
        filters: &["dielectric", "plastic"],
    },
    Mutation {
        fault: "reflectance reaches 1 below total reflection: lost clamp",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "let limit = if c > T::ZERO { T::ONE_MINUS_EPSILON } else { T::ONE };",
        replace: "let limit = T::ONE;",
        filters: &["fresnel", "dielectric"],
    },
    Mutation {
        fault: "half vector of refraction with η² − 1 for η − 1: wrong factor",
        file: "crates/brdf/src/fresnel/relative_index.rs",
        find: "(wo + wi) + wi * self.excess",
        replace: "(wo + wi) + wi * self.k",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "conductor without k in the interior: lost term",
        file: "crates/brdf/src/fresnel/conductor.rs",
        find: "let d = (eta - T::ONE) * (eta + T::ONE) - k * k;",
        replace: "let d = (eta - T::ONE) * (eta + T::ONE);",
        filters: &["conductor"],
    },
    Mutation {
        fault: "a − c where it cancels: naive form",
        file: "crates/brdf/src/fresnel/conductor.rs",
        find: "let difference = if b < T::HALF { d + b2 } else { (a - c) * sum };",
        replace: "let difference = (a - c) * sum;",
        filters: &["conductor"],
    },
    Mutation {
        fault: "conductor with s² for c²: swapped angle",
        file: "crates/brdf/src/fresnel/conductor.rs",
        find: "let t = d + c * c;",
        replace: "let t = d + s2;",
        filters: &["conductor"],
    },
    Mutation {
        fault: "refracted ray with the wrong length: missing 1/η",
        file: "crates/brdf/src/fresnel/refraction.rs",
        find: "direction: V::new(-w.x(), -w.y(), -g).try_normalize(),",
        replace: "direction: V::new(-w.x(), -w.y(), -g / index.eta()).try_normalize(),",
        filters: &["dielectric"],
    },
    Mutation {
        fault: "internal average without η²: missing factor",
        file: "crates/brdf/src/fresnel/average.rs",
        find: "return eta * eta * transmitted(1.0 / eta);",
        replace: "return eta * transmitted(1.0 / eta);",
        filters: &["plastic"],
    },
    Mutation {
        fault: "average without its Jacobian: 2 for 4t",
        file: "crates/brdf/src/fresnel/average.rs",
        find: "(start + length * t * t, 4.0 * w * t))",
        replace: "(start + length * t * t, 2.0 * w))",
        filters: &["plastic"],
    },
];
