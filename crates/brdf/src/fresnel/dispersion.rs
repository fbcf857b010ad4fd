//! Indices of refraction that depend on the wavelength.

use etendue_math::Real;

/// The wavelengths, in nm, at which glasses are described: the F, d and C lines of hydrogen and helium.
const LINES: [f64; 3] = [486.1327, 587.5618, 656.2725];

/// The index of refraction of a transparent medium as a function of the wavelength.
///
/// ```text
/// Cauchy      n(λ) = A + B/λ² + C/λ⁴
/// Sellmeier   n(λ)² = 1 + Σ Bi λ² / (λ² − Ci)
/// ```
///
/// with λ in µm, which is how catalogues state the coefficients; functions take nm.
///
/// * Domain: wavelengths of 200 to 2500 nm away from the resonances √Ci; the index of every glass of [`GLASSES`] is meant
///   for 400 to 700 nm at least. What formula or argument leave undefined (NaN, n² < 0, λ ≤ 0) is NaN, which
///   [`Ior::new`](crate::Ior::new) refuses.
///
/// # Precision
/// A few ulp of the largest term.
///
/// # Source
/// A.-L. Cauchy, "Mémoire sur la dispersion de la lumière", 1836; W. Sellmeier, Annalen der Physik 219, 1871.
///
/// # Examples
/// ```
/// use etendue_brdf::fresnel::{Dispersion, GLASSES};
/// let crown = Dispersion::glass("N-BK7").expect("in the catalogue");
/// let [blue, red] = [450.0_f64, 650.0].map(|nm| crown.index(nm));
/// assert!((blue - 1.5253).abs() < 1e-4 && (red - 1.5145).abs() < 1e-4);
/// assert!(GLASSES.iter().all(|glass| glass.dispersion.abbe_number() < 100.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dispersion {
    /// The same index for all wavelengths.
    Constant(f64),
    /// `[A, B, C]`; B in µm², C in µm⁴.
    Cauchy([f64; 3]),
    /// `[Bi, Ci]` of each resonance, Ci in µm²; resonances that are not needed have `Bi` 0.
    Sellmeier([[f64; 2]; 4]),
}

impl Dispersion {
    /// The medium of a catalogue by its [name](Glass::name).
    pub fn glass(name: &str) -> Option<Self> {
        GLASSES.iter().find(|glass| glass.name == name).map(|glass| glass.dispersion)
    }

    /// Cauchy's formula through the index at the d line (587.56 nm) and the Abbe number `(nd − 1)/(nF − nC)`.
    ///
    /// An Abbe number of infinity is no dispersion.
    pub fn from_abbe_number(index: f64, abbe: f64) -> Self {
        let [f, d, c] = LINES.map(|nm| 1e6 / (nm * nm));
        let b = (index - 1.0) / (abbe * (f - c));
        Self::Cauchy([index - b * d, b, 0.0])
    }

    /// n at a wavelength in nm, relative to vacuum or air as the coefficients are.
    #[inline]
    pub fn index<T: Real>(self, wavelength: T) -> T {
        let microns = wavelength * T::lit(1e-3);
        if !(microns > T::ZERO) {
            return T::NAN;
        }
        let squared = microns * microns;
        match self {
            Self::Constant(index) => T::lit(index),
            Self::Cauchy([a, b, c]) => T::lit(a) + (T::lit(b) + T::lit(c) / squared) / squared,
            Self::Sellmeier(resonances) => {
                let term = |[b, c]: [f64; 2]| T::lit(b) * squared / (squared - T::lit(c));
                let [p, q, r, s] = resonances.map(term);
                (T::ONE + p + q + r + s).sqrt()
            }
        }
    }

    /// Abbe's number `V = (nd − 1)/(nF − nC)`: large where colours part little; infinite without dispersion.
    pub fn abbe_number(self) -> f64 {
        let [f, d, c] = LINES.map(|nm| self.index(nm));
        (d - 1.0) / (f - c)
    }
}

/// A transparent medium of a catalogue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass {
    /// Its name as its maker or the literature has it.
    pub name: &'static str,
    /// Its index in air, but for water, diamond and sapphire, where it is that in vacuum.
    pub dispersion: Dispersion,
}

const fn sellmeier(name: &'static str, b: [f64; 3], c: [f64; 3]) -> Glass {
    let resonances = [[b[0], c[0]], [b[1], c[1]], [b[2], c[2]], [0.0, 0.0]];
    Glass { name, dispersion: Dispersion::Sellmeier(resonances) }
}

