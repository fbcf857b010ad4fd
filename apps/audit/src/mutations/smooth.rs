//! Surfaces without roughness.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "radiance not scaled across: missing 1/η²",
        file: "crates/brdf/src/smooth/smooth_dielectric.rs",
        find: "weight: self.specular_transmittance.scale(one / (eta * eta)),",
        replace: "weight: self.specular_transmittance,",
        filters: &["smooth-dielectric"],
    },
    Mutation {
        fault: "refraction from below with the index from above: wrong side",
        file: "crates/brdf/src/smooth/smooth_dielectric.rs",
        find: "(wo.flip_z(), RelativeIndex::from_below(self.eta))",
        replace: "(wo.flip_z(), RelativeIndex::from_above(self.eta))",
        filters: &["smooth-dielectric"],
    },
    Mutation {
        fault: "refracted ray not turned back: lost mirror image",
        file: "crates/brdf/src/smooth/smooth_dielectric.rs",
        find: "Some(if below { Sample { wi: sample.wi.flip_z(), ..sample } } else { sample })",
        replace: "let _ = below;\n        Some(sample)",
        filters: &["smooth-dielectric"],
    },
    Mutation {
        fault: "probability of refraction F for 1 − F: wrong factor",
        file: "crates/brdf/src/smooth/smooth_dielectric.rs",
        find: "density: Density::Delta(one - reflectance),",
        replace: "density: Density::Delta(reflectance),",
        filters: &["smooth-dielectric"],
    },
    Mutation {
        fault: "slab of one reflection: R for 2R/(1 + R)",
        file: "crates/brdf/src/smooth/thin_dielectric.rs",
        find: "[C::Real::TWO * r / (one + r), (one - r) / (one + r)]",
        replace: "[r, one - r]",
        filters: &["thin-dielectric", "ThinDielectric"],
    },
    Mutation {
        fault: "slab's transmission as 1 − R': naive form",
        file: "crates/brdf/src/smooth/thin_dielectric.rs",
        find: "[C::Real::TWO * r / (one + r), (one - r) / (one + r)]",
        replace: "[C::Real::TWO * r / (one + r), one - C::Real::TWO * r / (one + r)]",
        filters: &["thin-dielectric", "ThinDielectric"],
    },
    Mutation {
        fault: "mirror direction is the view direction: wrong sign",
        file: "crates/brdf/src/direction.rs",
        find: "    V::new(-w.x(), -w.y(), w.z())",
        replace: "    V::new(w.x(), w.y(), w.z())",
        filters: &["smooth-conductor"],
    },
    Mutation {
        fault: "half vector of opposite directions divides by 0: lost test",
        file: "crates/brdf/src/direction.rs",
        find: "if !(squared > V::Scalar::ZERO) {",
        replace: "if squared.is_nan() {",
        filters: &["half_vector", "rough-conductor"],
    },
    Mutation {
        fault: "absorption along the incident ray: swapped angle",
        file: "crates/brdf/src/smooth/absorbing_slab.rs",
        find: "let cos_t = g / self.eta;",
        replace: "let cos_t = cos + C::Real::ZERO * g;",
        filters: &["absorbing-slab", "AbsorbingSlab"],
    },
    Mutation {
        fault: "slab's reflections absorbed on one way: p for p²",
        file: "crates/brdf/src/smooth/absorbing_slab.rs",
        find: "(lose + pass * t) * (one + r * pass)",
        replace: "(lose + pass * t) * (one + r)",
        filters: &["absorbing-slab", "AbsorbingSlab"],
    },
    Mutation {
        fault: "slab's second face without its transmission: lost factor",
        file: "crates/brdf/src/smooth/absorbing_slab.rs",
        find: "(pass * t * (t / sum)).min(one)",
        replace: "(pass * (t / sum)).min(one)",
        filters: &["absorbing-slab", "AbsorbingSlab"],
    },
    Mutation {
        fault: "slab's mirror share from one face: lost term",
        file: "crates/brdf/src/smooth/absorbing_slab.rs",
        find: "C::Real::TWO * pass * pass * t;",
        replace: "pass * pass * t;",
        filters: &["absorbing-slab", "AbsorbingSlab"],
    },
];
