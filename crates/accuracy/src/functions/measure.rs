//! Errors and times of the variants of a family.

use crate::timing::{Budget, Pass, Timing, race};

use super::family::{ErrorKind, Family};
use super::reference::Reference;
use super::variant::Precision;

/// What was measured of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The variants, the exact one first.
    pub variants: Vec<MeasuredVariant>,
    /// The reference they were compared with.
    pub reference: Reference,
}

/// What was measured of a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredVariant {
    /// Its name.
    pub name: &'static str,
    /// The width of its numbers.
    pub precision: Precision,
    /// How far it is from the reference.
    pub errors: Errors,
    /// Its time.
    pub timing: Timing,
    /// Instructions per evaluation, where they could be counted.
    pub instructions: Option<f64>,
}

/// How far values are from the reference over a domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The largest difference.
    pub max_absolute: f64,
    /// Root of the mean square difference.
    pub rms_absolute: f64,
    /// The largest difference divided by the reference; 0/0 counts as 0.
    pub max_relative: f64,
    /// Root of the mean square of these.
    pub rms_relative: f64,
    /// The point of the largest error of the kind the family is judged by.
    pub worst: usize,
    /// The energy of the largest absolute difference, and that difference, with its sign; where there are energies.
    pub energy: Option<(usize, f64)>,
}

impl Errors {
    /// Of values and energies against a reference. What is not finite counts as an infinite error.
    pub fn of(values: &[f64], energies: &[f64], reference: &Reference, kind: ErrorKind) -> Self {
        let finite = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
        let pairs = || values.iter().zip(&reference.values);
        let absolute: Vec<f64> = pairs().map(|(v, r)| finite((v - r).abs())).collect();
        let quotient = |(d, r): (&f64, &f64)| if *d == 0.0 { 0.0 } else { d / r.abs() };
        let relative: Vec<f64> = absolute.iter().zip(&reference.values).map(quotient).collect();
        let judged = match kind {
            ErrorKind::RmsAbsolute => &absolute,
            ErrorKind::RmsRelative => &relative,
        };
        let differences: Vec<f64> =
            energies.iter().zip(&reference.energies).map(|(e, r)| e - r).collect();
        let sizes: Vec<f64> = differences.iter().map(|d| finite(d.abs())).collect();
        Self {
            max_absolute: absolute[largest(&absolute)],
            rms_absolute: rms(&absolute),
            max_relative: relative[largest(&relative)],
            rms_relative: rms(&relative),
            worst: largest(judged),
            energy: (!sizes.is_empty()).then(|| largest(&sizes)).map(|i| (i, differences[i])),
        }
    }

    /// The error the family is judged by.
    pub fn judged(&self, kind: ErrorKind) -> f64 {
        match kind {
            ErrorKind::RmsAbsolute => self.rms_absolute,
            ErrorKind::RmsRelative => self.rms_relative,
        }
    }
}

/// Where the first of the largest numbers stands.
fn largest(numbers: &[f64]) -> usize {
    (1..numbers.len()).fold(0, |best, i| if numbers[i] > numbers[best] { i } else { best })
}

fn rms(numbers: &[f64]) -> f64 {
    let squares: f64 = numbers.iter().map(|x| x * x).sum();
    (squares / numbers.len() as f64).sqrt()
}

/// Measures all variants of a family. `instructions` counts those of variant `i`, or cannot.
pub fn measure(
    family: &Family,
    budget: Budget,
    mut instructions: impl FnMut(usize) -> Option<f64>,
) -> Measured {
    let setup = &family.setup;
    let reference = (setup.compute)();
    let passes: Vec<Box<dyn Fn() -> usize + '_>> =
        setup.variants.iter().map(|v| Box::new(|| v.pass()) as Box<dyn Fn() -> usize>).collect();
    let contestants: Vec<Pass<'_>> = passes.iter().map(|pass| &**pass as Pass<'_>).collect();
    let timings = race(&|| setup.variants[0].idle(), &contestants, budget);
    let measured = |(i, (variant, timing)): (usize, (&super::Variant, Timing))| {
        let (values, energies) = (variant.values(), variant.energies());
        MeasuredVariant {
            name: variant.name(),
            precision: variant.precision(),
            errors: Errors::of(&values, &energies, &reference, setup.judged_by),
            timing,
            instructions: instructions(i),
        }
    };
    let variants = setup.variants.iter().zip(timings).enumerate().map(measured).collect();
    Measured { variants, reference }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reference() -> Reference {
        Reference { values: vec![1.0, 2.0, 0.0], energies: vec![0.5, 0.25], uncertainty: None }
    }

    #[test]
    fn errors_are_those_of_their_formulas() {
        let values = [1.0, 2.5, 0.0];
        let errors = Errors::of(&values, &[0.5, 0.125], &reference(), ErrorKind::RmsRelative);
        assert_eq!((errors.max_absolute, errors.max_relative), (0.5, 0.25));
        assert_eq!(errors.rms_absolute, (0.25_f64 / 3.0).sqrt());
        assert_eq!(errors.rms_relative, (0.0625_f64 / 3.0).sqrt());
        assert_eq!((errors.worst, errors.energy), (1, Some((1, -0.125))));
    }

    #[test]
    fn what_is_not_a_number_is_an_infinite_error() {
        let errors = Errors::of(&[1.0, f64::NAN, 0.0], &[], &reference(), ErrorKind::RmsAbsolute);
        assert_eq!((errors.max_absolute, errors.worst), (f64::INFINITY, 1));
        assert_eq!(errors.energy, None);
    }
}
