//! A base under an interface.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "base without 1/η²: missing factor",
        file: "crates/brdf/src/layered/plastic.rs",
        find: "self.base.scale(t * self.interface.inverse_eta_squared * C::Real::FRAC_1_PI)",
        replace: "self.base.scale(t * C::Real::FRAC_1_PI)",
        filters: &["plastic"],
    },
    Mutation {
        fault: "density without the choice of lobe: wrong factor",
        file: "crates/brdf/src/layered/plastic.rs",
        find: "(C::Real::ONE - mirror) * cosine_hemisphere::pdf::<C::Real>(wi),",
        replace: "cosine_hemisphere::pdf::<C::Real>(wi),",
        filters: &["plastic"],
    },
    Mutation {
        fault: "light enters but does not leave through the interface: lost factor",
        file: "crates/brdf/src/layered/plastic.rs",
        find: "let t = t * self.transmittance(wi.z());\n        (",
        replace: "let t = t * self.transmittance(wo.z());\n        (",
        filters: &["plastic"],
    },
    Mutation {
        fault: "base without internal reflections: lost series",
        file: "crates/brdf/src/layered/internal_scattering.rs",
        find: "Self::Linear => diffuse.scale(one / (one - internal)),",
        replace: "Self::Linear => diffuse.scale(one + internal * C::Real::ZERO),",
        filters: &["plastic"],
    },
    Mutation {
        fault: "internal reflections lose ρ once too often",
        file: "crates/brdf/src/layered/internal_scattering.rs",
        find: "diffuse.map(|rho| rho / (one - rho * internal))",
        replace: "diffuse.map(|rho| rho / (one - rho * rho * internal))",
        filters: &["plastic"],
    },
    Mutation {
        fault: "mixture without its second density: lost term",
        file: "crates/brdf/src/layered/rough_plastic.rs",
        find: "            + (C::Real::ONE - p) * cosine_hemisphere::pdf::<C::Real>(wi);",
        replace: "            + (C::Real::ZERO * p) * cosine_hemisphere::pdf::<C::Real>(wi);",
        filters: &["rough-plastic", "TransmittanceTable"],
    },
    Mutation {
        fault: "rough base without 1/η²: missing factor",
        file: "crates/brdf/src/layered/rough_plastic.rs",
        find: "let factor = C::Real::FRAC_1_PI / (table.eta() * table.eta());",
        replace: "let factor = C::Real::FRAC_1_PI;",
        filters: &["rough-plastic", "TransmittanceTable"],
    },
    Mutation {
        fault: "rough interface forgets to let light out: lost factor",
        file: "crates/brdf/src/layered/rough_plastic.rs",
        find: "self.base.scale(t * self.table.transmittance(wi.z()))",
        replace: "self.base.scale(t)",
        filters: &["rough-plastic", "TransmittanceTable"],
    },
    Mutation {
        fault: "table read a node too far: off by one",
        file: "crates/brdf/src/layered/transmittance_table.rs",
        find: "self.transmittance[i] * (T::ONE - t) + self.transmittance[i + 1] * t",
        replace: "self.transmittance[i + 1] * (T::ONE - t) + self.transmittance[i] * t",
        filters: &["rough-plastic", "TransmittanceTable"],
    },
    Mutation {
        fault: "20/21 for 21/20 in the matte term: inverted constant",
        file: "crates/brdf/src/layered/coupled_interface.rs",
        find: "C::Real::lit(21.0 / 20.0)",
        replace: "C::Real::lit(20.0 / 21.0)",
        filters: &["coupled"],
    },
    Mutation {
        fault: "matte term of the viewer's angle alone: lost factor",
        file: "crates/brdf/src/layered/layered_fresnel.rs",
        find: "(self.matte * schlick_transmittance(self.r0, cos_i)).scale(C::Real::FRAC_1_PI)",
        replace: "(self.matte * schlick_transmittance(self.r0, cos_i * cos_i)).scale(C::Real::FRAC_1_PI)",
        filters: &["layered-fresnel"],
    },
    Mutation {
        fault: "matte term without 1/π: missing factor",
        file: "crates/brdf/src/layered/layered_linear.rs",
        find: "self.matte.scale(C::Real::FRAC_1_PI)",
        replace: "self.matte.scale(C::Real::ONE)",
        filters: &["layered-linear"],
    },
];
