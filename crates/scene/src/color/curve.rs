//! Quantities as functions of the wavelength.

use alloc::vec::Vec;

/// A quantity per wavelength: linear between samples, 0 outside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Wavelengths in nm, increasing, and values.
    samples: Vec<(f64, f64)>,
}

impl Curve {
    /// The curve through samples: pairs of a wavelength in nm, increasing, and a value.
    pub fn new(samples: Vec<(f64, f64)>) -> Self {
        Self { samples }
    }

    /// The same value over all that is visible.
    pub fn constant(value: f64) -> Self {
        Self { samples: Vec::from([(0.0, value), (1e4, value)]) }
    }

    /// The samples: wavelengths in nm, increasing, and values.
    pub fn samples(&self) -> &[(f64, f64)] {
        &self.samples
    }

    /// The value at a wavelength in nm.
    pub fn at(&self, wavelength: f64) -> f64 {
        interpolate(&self.samples, wavelength)
    }

    /// The curve with every value changed.
    #[must_use]
    pub fn map(&self, change: impl Fn(f64) -> f64) -> Self {
        Self { samples: self.samples.iter().map(|&(nm, value)| (nm, change(value))).collect() }
    }
}

/// The value at a wavelength: linear between samples, 0 outside.
pub(super) fn interpolate(samples: &[(f64, f64)], wavelength: f64) -> f64 {
    let after = samples.partition_point(|&(w, _)| w <= wavelength);
    match (samples.get(after.wrapping_sub(1)), samples.get(after)) {
        (Some(&(w0, v0)), Some(&(w1, v1))) => v0 + (v1 - v0) * (wavelength - w0) / (w1 - w0),
        // The last sample belongs to the spectrum too.
        (Some(&(w0, v0)), None) if w0 == wavelength => v0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectrum_ends_with_its_last_sample() {
        let curve = Curve::new([(400.0, 1.0), (500.0, 3.0)].into());
        for (wavelength, value) in
            [(399.0, 0.0), (400.0, 1.0), (450.0, 2.0), (500.0, 3.0), (501.0, 0.0)]
        {
            assert_eq!(curve.at(wavelength), value);
            assert_eq!(curve.map(|x| 2.0 * x).at(wavelength), 2.0 * value);
        }
        assert_eq!(Curve::new(Vec::new()).at(450.0), 0.0);
        assert_eq!(Curve::constant(2.5).at(555.0), 2.5);
    }
}
