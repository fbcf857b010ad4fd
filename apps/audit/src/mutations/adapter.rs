//! Models made of other models.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "density of the inner model not scaled: wrong factor",
        file: "crates/brdf/src/adapter/mask.rs",
        find: "(f.scale(self.opacity), pdf * self.opacity)",
        replace: "(f.scale(self.opacity), pdf)",
        filters: &["mask"],
    },
    Mutation {
        fault: "lobe number not stretched after it was used: correlated choice",
        file: "crates/brdf/src/adapter/mask.rs",
        find: "(u_lobe / self.opacity).min(BsdfReal::<B>::ONE_MINUS_EPSILON)",
        replace: "u_lobe",
        filters: &["mask"],
    },
    Mutation {
        fault: "light passes through an opaque mask: wrong probability",
        file: "crates/brdf/src/adapter/mask.rs",
        find: "density: Density::Delta(one - self.opacity),",
        replace: "density: Density::Delta(one),",
        filters: &["mask"],
    },
    Mutation {
        fault: "back seen with the front's light: lost mirror image",
        file: "crates/brdf/src/adapter/two_sided.rs",
        find: "self.back.eval_pdf(wo.flip_z(), wi.flip_z())",
        replace: "self.back.eval_pdf(wo.flip_z(), wi)",
        filters: &["two-sided"],
    },
    Mutation {
        fault: "front and back exchanged",
        file: "crates/brdf/src/adapter/two_sided.rs",
        find: "            self.back.albedo(wo.flip_z())",
        replace: "            self.front.albedo(wo.flip_z())",
        filters: &["two-sided"],
    },
    Mutation {
        fault: "densities of a blend exchanged: swapped weights",
        file: "crates/brdf/src/adapter/blend.rs",
        find: "(pdf * rest + other * w).min(max)",
        replace: "(pdf * w + other * rest).min(max)",
        filters: &["blend"],
    },
];
