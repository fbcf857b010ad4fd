//! A measured isotropic material.

use etendue_math::glam::DVec3;
use etendue_math::{Real, Rgb, Spectrum, Vec3, Vector3};
use etendue_sampling::Tabulated1d;
use etendue_sampling::warp::{cosine_hemisphere, turn};

use super::MerlTable;
use super::half_difference::HalfDifference;
use super::table::SIZE;
use crate::bsdf::{above, both_above};
use crate::direction::reflect_about;
use crate::mixture::limited_mixture_sample;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Sample};

/// Rings of half vectors.
const RINGS: usize = SIZE[0];

/// How a table is read between its bins' centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The bin the pair falls into, as the database's own reader does: steps in highlights.
    Nearest,
    /// Linear in the table's three coordinates between the centres of the bins.
    #[default]
    Trilinear,
}

/// A material of the MERL database.
///
/// ```text
/// f = table(θh, θd, φd),   θh in bins of √(θh / (π/2))
/// ```
///
/// A colour of one channel gets the luminance; one of more gets red, green and from there on blue.
///
/// * Laws: reciprocal by construction (φd modulo π). Energy is what was measured: nothing is
///   normalised.
/// * Sampling: with equal probability cosine-weighted, or a half vector: its ring of θh from the table's
///   mean luminance over θd and φd, within the ring proportional to `cos θh`. The density is that
///   of the mixture: `½ cos θi/π + ½ P(ring) h.z / (π Δsin² θh · 4 wo·h)`.
///
/// # Precision
/// The table's entries to rounding: coordinates are computed in double precision, so that `f32` and `f64`
/// read the same bins. Below the horizon of the table's measurement (a few degrees above grazing) entries are
/// extrapolations of the database.
///
/// # Source
/// W. Matusik et al., "A Data-Driven Reflectance Model", SIGGRAPH 2003; S. Rusinkiewicz, EGWR 1998.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Interpolation, Lambert, Measured, MerlTable, Reflectance, tabulate};
/// use etendue_math::{Rgb, glam::DVec3};
/// let mut file = vec![0; MerlTable::BYTES]; // or std::fs::read("gold-metallic-paint.binary")
/// tabulate(&Lambert::new(Reflectance::new(0.5)?), &mut file)?;
/// let material = Measured::<Rgb<f64>>::new(MerlTable::parse(&file)?, Interpolation::Trilinear);
/// let f = material.eval(DVec3::Z, DVec3::new(0.6, 0.0, 0.8));
/// assert!((f.g - 0.5 / std::f64::consts::PI).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured<'a, C: Spectrum> {
    table: MerlTable<'a>,
    interpolation: Interpolation,
    /// sin² θh of the rings' edges.
    edges: [C::Real; RINGS + 1],
    /// Of the rings; all 0 for a black table.
    cdf: [C::Real; RINGS + 1],
}

impl<'a, C: Spectrum> Measured<'a, C> {
    /// Prepares sampling: one pass over the table, tens of milliseconds.
    pub fn new(table: MerlTable<'a>, interpolation: Interpolation) -> Self {
        let quarter = C::Real::lit(f64::PI * 0.5);
        let mut edges = [C::Real::ZERO; RINGS + 1];
        for (i, edge) in edges.iter_mut().enumerate() {
            let x = C::Real::lit(i as f64 / RINGS as f64);
            *edge = (x * x * quarter).sin().sqr();
        }
        let mut weights = [C::Real::ZERO; RINGS];
        for (h, weight) in weights.iter_mut().enumerate() {
            *weight = C::Real::lit(mean_luminance(&table, h)) * (edges[h + 1] - edges[h]);
        }
        let mut cdf = [C::Real::ZERO; RINGS + 1];
        if Tabulated1d::build(&weights, &mut cdf).is_err() {
            cdf = [C::Real::ZERO; RINGS + 1];
        }
        Self { table, interpolation, edges, cdf }
    }

    /// The table's colour at a bin.
    #[inline]
    fn entry(&self, bin: [usize; 3]) -> C {
        let rgb = Rgb::from([0, 1, 2].map(|channel| self.table.value(channel, bin)));
        let channels = rgb.to_array();
        let mut i = 0;
        C::black().map(|_| {
            let x = if C::CHANNELS == 1 { rgb.luminance() } else { channels[i.min(2)] };
            i += 1;
            C::Real::lit(x).min(C::Real::MAX)
        })
    }

