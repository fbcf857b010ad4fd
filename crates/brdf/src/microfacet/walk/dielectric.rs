//! The walk between facets of glass.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::{MAX_ORDER, Walked, next_height};
use crate::bsdf::above;
use crate::direction::reflect_about;
use crate::fresnel::{RelativeIndex, refract_about};
use crate::{Ior, Microfacets, ParameterError};

/// Rough interface between two dielectrics, every order of reflection and refraction included.
///
/// Each facet reflects with probability F and refracts otherwise, so that every path carries the whole flux.
/// Seen from the other side the microsurface is the same one upside down: a refracted ray goes on with its
/// direction mirrored in the surface and the height `c → 1 − c`.
///
/// Not a [`Bsdf`](crate::Bsdf): for references and tests; uniforms in `[0, 1)` come from the caller.
///
/// * Laws: reflection and transmission add up to exactly 1 (the flux of a path is `weight η²`). Two-sided.
/// * Paths of order 1 that are reflected are the height-correlated single reflection of
///   [`RoughDielectric`](crate::RoughDielectric).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricWalk<T> {
    from_above: RelativeIndex<T>,
    from_below: RelativeIndex<T>,
    facets: Microfacets<T>,
    max_order: u32,
}

impl<T: Real + Spectrum<Real = T>> DielectricWalk<T> {
    /// The interface to a medium below with relative index `eta`.
    ///
    /// # Errors
    /// [`ParameterError`] for η = 1, where there is no surface to walk on.
    pub fn new(eta: Ior<T>, facets: Microfacets<T>) -> Result<Self, ParameterError> {
        if eta.is_matched() {
            let domain = "different from 1 (use the pass-through model)";
            return Err(ParameterError::number("eta", eta.value(), domain));
        }
        Ok(Self {
            from_above: RelativeIndex::from_above(eta.value()),
            from_below: RelativeIndex::from_below(eta.value()),
            facets,
            max_order: MAX_ORDER,
        })
    }

    /// The same with paths cut at `max_order` facets.
    pub fn with_max_order(self, max_order: u32) -> Self {
        Self { max_order, ..self }
    }

