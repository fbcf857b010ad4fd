//! Surfaces of microfacets.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "density of a reflected facet with 2 for 4: missing Jacobian",
        file: "crates/brdf/src/rough/rough_conductor.rs",
        find: "let area = T::lit(4.0) * area;",
        replace: "let area = T::TWO * area;",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "Fresnel of the macroscopic angle: swapped angle",
        file: "crates/brdf/src/rough/rough_conductor.rs",
        find: "(self.reflectance(cos).scale(lobe), density(",
        replace: "(self.reflectance(wo.z()).scale(lobe), density(",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "Fresnel of the macroscopic angle in value and weight alike: swapped angle",
        file: "crates/brdf/src/smooth/smooth_conductor.rs",
        find: "ior.eta().zip(ior.k(), |eta, k| fresnel::conductor_of_valid(cos, eta, k))",
        replace: "ior.eta().zip(ior.k(), |eta, k| fresnel::conductor_of_valid(cos * cos, eta, k))",
        filters: &["conductor"],
    },
    Mutation {
        fault: "refraction without its Jacobian η²: missing factor",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "let pdf = d * eta * eta / facets.projected_area(wo);",
        replace: "let pdf = d / facets.projected_area(wo);",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "refraction with |l| for |l|²: missing Jacobian",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "let squared = l.length_squared();",
        replace: "let squared = l.length();",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "refraction with F for 1 − F in value and weight alike",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "let t = index.transmittance_of_pair(cos_o, eta * cos_i);",
        replace: "let t = T::ONE - index.transmittance_of_pair(cos_o, eta * cos_i);",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "radiance not scaled across a rough surface: missing 1/η²",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "self.specular_transmittance.scale(one / (eta * eta))",
        replace: "self.specular_transmittance",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "facets seen from behind: lost test",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "if !(cos_o > T::ZERO && cos_i > T::ZERO) {",
        replace: "if cos_o.is_nan() || cos_i.is_nan() {",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "value beyond the largest number: lost clamp",
        file: "crates/brdf/src/rough/rough_conductor.rs",
        find: "(d * self.facets.visibility(wo, wi)).min(C::Real::MAX)",
        replace: "d * self.facets.visibility(wo, wi)",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "compensation without the average loss: missing factor",
        file: "crates/brdf/src/rough/kulla_conty.rs",
        find: "C::Real::FRAC_1_PI / lost }",
        replace: "C::Real::FRAC_1_PI }",
        filters: &["kulla-conty"],
    },
    Mutation {
        fault: "compensation of the viewer's loss twice: swapped angle",
        file: "crates/brdf/src/rough/kulla_conty.rs",
        find: "self.multiple.scale(lost * self.loss.at(wi.z()))",
        replace: "self.multiple.scale(lost * lost)",
        filters: &["kulla-conty"],
    },
];
