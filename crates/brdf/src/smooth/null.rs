//! A surface that is not there.

use core::marker::PhantomData;

use etendue_math::{Real, Spectrum, Vector3};

use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Sample};

/// Pass-through: every direction goes straight on. The index-matched limit of every dielectric.
///
/// ```text
/// wi = −wo,  weight = 1
/// ```
///
/// * Laws: reciprocal; albedo 1. Delta, transmission only.
/// * Sampling: no uniform consumed; `None` for a direction that is zero or not finite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Null<C> {
    color: PhantomData<C>,
}

impl<C: Spectrum> Null<C> {
    /// The absent surface.
    pub fn new() -> Self {
        Self { color: PhantomData }
    }
}

impl<C: Spectrum> Bsdf for Null<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::DELTA_THROUGH
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        _u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let one = <C::Real as Real>::ONE;
        exists(wo).then(|| Sample {
            wi: -wo,
            weight: C::white(),
            density: Density::Delta(one),
            eta: one,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(self.pass_through(wo))
    }

    #[inline]
    fn pass_through(&self, wo: BsdfVec<Self>) -> C {
        if exists(wo) { C::white() } else { C::black() }
    }
}

/// Finite and not zero.
#[inline(always)]
pub(crate) fn exists<V: Vector3>(w: V) -> bool {
    let squared = w.length_squared();
    squared > V::Scalar::ZERO && squared < V::Scalar::INFINITY
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "null",
    type_name: "Null",
    parameters: &[],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::DELTA_THROUGH,
    albedo: Albedo::ClosedForm,
    density: "delta",
    source: "index-matched limit of a dielectric",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    #[test]
    fn light_goes_straight_on() {
        let model = Null::<f64>::new();
        let s = model.sample(DVec3::new(0.6, 0.0, -0.8), 0.0, [0.0; 2]).unwrap();
        assert_eq!((s.wi, s.weight, s.eta), (DVec3::new(-0.6, 0.0, 0.8), 1.0, 1.0));
        laws::total(&model);
    }
}