    /// Draws a path seen from `wo`; `None` in the surface's plane and where the path is cut.
    pub fn sample(&self, wo: Vec3<T>, uniform: &mut impl FnMut() -> T) -> Option<Walked<T>> {
        let starts_below = wo.z() < T::ZERO;
        let (near, far) = if starts_below {
            (self.from_below, self.from_above)
        } else {
            (self.from_above, self.from_below)
        };
        let mut w = if starts_below { -wo.flip_z() } else { -wo };
        if !above(-w) {
            return None;
        }
        let (mut c, mut crossed) = (T::ONE, false);
        for order in 0..=self.max_order {
            let Some(next) = next_height(&self.facets, w, c, uniform()) else {
                let wi = if crossed == starts_below { w } else { w.flip_z() };
                let eta = if crossed { near.eta() } else { T::ONE };
                return Some(Walked { wi, weight: T::ONE / (eta * eta), eta, order });
            };
            c = next;
            let h = self.facets.sample_visible_normal(-w, [uniform(), uniform()])?;
            let index = if crossed { far } else { near };
            let cos = (-w.dot(h)).clamp_to(T::ZERO, T::ONE);
            if uniform() < index.reflectance(cos) {
                w = reflect_about(-w, h).try_normalize()?;
            } else {
                w = refract_about(-w, h, index.eta())?.flip_z();
                c = (T::ONE - c).max(T::MIN_POSITIVE);
                crossed = !crossed;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Alpha, Bsdf, RoughDielectric};
    use etendue_math::glam::DVec3;
    use etendue_sampling::{Pcg32, uniform};

    const PATHS: u32 = 40_000;

    fn direction(cos: f64) -> DVec3 {
        DVec3::new((1.0 - cos * cos).sqrt(), 0.0, cos)
    }

    fn stream(seed: u64) -> impl FnMut() -> f64 {
        let mut generator = Pcg32::new(seed, 1);
        move || uniform(&mut generator)
    }

    #[test]
    fn reflection_and_transmission_add_up_to_one_path_by_path() {
        let mut uniforms = stream(3);
        for (alpha, eta) in [(1.0, 1.5), (0.3, 1.0 / 1.5), (0.6, 2.4)] {
            let facets = Microfacets::ggx(Alpha::new(alpha).unwrap());
            let walk = DielectricWalk::new(Ior::new(eta).unwrap(), facets).unwrap();
            for cos in [1.0, 0.5, 0.05, -0.05, -0.5, -1.0] {
                let wo = direction(cos);
                for _ in 0..500 {
                    let path = walk.sample(wo, &mut uniforms).unwrap();
                    let relative = if path.wi.z * cos > 0.0 {
                        1.0
                    } else if cos > 0.0 {
                        eta
                    } else {
                        1.0 / eta
                    };
                    // A quotient and two products.
                    assert!((path.eta / relative - 1.0).abs() < 1e-15, "{path:?}");
                    assert!((path.weight * relative * relative - 1.0).abs() < 1e-15, "{path:?}");
                }
            }
        }
    }

    #[test]
    fn the_first_order_of_reflection_is_single_scattering() {
        let facets = Microfacets::ggx(Alpha::new(0.5).unwrap());
        let eta = Ior::new(1.5).unwrap();
        let walk = DielectricWalk::new(eta, facets).unwrap();
        let single = RoughDielectric::<f64>::new(eta, facets).unwrap();
        let mut uniforms = stream(5);
        for cos in [1.0, 0.4, -0.7, -0.3] {
            let wo = direction(cos);
            let (mut first, mut all, mut want) = (0.0, 0.0, 0.0);
            for _ in 0..PATHS {
                let path = walk.sample(wo, &mut uniforms).unwrap();
                let reflected = f64::from(u8::from(path.wi.z * cos > 0.0));
                all += reflected;
                first += if path.order == 1 { reflected } else { 0.0 };
                let u = [uniforms(), uniforms(), uniforms()];
                let sample = single.sample(wo, u[0], [u[1], u[2]]);
                want += sample.filter(|s| s.wi.z * cos > 0.0).map_or(0.0, |s| s.weight);
            }
            let [first, all, want] = [first, all, want].map(|x| x / f64::from(PATHS));
            // Two means of numbers in [0, 1], five standard errors each.
            let error = 10.0 * (first * (1.0 - first) / f64::from(PATHS)).sqrt();
            assert!((first - want).abs() < error, "{cos} {first} {want} ± {error}");
            assert!(all > first, "{cos}: nothing was reflected more than once");
        }
    }

    #[test]
    fn flux_through_the_surface_is_the_same_both_ways_on_average() {
        // Reciprocity: η² T_from_above averaged over the hemisphere is T_from_below averaged likewise,
        // with the flux of a path counted as 1.
        let eta = 1.5;
        let facets = Microfacets::ggx(Alpha::new(0.7).unwrap());
        let walk = DielectricWalk::new(Ior::new(eta).unwrap(), facets).unwrap();
        let mut uniforms = stream(7);
        let mut transmitted = |side: f64| {
            let mut count = 0_u32;
            for _ in 0..PATHS {
                // Cosine-weighted.
                let wo = direction((1.0 - uniforms()).sqrt());
                let wo = DVec3::new(wo.x, wo.y, side * wo.z);
                let path = walk.sample(wo, &mut uniforms).unwrap();
                count += u32::from(path.wi.z * side < 0.0);
            }
            f64::from(count) / f64::from(PATHS)
        };
        let (down, up) = (transmitted(1.0), transmitted(-1.0));
        // Standard errors of two proportions near ½, five of them.
        let error = 5.0 * (0.25 / f64::from(PATHS)).sqrt() * (1.0 + eta * eta);
        assert!((down - eta * eta * up).abs() < error, "{down} {up} ± {error}");
    }
}
