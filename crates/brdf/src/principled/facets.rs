//! Widths of the main lobes.

use etendue_math::Real;

use crate::{Alpha, Distribution, Masking, Microfacets};

/// GGX facets with separable masking.
///
/// ```text
/// a = √(1 − 0.9 anisotropic),  αx = max(0.001, roughness² / a),  αy = max(0.001, roughness² a)
/// ```
///
/// # Source
/// B. Burley, SIGGRAPH 2012 course notes, section 5.4; the limit is Mitsuba's.
pub(super) fn facets<T: Real>(roughness: T, anisotropic: T) -> Microfacets<T> {
    let aspect = (T::ONE - T::lit(0.9) * anisotropic).safe_sqrt();
    let squared = roughness * roughness;
    let width = |a: T| Alpha::clamped(a.max(T::lit(0.001)));
    let [x, y] = [width(squared / aspect), width(squared * aspect)];
    Microfacets::new(Distribution::Ggx, x, y, Masking::Separable)
}
