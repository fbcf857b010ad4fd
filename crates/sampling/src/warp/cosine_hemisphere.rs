//! The cosine-weighted hemisphere around +z, concentric and polar.

use etendue_math::{Real, Vec3, Vector3};

use super::{disk, into_unit, turn};

/// A direction with density cos θ/π on the upper hemisphere, by projecting the concentric disk.
///
/// ```text
/// (x, y) = concentric disk point of u,   z = √(1 − r²)
/// ```
///
/// `u`: uniforms in `[0, 1)`. `u = 0` in either coordinate gives a direction in the horizon, whose
/// density is 0.
///
/// # Precision
/// 4 ulp of each component: `1 − r²` comes from the uniforms, where it is exact, because
/// `√(1 − x² − y²)` is wrong by 3e-4 near the horizon in `f32`.
///
/// # Source
/// Malley's method over Shirley and Chiu 1997.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::cosine_hemisphere;
/// let w = cosine_hemisphere::from_square([0.5_f32, 0.5]);
/// assert_eq!(w.z, 1.0);
/// assert_eq!(cosine_hemisphere::pdf::<f32>(w), std::f32::consts::FRAC_1_PI);
/// ```
#[inline(always)]
pub fn from_square<T: Real>(u: [T; 2]) -> Vec3<T> {
    let point = disk::concentric(u);
    Vec3::<T>::new(point.x, point.y, point.one_minus_radius_squared.sqrt())
}

/// The uniforms of [`from_square`]; absolute precision 8 ε.
#[inline]
pub fn to_square<T: Real>(w: Vec3<T>) -> [T; 2] {
    disk::to_square([w.x(), w.y()])
}

/// A direction with density cos θ/π on the upper hemisphere, in polar coordinates.
///
/// ```text
/// cos θ = √u₀,   sin θ = √(1 − u₀),   φ = 2π u₁
/// ```
///
/// The textbook's map, with an elongated first coordinate; [`from_square`] keeps stratified points
/// better spread. `u₀ = 0` gives a direction in the horizon, whose density is 0.
///
/// # Precision
/// 4 ulp of each component, also where it is close to 0.
///
/// # Source
/// Inversion of the cumulative distribution sin²θ.
#[inline]
pub fn from_square_polar<T: Real>([u, v]: [T; 2]) -> Vec3<T> {
    let sin_theta = (T::ONE - u).safe_sqrt();
    let (sin_phi, cos_phi) = turn::sin_cos(v);
    Vec3::<T>::new(sin_theta * cos_phi, sin_theta * sin_phi, u.safe_sqrt())
}

/// The uniforms of [`from_square_polar`]; absolute precision 4 ε.
#[inline]
pub fn to_square_polar<T: Real>(w: Vec3<T>) -> [T; 2] {
    [into_unit(w.z() * w.z()), turn::from_point(w.x(), w.y())]
}

