//! Powers of cosines.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "normalisation by n + 1 for n + 2: wrong constant",
        file: "crates/brdf/src/phong/modified_phong.rs",
        find: "lobe(self.exponent + C::Real::TWO)",
        replace: "lobe(self.exponent + one)",
        filters: &["phong"],
    },
    Mutation {
        fault: "density by n + 2 for n + 1: wrong constant",
        file: "crates/brdf/src/phong/modified_phong.rs",
        find: "lobe(self.exponent + one)",
        replace: "lobe(self.exponent + C::Real::TWO)",
        filters: &["phong"],
    },
    Mutation {
        fault: "half vectors without their Jacobian: 4 h·wo for 1",
        file: "crates/brdf/src/phong/ashikhmin_shirley_specular.rs",
        find: "self.half_vectors.pdf_wide(sum) / (4.0 * cos)",
        replace: "self.half_vectors.pdf_wide(sum)",
        filters: &["ashikhmin-shirley-specular"],
    },
    Mutation {
        fault: "the smaller cosine in the denominator: swapped angle",
        file: "crates/brdf/src/phong/ashikhmin_shirley_specular.rs",
        find: "narrow(pdf / o.z.max(i.z))",
        replace: "narrow(pdf / o.z.min(i.z))",
        filters: &["ashikhmin-shirley-specular"],
    },
    Mutation {
        fault: "exponents exchanged",
        file: "crates/brdf/src/phong/half_vectors.rs",
        find: "let exponent = nu * x2 + nv * y2;",
        replace: "let exponent = nv * x2 + nu * y2;",
        filters: &["ashikhmin-shirley-specular", "PhongHalfVectors"],
    },
    Mutation {
        fault: "power of the cosine by its logarithm: naive form",
        file: "crates/brdf/src/phong/half_vectors.rs",
        find: "Real::exp(-0.5 * exponent / s2 * Real::ln_1p(s2 / z2))",
        replace: "Real::exp(exponent / s2 * Real::ln(f64::from((z2 / (s2 + z2)).sqrt() as f32)))",
        filters: &["PhongHalfVectors"],
    },
    Mutation {
        fault: "28/(13π) for 28/(23π): wrong constant",
        file: "crates/brdf/src/phong/ashikhmin_shirley_diffuse.rs",
        find: "C::Real::lit(28.0 / (23.0 * core::f64::consts::PI))",
        replace: "C::Real::lit(28.0 / (13.0 * core::f64::consts::PI))",
        filters: &["ashikhmin-shirley-diffuse"],
    },
    Mutation {
        fault: "(1 − cos)⁵ for (1 − cos/2)⁵: missing factor",
        file: "crates/brdf/src/phong/ashikhmin_shirley_diffuse.rs",
        find: "let x = mu.min(T::ONE) * T::HALF;",
        replace: "let x = mu.min(T::ONE);",
        filters: &["ashikhmin-shirley-diffuse"],
    },
];
