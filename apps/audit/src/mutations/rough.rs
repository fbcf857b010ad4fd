//! Surfaces of microfacets.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "density of a reflected facet with 2 for 4: missing Jacobian",
        file: "crates/brdf/src/rough/rough_conductor.rs",
        find: "let area = T::lit(4.0) * facets.projected_area(wo);",
        replace: "let area = T::TWO * facets.projected_area(wo);",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "Fresnel of the macroscopic angle: swapped angle",
        file: "crates/brdf/src/rough/rough_conductor.rs",
        find: "(self.reflectance(cos).scale(lobe), reflection_pdf(&self.facets, wo, d))",
        replace: "(self.reflectance(wo.z() + C::Real::ZERO * cos).scale(lobe), reflection_pdf(&self.facets, wo, d))",
        filters: &["rough-conductor"],
    },
    Mutation {
        fault: "Fresnel of the macroscopic angle in value and weight alike: swapped angle",
        file: "crates/brdf/src/smooth/smooth_conductor.rs",
        find: "ior.eta().zip(ior.k(), |eta, k| fresnel::conductor(cos, eta, k))",
        replace: "ior.eta().zip(ior.k(), |eta, k| fresnel::conductor(cos * cos, eta, k))",
        filters: &["conductor"],
    },
    Mutation {
        fault: "refraction without its Jacobian η²: missing factor",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "let pdf = d * eta * eta / self.facets.projected_area(wo);",
        replace: "let pdf = d / self.facets.projected_area(wo);",
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
        replace: "let t = C::Real::ONE - index.transmittance_of_pair(cos_o, eta * cos_i);",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "radiance not scaled across: missing 1/η²",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "self.specular_transmittance.scale(one / (eta * eta))",
        replace: "self.specular_transmittance",
        filters: &["rough-dielectric"],
    },
    Mutation {
        fault: "facets seen from behind: lost test",
        file: "crates/brdf/src/rough/rough_dielectric.rs",
        find: "if !(cos_o > C::Real::ZERO && cos_i > C::Real::ZERO) {",
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
];
