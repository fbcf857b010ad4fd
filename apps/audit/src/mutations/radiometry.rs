//! Quantities of lights, and absorption.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "flux of a point by 2π for 4π: half a sphere",
        file: "crates/brdf/src/radiometry.rs",
        find: "scaled(intensity, C::Real::lit(4.0) * C::Real::PI)",
        replace: "scaled(intensity, C::Real::TWO * C::Real::PI)",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "exitance of an area by 2π: lost cosine",
        file: "crates/brdf/src/radiometry.rs",
        find: "pub fn exitance_of_radiance<C: Spectrum>(radiance: C) -> C {\n    scaled(radiance, C::Real::PI)",
        replace: "pub fn exitance_of_radiance<C: Spectrum>(radiance: C) -> C {\n    scaled(radiance, C::Real::TWO * C::Real::PI)",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "density per area by the distance: missing square",
        file: "crates/brdf/src/radiometry.rs",
        find: "over_square(positive(pdf) * positive(cos_light.abs()), distance)",
        replace: "over_square(positive(pdf) * positive(cos_light.abs()) * distance, distance)",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "density per solid angle times the cosine: inverted factor",
        file: "crates/brdf/src/radiometry.rs",
        find: "(distance * (positive(pdf) * distance / cos))",
        replace: "(distance * (positive(pdf) * distance * cos))",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "irradiance without the cosine: missing factor",
        file: "crates/brdf/src/radiometry.rs",
        find: "intensity.map(|i| over_square(positive(i) * cos, distance))",
        replace: "intensity.map(|i| over_square(positive(i) + C::Real::ZERO * cos, distance))",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "spot's falloff linear: lost smooth step",
        file: "crates/brdf/src/radiometry.rs",
        find: "t * t * (T::lit(3.0) - T::TWO * t)",
        replace: "t",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "spot's solid angle by 2π of both cones: lost half",
        file: "crates/brdf/src/radiometry.rs",
        find: "T::PI * (self.beam + self.cutoff)",
        replace: "T::TWO * T::PI * (self.beam + self.cutoff)",
        filters: &["radiometry"],
    },
    Mutation {
        fault: "absorption with the sign of gain",
        file: "crates/brdf/src/absorption.rs",
        find: "self.0.map(|sigma| (-(sigma * distance)).exp())",
        replace: "self.0.map(|sigma| (sigma * distance).exp())",
        filters: &["Absorption"],
    },
    Mutation {
        fault: "coefficient of a colour by log₂: wrong logarithm",
        file: "crates/brdf/src/absorption.rs",
        find: "-t.ln() / distance",
        replace: "-t.ln() / C::Real::lit(core::f64::consts::LN_2) / distance",
        filters: &["Absorption"],
    },
    Mutation {
        fault: "layer crossed along the normal: lost 1/cos θ",
        file: "crates/brdf/src/param.rs",
        find: "(-tau / cos.abs()).exp() } else",
        replace: "(-tau * cos.abs()).exp() } else",
        filters: &["Absorption", "absorbing-slab"],
    },
    Mutation {
        fault: "absorptance by 1 − exp: naive form",
        file: "crates/brdf/src/param.rs",
        find: "-(-tau / cos.abs()).exp_m1()",
        replace: "C::Real::ONE - (-tau / cos.abs()).exp()",
        filters: &["Absorption", "absorbing-slab"],
    },
];
