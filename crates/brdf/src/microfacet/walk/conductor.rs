//! The walk between facets of metal.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::{MAX_ORDER, Walked, escape, next_height, visible_area};
use crate::bsdf::{above, both_above};
use crate::direction::{half_vector, reflect_about};
use crate::smooth::smooth_conductor::conductor_reflectance;
use crate::{ComplexIor, Microfacets};

/// Rough metal, every order of scattering included, by a random walk.
///
/// Not a [`Bsdf`](crate::Bsdf): `eval` is an unbiased estimate that differs from call to call, and a sample has no
/// density. For references and tests; uniforms in `[0, 1)` come from the caller, as many as the path asks for.
///
/// * Laws: reciprocal in the mean. With F = 1 every sample has weight exactly 1: the white furnace.
/// * The first order is the height-correlated single scattering of
///   [`RoughConductor`](crate::RoughConductor), whatever masking `facets` has.
///
/// # Examples
/// ```
/// use etendue_brdf::microfacet::walk::ConductorWalk;
/// use etendue_brdf::{Alpha, ComplexIor, Microfacets};
/// use etendue_math::glam::DVec3;
/// use etendue_sampling::{Pcg32, uniform};
/// let facets = Microfacets::ggx(Alpha::new(0.8_f64)?);
/// let walk = ConductorWalk::<f64>::new(ComplexIor::perfect(), facets);
/// let mut rng = Pcg32::new(1, 1);
/// let path = walk.sample(DVec3::Z, &mut || uniform(&mut rng)).expect("it leaves in the end");
/// assert!((path.weight - 1.0).abs() < 1e-14);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorWalk<C: Spectrum> {
    ior: ComplexIor<C>,
    facets: Microfacets<C::Real>,
    max_order: u32,
}

impl<C: Spectrum> ConductorWalk<C> {
    /// Metal with complex index `ior` and the surface `facets`.
    pub fn new(ior: ComplexIor<C>, facets: Microfacets<C::Real>) -> Self {
        Self { ior, facets, max_order: MAX_ORDER }
    }

    /// The same with paths cut at `max_order` facets; 1 is single scattering.
    pub fn with_max_order(self, max_order: u32) -> Self {
        Self { max_order, ..self }
    }

    /// Draws a path seen from `wo`; `None` from below and where the path is cut.
    pub fn sample(
        &self,
        wo: Vec3<C::Real>,
        uniform: &mut impl FnMut() -> C::Real,
    ) -> Option<Walked<C>> {
        if !above(wo) {
            return None;
        }
        let (mut w, mut c, mut weight) = (-wo, C::Real::ONE, C::white());
        for order in 0..=self.max_order {
            let Some(next) = next_height(&self.facets, w, c, uniform()) else {
                return Some(Walked { wi: w, weight, eta: C::Real::ONE, order });
            };
            c = next;
            let (direction, f) = self.scatter(-w, uniform)?;
            (w, weight) = (direction, weight * f);
        }
        None
    }

    /// An unbiased estimate of `f(wo, wi)`, without the cosine, in sr⁻¹; 0 where either is below.
    ///
    /// ```text
    /// f cos θi = Σ over facets of weight · F D(h) / (4 σ(v)) · C1(height)^Λ(wi),  h = normalize(v + wi)
    /// ```
    pub fn eval(
        &self,
        wo: Vec3<C::Real>,
        wi: Vec3<C::Real>,
        uniform: &mut impl FnMut() -> C::Real,
    ) -> C {
        let mut sum = C::black();
        if !both_above(wo, wi) {
            return sum;
        }
        let (mut w, mut c, mut weight) = (-wo, C::Real::ONE, C::white());
        for _ in 0..self.max_order {
            let Some(next) = next_height(&self.facets, w, c, uniform()) else { break };
            c = next;
            sum += (weight * self.phase(-w, wi)).scale(escape(&self.facets, wi, c));
            let Some((direction, f)) = self.scatter(-w, uniform) else { break };
            (w, weight) = (direction, weight * f);
        }
        sum.map(|x| (x / wi.z()).min(C::Real::MAX))
    }

