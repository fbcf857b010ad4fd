//! Two phase functions in one.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::Phase;
use crate::medium::Volume;

/// `(1 − w)` of one phase function and `w` of another.
///
/// # Source
/// Mitsuba 3's `blendphase`.
#[derive(Clone, Debug)]
pub struct BlendPhase {
    /// w, the share of the second; values above 1 count as 1.
    pub weight: Volume,
    /// Both.
    pub parts: [Phase; 2],
}

impl BlendPhase {
    #[inline]
    fn weight_at(&self, position: Vec3) -> f32 {
        self.weight.value_at(position).min(1.0)
    }

    /// Out of line, so that other phase functions do not pay for it.
    #[inline(never)]
    pub(super) fn eval(&self, position: Vec3, along: Vec3, to: Vec3) -> f32 {
        let weight = self.weight_at(position);
        let [first, second] = [0, 1].map(|part: usize| self.parts[part].eval(position, along, to));
        (1.0 - weight) * first + weight * second
    }

    /// By one of both, which the first uniform chooses: what is left of it is uniform again.
    #[inline(never)]
    pub(super) fn sample(&self, position: Vec3, along: Vec3, [u, v]: [f32; 2]) -> (Vec3, f32) {
        let weight = self.weight_at(position);
        let (chosen, share, rest) = if u < weight {
            (1, weight, u / weight)
        } else {
            (0, 1.0 - weight, (u - weight) / (1.0 - weight))
        };
        let rest = Real::min(rest, f32::ONE_MINUS_EPSILON);
        let (to, density) = self.parts[chosen].sample(position, along, [rest, v]);
        let other = self.parts[1 - chosen].eval(position, along, to);
        (to, share * density + (1.0 - share) * other)
    }
}
