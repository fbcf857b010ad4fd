//! OpenPBR's surface.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "layers weighted by the viewer alone: not reciprocal",
        file: "crates/brdf/src/openpbr/surface.rs",
        find: "row.at(places[0]).min(row.at(places[1]))",
        replace: "row.at(places[0])",
        filters: &["open-pbr"],
    },
    Mutation {
        fault: "diffuse base without normalisation of the coupled product: lost factor",
        file: "crates/brdf/src/openpbr/base.rs",
        find: "scale: dielectric / through.average()",
        replace: "scale: dielectric / through.average().sqr()",
        filters: &["open-pbr"],
    },
    Mutation {
        fault: "density of the coat without the choice of lobe: wrong factor",
        file: "crates/brdf/src/openpbr/surface.rs",
        find: "pdf += choice.coat * density;",
        replace: "pdf += density;",
        filters: &["open-pbr"],
    },
    Mutation {
        fault: "mirrors of coat and base share a direction but not their probability: lost term",
        file: "crates/brdf/src/openpbr/surface.rs",
        find: "probability += choice.specular;",
        replace: "probability += choice.specular * C::Real::HALF;",
        filters: &["open-pbr"],
    },
    Mutation {
        fault: "fuzz masked by the viewer alone: not reciprocal",
        file: "crates/brdf/src/openpbr/fuzz.rs",
        find: "let area = wi.z() * area_o + wo.z() * (area_i - wi.z());",
        replace: "let area = wi.z() * area_o;",
        filters: &["open-pbr"],
    },
];
