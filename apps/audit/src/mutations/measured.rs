//! Tables of measurements.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "green's scale for red: swapped constants",
        file: "crates/brdf/src/measured/table.rs",
        find: "[1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0]",
        replace: "[1.15 / 1500.0, 1.0 / 1500.0, 1.66 / 1500.0]",
        filters: &["Measured"],
    },
    Mutation {
        fault: "φd before θd: swapped strides",
        file: "crates/brdf/src/measured/table.rs",
        find: "channel * ENTRIES + (h * SIZE[1] + d) * SIZE[2] + phi",
        replace: "channel * ENTRIES + (h * SIZE[2] + phi) * SIZE[1] + d",
        filters: &["Measured"],
    },
    Mutation {
        fault: "channels interleaved: wrong layout",
        file: "crates/brdf/src/measured/table.rs",
        find: "let entry = self.entry(channel * ENTRIES +",
        replace: "let entry = self.entry(channel +",
        filters: &["Measured"],
    },
    Mutation {
        fault: "rings of θh evenly spaced: lost root",
        file: "crates/brdf/src/measured/merl.rs",
        find: "Real::sqrt((theta_h / (f64::PI * 0.5)).max(0.0)) * RINGS as f64",
        replace: "(theta_h / (f64::PI * 0.5)).max(0.0) * RINGS as f64",
        filters: &["Measured"],
    },
    Mutation {
        fault: "bins read from their edges: lost half bin",
        file: "crates/brdf/src/measured/merl.rs",
        find: "let x = Real::clamp_to(x - 0.5, 0.0, last as f64);",
        replace: "let x = Real::clamp_to(x, 0.0, last as f64);",
        filters: &["Measured"],
    },
    Mutation {
        fault: "φd interpolated the wrong way round",
        file: "crates/brdf/src/measured/merl.rs",
        find: "[(low % count, 1.0 - t), ((low + 1) % count, t)]",
        replace: "[(low % count, t), ((low + 1) % count, 1.0 - t)]",
        filters: &["Measured"],
    },
    Mutation {
        fault: "φd not brought into [0, π]: lost symmetry",
        file: "crates/brdf/src/measured/half_difference.rs",
        find: "if turned { (-x, -y) } else { (x, y) };",
        replace: "if turned { (x, -y) } else { (x, y) };",
        filters: &["Measured"],
    },
    Mutation {
        fault: "difference not turned by θh: lost rotation",
        file: "crates/brdf/src/measured/half_difference.rs",
        find: "(difference.x * c + difference.y * s) * h.z - difference.z * sin;",
        replace: "difference.x * c + difference.y * s;",
        filters: &["Measured"],
    },
    Mutation {
        fault: "θd of the whole angle between the directions: lost half",
        file: "crates/brdf/src/measured/half_difference.rs",
        find: "Real::atan2(Vector3::length(difference) * 0.5, cos)",
        replace: "Real::atan2(Vector3::length(difference), cos)",
        filters: &["Measured"],
    },
];