/// Real media, from little to much dispersion.
///
/// # Source
/// Schott's data sheets for the optical glasses; I. H. Malitson, "Interspecimen Comparison of the Refractive Index of Fused Silica",
/// JOSA 55, 1965; M. Daimon and A. Masumura, "Measurement of the refractive index of distilled water", Applied Optics 46, 2007 (20 °C);
/// I. H. Malitson and M. J. Dodge, "Refractive index and birefringence of synthetic sapphire", JOSA 62, 1972 (ordinary ray);
/// F. Peter, Zeitschrift für Physik 15, 1923, for diamond.
pub const GLASSES: &[Glass] = &[
    sellmeier(
        "sapphire",
        [1.431_349_3, 0.650_547_13, 5.341_402_1],
        [0.005_279_926_1, 0.014_238_264_7, 325.017_834],
    ),
    sellmeier(
        "fused silica",
        [0.696_166_3, 0.407_942_6, 0.897_479_4],
        [0.004_679_148_26, 0.013_512_063_1, 97.934_002_5],
    ),
    sellmeier(
        "N-BK7",
        [1.039_612_12, 0.231_792_344, 1.010_469_45],
        [0.006_000_698_67, 0.020_017_914_4, 103.560_653],
    ),
    Glass {
        name: "water",
        dispersion: Dispersion::Sellmeier([
            [0.568_402_756_5, 0.005_101_829_712],
            [0.172_617_739_1, 0.018_211_539_36],
            [0.020_861_895_78, 0.026_207_222_93],
            [0.113_074_868_8, 10.697_927_21],
        ]),
    },
    sellmeier("diamond", [0.3306, 4.3356, 0.0], [0.030_625, 0.011_236, 0.0]),
    sellmeier(
        "F2",
        [1.345_333_59, 0.209_073_176, 0.937_357_162],
        [0.009_977_438_71, 0.047_045_076_7, 111.886_764],
    ),
    sellmeier(
        "N-SF10",
        [1.621_539_02, 0.256_287_842, 1.644_475_52],
        [0.012_224_145_7, 0.059_573_677_5, 147.468_793],
    ),
    sellmeier(
        "N-SF11",
        [1.737_596_95, 0.313_747_346, 1.898_781_01],
        [0.013_188_707, 0.062_306_814_2, 155.236_29],
    ),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::refract;
    use etendue_math::glam::DVec3;

    #[test]
    fn media_have_the_index_and_the_abbe_number_that_their_data_sheets_state() {
        // nd and Vd as published; the last digit of each counts.
        let published = [
            ("sapphire", 1.7682, 72.3, 2e-4, 0.3),
            ("fused silica", 1.458_46, 67.82, 6e-6, 6e-3),
            ("N-BK7", 1.5168, 64.17, 6e-6, 6e-3),
            ("water", 1.3334, 55.8, 2e-4, 0.3),
            ("diamond", 2.4175, 55.3, 3e-4, 0.4),
            ("F2", 1.620_04, 36.37, 6e-6, 6e-3),
            ("N-SF10", 1.728_28, 28.53, 6e-6, 6e-3),
            ("N-SF11", 1.784_72, 25.68, 6e-6, 6e-3),
        ];
        assert_eq!(GLASSES.len(), published.len());
        for (glass, (name, index, abbe, index_error, abbe_error)) in GLASSES.iter().zip(published) {
            assert_eq!(glass.name, name);
            let (n, v) = (glass.dispersion.index(LINES[1]), glass.dispersion.abbe_number());
            assert!((n - index).abs() <= index_error, "{name}: n {n}");
            assert!((v - abbe).abs() <= abbe_error, "{name}: V {v}");
        }
        assert!(
            GLASSES.is_sorted_by(|a, b| a.dispersion.abbe_number() >= b.dispersion.abbe_number())
        );
    }

    #[test]
    fn cauchy_s_formula_has_the_index_and_the_abbe_number_that_it_was_made_for() {
        let flint = Dispersion::from_abbe_number(1.7, 30.0);
        // Roundings, the second divided by nF − nC.
        assert!((flint.index(LINES[1]) - 1.7_f64).abs() < 1e-15);
        assert!((flint.abbe_number() - 30.0).abs() < 1e-11);
        let plain = Dispersion::from_abbe_number(1.5, f64::INFINITY);
        assert_eq!(plain.index(400.0_f64), plain.index(700.0_f64));
    }

    #[test]
    fn colours_are_refracted_to_the_angles_of_snell_s_law() {
        let glass = Dispersion::glass("N-SF10").unwrap();
        let wo = DVec3::new(0.8, 0.0, 0.6);
        for nm in [400.0, 486.0, 550.0, 620.0, 700.0] {
            let n = glass.index(nm);
            let wt = refract(wo, n).unwrap();
            assert!((-wt.x - 0.8 / n).abs() < 1e-15, "{nm}");
            // Single precision knows the angle to its roundings.
            let single = f64::from(glass.index(nm as f32));
            assert!((0.8 / single - 0.8 / n).abs() < 1e-6, "{nm}");
        }
    }

    #[test]
    fn what_is_undefined_is_nan() {
        let glass = Dispersion::glass("N-BK7").unwrap();
        for nm in [0.0, -500.0, f64::NAN] {
            assert!(glass.index(nm).is_nan(), "{nm}");
        }
        // Between the resonances n² < 0.
        assert!(glass.index(10_100.0_f64).is_nan());
        assert!(Dispersion::glass("N-BK8").is_none());
    }
}