/// Density per steradian of both maps: `max(z, 0)/π`.
#[inline(always)]
pub fn pdf<T: Real>(w: Vec3<T>) -> T {
    w.z().max(T::ZERO) * T::FRAC_1_PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian};
    use etendue_math::glam::{DVec3, Vec3 as Vec3f};

    /// Uniforms (exact `f32` numbers), direction and density of the polar map, computed at 60
    /// digits.
    #[rustfmt::skip]
    #[allow(clippy::approx_constant, reason = "golden values are kept as computed")]
    const GOLDEN: [([f64; 2], [f64; 3], f64); 20] = [
        ([0.004270383156836033, 0.8994773030281067], [0.8053571104859625, -0.58917700348271, 0.06534816873360746], 0.02080096815191374),
        ([0.5369206666946411, 0.6071256995201111], [-0.5320815339052728, -0.42422703188548805, 0.7327487063752764], 0.2332411573276341),
        ([0.021375130861997604, 0.7490856647491455], [-0.005683175494303286, -0.9892383790847903, 0.14620236271003834], 0.04653765743403358),
        ([0.9032222032546997, 0.9730780124664307], [0.3066511661463741, -0.052372311829526286, 0.9503800309637718], 0.30251535948742564),
        ([0.11112232506275177, 0.27798333764076233], [-0.16491509967917165, 0.9282675717890059, 0.3333501538364003], 0.1061086495270137),
        ([9.99999993922529e-09, 9.99999993922529e-09], [0.999999994999998, 6.28318523757778e-08, 9.999999969612645e-05], 3.183098852165311e-05),
        ([0.9999999403953552, 9.99999993922529e-09], [0.0002441406249999995, 1.5339807785629166e-11, 0.9999999701976772], 0.31830987669741667),
        ([0.9999999403953552, 0.9999999403953552], [0.00024414062499998287, -9.143237995419534e-11, 0.9999999701976772], 0.31830987669741667),
        ([0.9999999403953552, 0.25], [1.3940352776182493e-65, 0.000244140625, 0.9999999701976772], 0.31830987669741667),
        ([9.99999993922529e-09, 0.75], [-1.712990540572352e-61, -0.999999995, 9.999999969612645e-05], 3.183098852165311e-05),
        ([5.960464477539063e-08, 0.25], [5.709968326954025e-62, 0.9999999701976772, 0.000244140625], 7.771237455658952e-05),
        ([0.0, 0.9990000128746033], [0.9999802613643994, -0.006283063073637588, 0.0], 0.0),
        ([9.99999993922529e-09, 0.9999999403953552], [0.9999999949999299, -3.74507026419849e-07, 9.999999969612645e-05], 3.183098852165311e-05),
        ([5.960464477539063e-08, 0.9990000128746033], [0.9999802315626649, -0.006283062886387714, 0.000244140625], 7.771237455658952e-05),
        ([0.5, 5.960464477539063e-08], [0.707106781186498, 2.64816459307567e-07, 0.7071067811865476], 0.22507907903927651),
        ([0.0, 5.960464477539063e-08], [0.9999999999999298, 3.7450702829238413e-07, 0.0], 0.0),
        ([0.5, 0.5363258123397827], [-0.6887684742394449, -0.15999371516990016, 0.7071067811865476], 0.22507907903927651),
        ([9.999999747378752e-05, 0.9990000128746033], [0.9999302611025566, -0.006282748912637621, 0.009999999873689375], 0.003183098821631986),
        ([0.9990000128746033, 9.999999747378752e-05], [0.03162256679363184, 1.9869046818032675e-05, 0.9994998813779836], 0.31815069348213826),
        ([0.0, 0.75], [-1.7129905491373045e-61, -1.0, 0.0], 0.0),
    ];

    #[test]
    fn polar_map_meets_the_golden_values_in_both_precisions() {
        // Miri adds up to 4 ε to std's sines on purpose.
        let roundings = if cfg!(miri) { 7.0 } else { 3.0 };
        for (u, w, pdf_want) in GOLDEN {
            let want = DVec3::from(w);
            let wide = from_square_polar(u);
            let narrow: Vec3f = from_square_polar([u[0] as f32, u[1] as f32]);
            for (got, epsilon) in
                [(wide, f64::EPSILON), (narrow.as_dvec3(), f64::from(f32::EPSILON))]
            {
                for (got, want) in got.to_array().into_iter().zip(want.to_array()) {
                    // Relative for each component; the exact zeros of φ = π/2 are printed as 1e-61.
                    assert!(
                        (got - want).abs() <= roundings * epsilon * want.abs() + 1e-60,
                        "{u:?}"
                    );
                }
            }
            assert!((pdf::<f64>(wide) - pdf_want).abs() <= 2.0 * f64::EPSILON * pdf_want);
            let error = (f64::from(pdf::<f32>(narrow)) - pdf_want).abs();
            assert!(error <= 2.0 * f64::from(f32::EPSILON) * pdf_want, "{u:?}");
        }
    }

    #[test]
    fn inverses_undo_the_maps() {
        let (wide, narrow) = (f64::EPSILON, f64::from(f32::EPSILON));
        check_inverse(from_square::<f64>, to_square::<f64>, 4.0 * wide);
        check_inverse(from_square::<f32>, to_square::<f32>, 4.0 * narrow);
        check_inverse(from_square_polar::<f64>, to_square_polar::<f64>, 4.0 * wide);
        check_inverse(from_square_polar::<f32>, to_square_polar::<f32>, 4.0 * narrow);
    }

    #[test]
    fn density_is_that_of_both_maps() {
        check_jacobian(from_square::<f64>, pdf::<f64>);
        check_jacobian(from_square_polar::<f64>, pdf::<f64>);
        check_density_on_sphere(from_square::<f64>, pdf::<f64>);
        check_density_on_sphere(from_square_polar::<f64>, pdf::<f64>);
    }

    #[test]
    fn directions_near_the_horizon_keep_their_cosine() {
        for k in 1..=24 {
            let u = Real::powi(0.5_f32, k);
            let (narrow, wide): (Vec3f, DVec3) =
                (from_square([u, 0.4]), from_square([f64::from(u), f64::from(0.4_f32)]));
            // One square root of a product known to 2 ulp.
            let error = (f64::from(narrow.z) / wide.z - 1.0).abs();
            assert!(error <= 2.0 * f64::from(f32::EPSILON), "{u}: {error:e}");
        }
    }
}