    #[inline]
    fn lookup(&self, at: HalfDifference) -> C {
        let count = SIZE.map(|n| n as f64);
        let x = [
            ring_coordinate(at.theta_h),
            at.theta_d / (f64::PI * 0.5) * count[1],
            at.phi_d / f64::PI * count[2],
        ];
        match self.interpolation {
            Interpolation::Nearest => {
                self.entry([0, 1, 2].map(|i| (x[i] as usize).min(SIZE[i] - 1)))
            }
            Interpolation::Trilinear => {
                let [h, d] = [0, 1].map(|i| between(x[i], SIZE[i] - 1));
                let phi = around(x[2], SIZE[2]);
                let mut sum = C::black();
                for (h, wh) in h {
                    for (d, wd) in d {
                        for (phi, wp) in phi {
                            sum += self.entry([h, d, phi]).scale(C::Real::lit(wh * wd * wp));
                        }
                    }
                }
                sum.map(|c| c.min(C::Real::MAX))
            }
        }
    }

    /// Density of half vectors but for their cosine, times `factor`; 0 where the table is black.
    #[inline]
    fn reflection_pdf(&self, theta_h: f64, factor: f64) -> C::Real {
        let Some(rings) = Tabulated1d::from_cdf(&self.cdf) else { return C::Real::ZERO };
        let ring = (ring_coordinate(theta_h) as usize).min(RINGS - 1);
        let area = C::Real::PI * (self.edges[ring + 1] - self.edges[ring]);
        rings.probability(ring) * C::Real::lit(factor) / area
    }

    /// A half vector with that density.
    #[inline]
    fn sample_half_vector(&self, u: [C::Real; 2]) -> Option<Vec3<C::Real>> {
        let choice = Tabulated1d::from_cdf(&self.cdf)?.choose(u[0]);
        let (low, high) = (self.edges[choice.index], self.edges[choice.index + 1]);
        let squared = low + choice.residual * (high - low);
        let (sin_phi, cos_phi) = turn::sin_cos(u[1]);
        let (sin, cos) = (squared.safe_sqrt(), (C::Real::ONE - squared).safe_sqrt());
        Some(Vec3::<C::Real>::new(sin * cos_phi, sin * sin_phi, cos))
    }
}

/// A direction in double precision.
#[inline(always)]
fn widen<V: Vector3>(w: V) -> DVec3 {
    DVec3::new(w.x().to_f64(), w.y().to_f64(), w.z().to_f64())
}

/// θh in rings: `90 √(θh / (π/2))`.
#[inline]
fn ring_coordinate(theta_h: f64) -> f64 {
    Real::sqrt((theta_h / (f64::PI * 0.5)).max(0.0)) * RINGS as f64
}

/// The two bins up to `last` whose centres surround `x`, and their shares.
#[inline]
fn between(x: f64, last: usize) -> [(usize, f64); 2] {
    let x = Real::clamp_to(x - 0.5, 0.0, last as f64);
    let low = (x as usize).min(last);
    let t = x - low as f64;
    [(low, 1.0 - t), ((low + 1).min(last), t)]
}

/// The same on a circle of `count` bins.
#[inline]
fn around(x: f64, count: usize) -> [(usize, f64); 2] {
    let x = (x + count as f64 - 0.5).max(0.0);
    let low = x as usize;
    let t = x - low as f64;
    [(low % count, 1.0 - t), ((low + 1) % count, t)]
}

/// Mean over a ring, weighted with `sin θd cos θd`, the share of directions at θd.
fn mean_luminance(table: &MerlTable<'_>, h: usize) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for d in 0..SIZE[1] {
        let (sin, cos) = Real::sin_cos((d as f64 + 0.5) / SIZE[1] as f64 * f64::PI * 0.5);
        for phi in 0..SIZE[2] {
            let rgb = Rgb::from([0, 1, 2].map(|channel| table.value(channel, [h, d, phi])));
            sum += rgb.luminance().min(1e30) * sin * cos;
            total += sin * cos;
        }
    }
    sum / total
}

