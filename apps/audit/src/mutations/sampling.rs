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
        fault: "inverse error function without Newton steps: single precision",
        file: "crates/math/src/special.rs",
        find: "for _ in 0..2 {",
        replace: "for _ in 0..0 {",
        filters: &["erf_inv"],
    },
    Mutation {
        fault: "concentric squares with their order exchanged",
        file: "crates/sampling/src/warp/disk.rs",
        find: "let x_first = [along, across, along];",
        replace: "let x_first = [across, along, across];",
        filters: &["warp"],
    },
    Mutation {
        fault: "triangle by two uniforms: lost fold",
        file: "crates/sampling/src/warp/triangle.rs",
        find: "let half = T::HALF * if v > u { u } else { v };",
        replace: "let half = T::HALF * u;",
        filters: &["warp"],
    },
    Mutation {
        fault: "arc of a spherical triangle by the whole excess: lost ½",
        file: "crates/sampling/src/warp/spherical_triangle.rs",
        find: "(T::HALF * u * self.solid_angle).sin_cos()",
        replace: "(u * self.solid_angle).sin_cos()",
        filters: &["warp"],
    },
    Mutation {
        fault: "height in a spherical rectangle evenly spaced: wrong warp",
        file: "crates/sampling/src/warp/spherical_rectangle.rs",
        find: "let y = distance * s / ((T::ONE - s) * (T::ONE + s)).safe_sqrt();",
        replace: "let y = self.y[0] + v * (self.y[1] - self.y[0]) + T::ZERO * s;",
        filters: &["warp"],
    },
    Mutation {
        fault: "sphere seen from inside with the cosine's inverse lost",
        file: "crates/sampling/src/warp/seen_sphere.rs",
        find: "uniform_sphere::pdf(), t * t, normal.dot(direction)",
        replace: "uniform_sphere::pdf(), t * t, T::ONE + T::ZERO * normal.dot(direction)",
        filters: &["warp"],
    },
    Mutation {
        fault: "quarter turns with a wrong sign",
        file: "crates/sampling/src/warp/turn.rs",
        find: "(cos, -sin)",
        replace: "(cos, sin)",
        filters: &["warp"],
    },
];
