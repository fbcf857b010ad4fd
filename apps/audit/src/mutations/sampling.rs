//! Random numbers, warps and weights.

use super::Mutation;

pub(super) const MUTATIONS: &[Mutation] = &[
    Mutation {
        fault: "cosine from rounded coordinates: naive form",
        file: "crates/sampling/src/warp/cosine_hemisphere.rs",
        find: "point.one_minus_radius_squared.sqrt())",
        replace: "(T::ONE - point.x * point.x - point.y * point.y).safe_sqrt())",
        filters: &["cosine_hemisphere"],
    },
    Mutation {
        fault: "density without 1/π: wrong factor",
        file: "crates/sampling/src/warp/cosine_hemisphere.rs",
        find: "    w.z().max(T::ZERO) * T::FRAC_1_PI\n",
        replace: "    w.z().max(T::ZERO)\n",
        filters: &["lambert"],
    },
    Mutation {
        fault: "uniform of 32 bits: naive form",
        file: "crates/math/src/real.rs",
        find: "(bits >> (64 - $float::MANTISSA_DIGITS)) as $float * SCALE",
        replace: "(bits >> 32) as $float / 4294967296.0",
        filters: &["Real::from_random_bits"],
    },
    Mutation {
        fault: "1 − √(1 − s²): naive form",
        file: "crates/sampling/src/warp/cone.rs",
        find: "s * s / (T::ONE + ((T::ONE - s) * (T::ONE + s)).sqrt())",
        replace: "T::ONE - (T::ONE - s * s).sqrt()",
        filters: &["Cone"],
    },
    Mutation {
        fault: "power heuristic with exponent 1: wrong exponent",
        file: "crates/sampling/src/mis.rs",
        find: "|q| T::ONE / (T::ONE + q * q))",
        replace: "|q| T::ONE / (T::ONE + q * q * q))",
        filters: &["mis::power"],
    },
    Mutation {
        fault: "inverse error function with one Newton step: too few steps",
        file: "crates/math/src/special.rs",
        find: "for _ in 0..2 {",
        replace: "for _ in 0..0 {",
        filters: &["rough-conductor"],
    },
];