impl<C: Spectrum> Bsdf for Measured<'_, C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        if !both_above(wo, wi) {
            return nothing;
        }
        let Some((at, h, cos)) = HalfDifference::new(widen(wo), widen(wi)) else { return nothing };
        let mut pdf = cosine_hemisphere::pdf::<C::Real>(wi);
        if cos > 0.0 {
            pdf += self.reflection_pdf(at.theta_h, h.z / (4.0 * cos));
        }
        (self.lookup(at), (pdf * C::Real::HALF).min(C::Real::MAX))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) {
            return None;
        }
        let wi = if u_lobe < C::Real::HALF {
            cosine_hemisphere::from_square(u)
        } else {
            reflect_about(wo, self.sample_half_vector(u)?)
        };
        limited_mixture_sample(self, wo, wi, C::Real::ONE)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "measured",
    type_name: "Measured",
    parameters: &[
        parameter::named("table", "90 × 90 × 180 finite numbers per channel"),
        parameter::named("interpolation", "nearest, trilinear"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::OfData,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "mixture of cosine and rings of half vectors",
    source: "Matusik et al. 2003; Rusinkiewicz 1998",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Alpha, ComplexIor, Microfacets, RoughConductor, laws, tabulate};
    use alloc::{vec, vec::Vec};

    fn gold() -> RoughConductor<Rgb<f64>> {
        let ior = ComplexIor::new(Rgb::new(0.14, 0.37, 1.44), Rgb::new(3.98, 2.39, 1.60)).unwrap();
        RoughConductor::new(ior, Microfacets::ggx(Alpha::new(0.3).unwrap()))
    }

    fn file() -> Vec<u8> {
        let mut file = vec![0; MerlTable::BYTES];
        tabulate(&gold(), &mut file).unwrap();
        file
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let file = file();
        let table = MerlTable::parse(&file).unwrap();
        for interpolation in [Interpolation::Nearest, Interpolation::Trilinear] {
            let model = Measured::<Rgb<f64>>::new(table, interpolation);
            laws::sampling_matches_density(&model, 1e-10);
            laws::density_integrates_to_at_most_one(&model);
            laws::total(&model);
            laws::total(&Measured::<f32>::new(table, interpolation));
        }
        // φd near 0 and π are neighbours, so that rounding never shows when directions are exchanged.
        let model = Measured::<Rgb<f64>>::new(table, Interpolation::Trilinear);
        laws::reciprocal(&model, 1e-9);
    }

    #[test]
    fn what_was_tabulated_is_read_back_at_the_centres_of_bins() {
        let file = file();
        let table = MerlTable::parse(&file).unwrap();
        for [h, d, phi] in [[0, 0, 0], [5, 30, 90], [40, 10, 179], [30, 60, 20]] {
            let centre = |i: usize, n: usize| (f64::from(i as u32) + 0.5) / n as f64;
            let x = centre(h, 90);
            let at = HalfDifference {
                theta_h: x * x * f64::PI * 0.5,
                theta_d: centre(d, 90) * f64::PI * 0.5,
                phi_d: centre(phi, 180) * f64::PI,
            };
            let [wo, wi] = at.pair();
            let want = gold().eval(wo, wi);
            assert!(want.r > 0.0, "{at:?}");
            for interpolation in [Interpolation::Nearest, Interpolation::Trilinear] {
                let got = Measured::<Rgb<f64>>::new(table, interpolation).eval(wo, wi);
                // Rounding of the coordinates, times a slope of some hundred per bin.
                assert!((got.r - want.r).abs() + (got.b - want.b).abs() < 1e-10 * want.r.max(1.0));
            }
        }
    }

    #[test]
    fn between_centres_interpolation_is_close_and_the_nearest_bin_less_so() {
        let file = file();
        let table = MerlTable::parse(&file).unwrap();
        let models = [Interpolation::Trilinear, Interpolation::Nearest]
            .map(|interpolation| Measured::<Rgb<f64>>::new(table, interpolation));
        let mut errors = [0.0_f64; 2];
        for i in 0..400 {
            let angle = |k: f64| (f64::from(i) * k).rem_euclid(1.0);
            let direction = |cos: f64, phi: f64| {
                let sin = Real::sqrt(1.0 - cos * cos);
                DVec3::new(sin * Real::cos(phi), sin * Real::sin(phi), cos)
            };
            let wo = direction(0.3 + 0.7 * angle(0.618), 2.0 * f64::PI * angle(0.414));
            let wi = direction(0.3 + 0.7 * angle(0.732), 2.0 * f64::PI * angle(0.236));
            let want = gold().eval(wo, wi).r;
            for (error, model) in errors.iter_mut().zip(&models) {
                let got = model.eval(wo, wi).r;
                *error = error.max((got / want - 1.0).abs());
            }
        }
        // GGX of width 0.3 falls by up to 9 % per bin of θh, and bends by 1 % within two.
        assert!(errors[0] < 0.01 && errors[1] < 0.1 && errors[1] > 3.0 * errors[0], "{errors:?}");
    }

    #[test]
    fn a_black_table_scatters_nothing() {
        let mut file = file();
        file[12..].fill(0);
        let table = MerlTable::parse(&file).unwrap();
        let model = Measured::<f64>::new(table, Interpolation::Nearest);
        assert!(model.sample(DVec3::Z, 0.7, [0.5; 2]).is_none());
        assert!(model.sample(DVec3::Z, 0.2, [0.5; 2]).is_none());
    }
}
