//! What a rough dielectric interface does not reflect, tabulated.

use etendue_math::Real;

use super::integral::facet_albedo;
use super::{CosineRow, Place};
use crate::fresnel::dielectric;
use crate::{Alpha, Microfacets};

/// `1 − E(μ, α, η)`, E what isotropic, height-correlated GGX facets of a dielectric reflect once, seen from the
/// thinner side.
///
/// ```text
/// E(μ) = ∫ D(h) F(wo·h, η) V(wo, wi) cos θi dωi
/// layers   √ε = (k + 1)/16,  ε = (η − 1)/(η + 1) the amplitude at normal incidence
/// rows     √α = i/15;  the first has E = F(μ, η)
/// columns  √μ = j/31
/// ```
///
/// linear between nodes. Roots put the nodes where E is steep: at grazing angles, which a small α or an index
/// near 1 narrows. Below the first layer, η = 1.008, F is a function of c/√ε, which makes E one of μ/√ε and α/√ε: the
/// first layer is stretched.
///
/// 32 KB, linked only where used.
///
/// # Precision
/// For α ≥ 0.01 and η ≤ 3 1.4e-3 on average over √μ; at most 0.018 for η ≥ 1.2 and 0.03 below, both
/// at cosines of some 0.03 for the narrowest of these facets.
///
/// # Source
/// `cargo run --release -p etendue-brdf --example generate_albedo_tables dielectric` writes `dielectric_data.rs`.
#[derive(Clone, Debug, PartialEq)]
pub struct DielectricTable([[[f32; Self::COLUMNS]; Self::ROWS]; Self::LAYERS]);

include!("dielectric_data.rs");

impl DielectricTable {
    /// Nodes over the index.
    pub const LAYERS: usize = 16;
    /// Amplitude of the first layer.
    const FIRST: f64 = 1.0 / (Self::LAYERS * Self::LAYERS) as f64;
    /// Nodes over the width.
    pub const ROWS: usize = 16;
    /// Nodes over the angle.
    pub const COLUMNS: usize = CosineRow::<f32>::NODES;

    /// The table checked in: a static one, for it is large.
    #[inline]
    pub fn ggx() -> &'static Self {
        &GGX
    }

    /// Entry of layer `k`, row `i` and column `j`, computed.
    pub fn entry(k: usize, i: usize, j: usize) -> f32 {
        let amplitude = Real::sqr((k + 1) as f64 / Self::LAYERS as f64);
        let alpha = Real::sqr(i as f64 / (Self::ROWS - 1) as f64);
        let mu = CosineRow::<f64>::node(j);
        // The error of the quadrature is 5e-6.
        (1.0 - albedo(amplitude, alpha, mu)).max(0.0) as f32
    }

    /// The row of an amplitude ε and a width α, 0 for a smooth interface, both in `[0, 1]`.
    pub(crate) fn row<T: Real>(&self, amplitude: T, alpha: T) -> CosineRow<T> {
        let place = amplitude.safe_sqrt() * T::lit(Self::LAYERS as f64) - T::ONE;
        if amplitude < T::lit(Self::FIRST) {
            return self.stretched((place + T::ONE).max(T::ZERO), alpha);
        }
        let place = place.max(T::ZERO);
        let k = (place.to_f64() as usize).min(Self::LAYERS - 2);
        let s = place - T::lit(k as f64);
        let [low, high] = [k, k + 1].map(|k| self.row_of_layer(k, alpha));
        CosineRow(core::array::from_fn(|j| low.0[j] * (T::ONE - s) + high.0[j] * s))
    }

    /// The first layer narrowed to `share` of its √ε, in `[0, 1)`.
    fn stretched<T: Real>(&self, share: T, alpha: T) -> CosineRow<T> {
        if !(share > T::ZERO) {
            return CosineRow::of(|_| T::ONE);
        }
        let first = self.row_of_layer(0, (alpha / share).min(T::ONE));
        CosineRow::of(|mu: T| {
            let reflected = T::ONE - first.at(Place::of(mu / share));
            // Beyond, F falls as (c/√ε)⁻⁴.
            let beyond = (share / mu.max(share)).sqr();
            T::ONE - reflected * (beyond * beyond)
        })
    }

    fn row_of_layer<T: Real>(&self, k: usize, alpha: T) -> CosineRow<T> {
        let place = alpha.clamp_to(T::ZERO, T::ONE).sqrt() * T::lit((Self::ROWS - 1) as f64);
        let i = (place.to_f64() as usize).min(Self::ROWS - 2);
        let t = place - T::lit(i as f64);
        CosineRow(core::array::from_fn(|j| {
            let [low, high] = [i, i + 1].map(|i| T::lit(self.0[k][i][j].into()));
            low * (T::ONE - t) + high * t
        }))
    }
}

/// E by quadrature, of the amplitude ε at normal incidence.
fn albedo(amplitude: f64, alpha: f64, mu: f64) -> f64 {
    let eta = (1.0 + amplitude) / (1.0 - amplitude);
    let reflectance = |c: f64| if amplitude < 1.0 { dielectric(c, eta) } else { 1.0 };
    match Alpha::new(alpha) {
        // Along the surface the facets' masking is a limit, reached to the last digit of an f32 here.
        Ok(alpha) => facet_albedo(&Microfacets::ggx(alpha), reflectance, mu.max(1e-8)),
        Err(_) => reflectance(mu),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_what_the_generator_computes() {
        for (k, i, j) in [(0, 5, 5), (1, 15, 0), (5, 3, 31), (6, 0, 9), (15, 8, 20)] {
            let (got, want) = (DielectricTable::ggx().0[k][i][j], DielectricTable::entry(k, i, j));
            // The float functions of another backend: far below the interpolation.
            assert!((got - want).abs() < 1e-6, "{k} {i} {j}: {got} {want}");
        }
    }

    #[test]
    fn the_interpolation_is_as_good_as_it_says() {
        let (mut worst, mut sum, mut count) = ([(0.0_f64, [0.0; 3]); 2], 0.0, 0);
        for eta in [1.001, 1.01, 1.02, 1.1, 1.2, 1.35, 1.5, 1.6, 2.0, 3.0] {
            for root in [0.1, 0.17, 0.23, 0.3, 0.57, 0.9, 1.0_f64] {
                let amplitude = (eta - 1.0) / (eta + 1.0);
                let row = DielectricTable::ggx().row(amplitude, root * root);
                for x in 0..25 {
                    let mu = Real::sqr(f64::from(x) / 24.0);
                    let want = 1.0 - albedo(amplitude, root * root, mu);
                    let error = (row.at(Place::of(mu)) - want).abs();
                    let class = usize::from(eta >= 1.2);
                    if error > worst[class].0 {
                        worst[class] = (error, [eta, root, mu]);
                    }
                    sum += error;
                    count += 1;
                }
            }
        }
        let mean = sum / f64::from(count);
        assert!(worst[0].0 < 3e-2 && worst[1].0 < 1.8e-2 && mean < 1.4e-3, "{worst:?} {mean}");
    }

    #[test]
    fn a_matched_interface_reflects_exactly_nothing() {
        let row = DielectricTable::ggx().row(0.0_f32, 0.3);
        assert!(row.0.iter().all(|&t| t == 1.0));
    }
}
