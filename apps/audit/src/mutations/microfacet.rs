//! Facet distributions and their masking.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "GGX in terms of the cosine: naive form",
        file: "crates/brdf/src/microfacet/ggx.rs",
        find: "let e = x * x + y * y + h.z() * h.z();",
        replace: "let e = (T::ONE + (alpha_x * alpha_x - T::ONE) * h.z() * h.z()) / (alpha_x * alpha_x) + T::ZERO * (x + y);",
        filters: &["ggx", "rough-conductor"],
    },
    Mutation {
        fault: "GGX without 1/π: wrong constant",
        file: "crates/brdf/src/microfacet/ggx.rs",
        find: "T::FRAC_1_PI / ((alpha_x * e) * (alpha_y * e))",
        replace: "T::lit(0.3) / ((alpha_x * e) * (alpha_y * e))",
        filters: &["microfacets", "rough-conductor", "ggx"],
    },
    Mutation {
        fault: "GGX squared width: α for α²",
        file: "crates/brdf/src/microfacet/ggx.rs",
        find: "let (x, y) = (h.x() / alpha_x, h.y() / alpha_y);",
        replace: "let (x, y) = (h.x() / alpha_y, h.y() / alpha_x);",
        filters: &["microfacets", "rough-conductor"],
    },
    Mutation {
        fault: "GGX projected area without ½: wrong factor",
        file: "crates/brdf/src/microfacet/ggx.rs",
        find: "    T::HALF * (z + (z * z + x * x + y * y).sqrt())",
        replace: "    (z + (z * z + x * x + y * y).sqrt())",
        filters: &["microfacets", "rough-conductor"],
    },
    Mutation {
        fault: "projected area with swapped widths",
        file: "crates/brdf/src/microfacet/ggx.rs",
        find: "pub fn projected_area<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {\n    let (x, y, z) = (alpha_x * w.x(), alpha_y * w.y(), w.z());",
        replace: "pub fn projected_area<T: Real>(w: Vec3<T>, alpha_x: T, alpha_y: T) -> T {\n    let (x, y, z) = (alpha_y * w.x(), alpha_x * w.y(), w.z());",
        filters: &["microfacets", "rough-conductor"],
    },
    Mutation {
        fault: "Beckmann without the fourth power of the cosine: missing Jacobian",
        file: "crates/brdf/src/microfacet/beckmann.rs",
        find: "weight * T::FRAC_1_PI / ((alpha_x * z2) * (alpha_y * z2))",
        replace: "weight * T::FRAC_1_PI / ((alpha_x * z2) * alpha_y)",
        filters: &["microfacets", "beckmann"],
    },
    Mutation {
        fault: "Beckmann exponent without hz²: sine for tangent",
        file: "crates/brdf/src/microfacet/beckmann.rs",
        find: "let (x, y) = (h.x() / (alpha_x * h.z()), h.y() / (alpha_y * h.z()));",
        replace: "let (x, y) = (h.x() / alpha_x, h.y() / alpha_y);",
        filters: &["microfacets", "beckmann"],
    },
    Mutation {
        fault: "Beckmann masking with 1/π for 1/√π: wrong constant",
        file: "crates/brdf/src/microfacet/beckmann.rs",
        find: "s * (-a * a).exp() * T::lit(FRAC_1_SQRT_PI))",
        replace: "s * (-a * a).exp() * T::FRAC_1_PI)",
        filters: &["microfacets", "rough-conductor"],
    },
    Mutation {
        fault: "fit of G1 with 2.577 for 2.181: wrong coefficient",
        file: "crates/brdf/src/microfacet/beckmann.rs",
        find: "(T::lit(3.535) + a * T::lit(2.181))",
        replace: "(T::lit(3.535) + a * T::lit(2.577))",
        filters: &["microfacets", "rough-conductor"],
    },
    Mutation {
        fault: "Beckmann normals mirrored: wrong sign",
        file: "crates/brdf/src/microfacet/beckmann.rs",
        find: "        -alpha_x * (cos_phi * along - sin_phi * across),",
        replace: "        alpha_x * (cos_phi * along - sin_phi * across),",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "correlated masking with swapped cosines",
        file: "crates/brdf/src/microfacet/smith.rs",
        find: "o * area_i + i * (area_o - o)",
        replace: "i * area_i + o * (area_o - o)",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "correlated masking forgets the shared height: lost term",
        file: "crates/brdf/src/microfacet/smith.rs",
        find: "o * area_i + i * (area_o - o)",
        replace: "o * area_i + i * area_o",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "weight of a visible normal without the cosine",
        file: "crates/brdf/src/microfacet/smith.rs",
        find: "T::lit(4.0) * wi.z().abs() * area * self.visibility(wo, wi)",
        replace: "T::lit(4.0) * area * self.visibility(wo, wi)",
        filters: &["rough-conductor"],
    },
];