    /// Reflection at a facet visible from `v`.
    fn scatter(
        &self,
        v: Vec3<C::Real>,
        uniform: &mut impl FnMut() -> C::Real,
    ) -> Option<(Vec3<C::Real>, C)> {
        let h = self.facets.sample_visible_normal(v, [uniform(), uniform()])?;
        let cos = v.dot(h).max(C::Real::ZERO);
        // Normalised: a path must not gather the rounding of many reflections.
        Some((reflect_about(v, h).try_normalize()?, conductor_reflectance(self.ior, cos)))
    }

    /// Reflected towards `wi` per steradian of it at the facets seen from `v`.
    fn phase(&self, v: Vec3<C::Real>, wi: Vec3<C::Real>) -> C {
        let Some((h, cos)) = half_vector(v, wi) else { return C::black() };
        let area = C::Real::lit(4.0) * visible_area(&self.facets, v);
        let d = self.facets.ndf(h);
        if !(area > C::Real::ZERO && d > C::Real::ZERO) {
            return C::black();
        }
        conductor_reflectance(self.ior, cos).scale((d / area).min(C::Real::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::conductor_average;
    use crate::quadrature::directional_albedo;
    use crate::{
        Alpha, BeckmannLambda, Bsdf, Distribution, KullaContyConductor, Masking, RoughConductor,
    };
    use etendue_math::glam::DVec3;
    use etendue_sampling::{Pcg32, uniform};

    const BECKMANN: Distribution = Distribution::Beckmann { lambda: BeckmannLambda::Exact };
    const PATHS: u32 = 40_000;

    fn facets(distribution: Distribution, alpha: f64) -> Microfacets<f64> {
        let alpha = Alpha::new(alpha).unwrap();
        Microfacets::new(distribution, alpha, alpha, Masking::HeightCorrelated)
    }

    fn direction(cos: f64, phi: f64) -> DVec3 {
        let sin = (1.0 - cos * cos).sqrt();
        DVec3::new(sin * Real::cos(phi), sin * Real::sin(phi), cos)
    }

    fn stream(seed: u64) -> impl FnMut() -> f64 {
        let mut generator = Pcg32::new(seed, 1);
        move || uniform(&mut generator)
    }

    /// Mean of `PATHS` numbers and five standard errors of it.
    fn mean(mut number: impl FnMut() -> f64) -> (f64, f64) {
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..PATHS {
            let x = number();
            sum += x;
            squares += x * x;
        }
        let n = f64::from(PATHS);
        let mean = sum / n;
        (mean, 5.0 * ((squares / n - mean * mean).max(0.0) / n).sqrt())
    }

    #[test]
    fn the_white_furnace_is_exact_path_by_path() {
        for distribution in [Distribution::Ggx, BECKMANN] {
            for (alpha, cos) in [(1.0, 1.0), (1.0, 0.05), (0.1, 0.3), (1e-4, 1e-3)] {
                let walk =
                    ConductorWalk::<f64>::new(ComplexIor::perfect(), facets(distribution, alpha));
                let mut uniforms = stream(3);
                for _ in 0..2000 {
                    let path = walk.sample(direction(cos, 0.4), &mut uniforms).unwrap();
                    // Every facet reflects 1 within two ulp.
                    let bound = f64::from(path.order) * 2.0 * f64::EPSILON;
                    assert!((path.weight - 1.0).abs() <= bound && path.wi.z > 0.0, "{path:?}");
                }
            }
        }
    }

    #[test]
    fn the_first_order_is_single_scattering() {
        let ior = ComplexIor::new(0.2, 3.0).unwrap();
        for distribution in [Distribution::Ggx, BECKMANN] {
            let facets = facets(distribution, 0.7);
            let walk = ConductorWalk::new(ior, facets).with_max_order(1);
            let single = RoughConductor::new(ior, facets);
            let mut uniforms = stream(5);
            for (wo, wi) in [
                (direction(0.8, 0.0), direction(0.6, 2.5)),
                (direction(0.1, 0.0), direction(0.3, 3.0)),
                (direction(0.5, 0.0), direction(0.5, 0.7)),
            ] {
                let (got, error) = mean(|| walk.eval(wo, wi, &mut uniforms));
                let want = single.eval(wo, wi);
                assert!((got - want).abs() < error, "{distribution:?} {got} {want} ± {error}");
            }
            // And the paths that leave after one facet carry its albedo.
            let wo = direction(0.6, 0.0);
            let (got, error) =
                mean(|| walk.sample(wo, &mut uniforms).map_or(0.0, |path| path.weight));
            let want = directional_albedo::<_, 96>(&single, wo);
            assert!((got - want).abs() < error, "{distribution:?} {got} {want} ± {error}");
        }
    }

    #[test]
    fn values_are_reciprocal_in_the_mean_and_integrate_to_the_energy_of_the_paths() {
        let walk = ConductorWalk::new(ComplexIor::perfect(), facets(Distribution::Ggx, 1.0));
        let mut uniforms = stream(7);
        let (a, b) = (direction(0.9, 0.0), direction(0.2, 1.9));
        let (there, e1) = mean(|| walk.eval(a, b, &mut uniforms));
        let (back, e2) = mean(|| walk.eval(b, a, &mut uniforms));
        assert!((there - back).abs() < e1 + e2, "{there} {back}");
        // ∫ f cos dω with wi uniform in the hemisphere.
        let (albedo, error) = mean(|| {
            let (z, phi) = (uniforms(), 2.0 * f64::PI * uniforms());
            let wi = direction(z, phi);
            2.0 * f64::PI * z * walk.eval(a, wi, &mut uniforms)
        });
        assert!((albedo - 1.0).abs() < error, "{albedo} ± {error}");
    }

    #[test]
    fn the_compensation_of_kulla_and_conty_has_nearly_the_energy_of_the_walk() {
        // Grey metals of F_avg 0.37 and 0.92 at α = 0.9, where most light is scattered more than once.
        let mut worst = [0.0_f64; 2];
        for (eta, k) in [(1.4, 1.6), (0.2, 3.0)] {
            let (ior, facets) = (ComplexIor::new(eta, k).unwrap(), facets(Distribution::Ggx, 0.9));
            let walk = ConductorWalk::new(ior, facets);
            let (model, single) =
                (KullaContyConductor::new(ior, facets).unwrap(), RoughConductor::new(ior, facets));
            let mut uniforms = stream(11);
            for cos in [1.0, 0.5, 0.15] {
                let wo = direction(cos, 0.0);
                let (truth, error) = mean(|| walk.sample(wo, &mut uniforms).unwrap().weight);
                let [whole, first] = [
                    directional_albedo::<_, 96>(&model, wo),
                    directional_albedo::<_, 96>(&single, wo),
                ];
                // Facets met again are met at grazing more than F_avg knows: 0.007 to 0.021 too dark here.
                let off = (whole - truth).abs();
                assert!(whole < truth && off < 0.021 + error, "{eta} {cos} {whole} {truth}");
                // Without the square of F_avg it would be too bright: by 0.001 to 0.025 for the bright
                // metal, where that is nearer at grazing, by up to 0.08 for the dark one.
                let unsquared = first + (whole - first) / conductor_average(ior.eta(), ior.k());
                assert!(unsquared + error > truth, "{eta} {cos} {unsquared} {truth}");
                worst = [worst[0].max(off), worst[1].max((unsquared - truth).abs())];
                // And single scattering alone is further off still.
                assert!(truth - first > 2.0 * off, "{eta} {cos} {first} {truth}");
            }
        }
        assert!(worst[1] > 3.0 * worst[0], "{worst:?}");
    }
}
