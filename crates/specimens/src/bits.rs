//! Hashes of results: the same on every target with the `libm` backend.
//!
//! A hash runs over the results of consecutive [`Inputs`] and is reported after [`BRIEF`], [`SHORT`] and
//! [`LONG`] of them, so that a slow target compares itself with the beginning of what a fast one did.

use core::fmt;
use core::marker::PhantomData;

use etendue_brdf::{Bsdf, Density, Sample};
use etendue_math::{Real, Vec3, Vector3, mix_u64};

use crate::functions::functions;
use crate::{Each, Inputs, Scalar, Specimen, Typical, Visitor, for_each};

/// How many inputs an interpreter tries.
pub const BRIEF: u64 = 64;
/// How many a slow target does.
pub const SHORT: u64 = 1 << 12;
/// How many a fast one does.
pub const LONG: u64 = 500_000;

/// Results, folded into a hash.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Results(u64);

impl Results {
    /// Adds a number. All NaN are one: their bits differ between processors.
    pub fn number<T: Real>(&mut self, x: T) {
        let bits = if x.is_nan() { u64::MAX } else { x.to_f64().to_bits() };
        self.0 = mix_u64(self.0, bits);
    }

    /// Adds several numbers.
    pub fn numbers<T: Real, const N: usize>(&mut self, xs: [T; N]) {
        for x in xs {
            self.number(x);
        }
    }

    /// Adds a vector.
    pub fn vector<V: Vector3>(&mut self, v: V) {
        self.numbers([v.x(), v.y(), v.z()]);
    }

    fn sample<T: Scalar>(&mut self, sample: Option<Sample<T>>) {
        let Some(Sample { wi, weight, density, eta }) = sample else { return self.number(T::NAN) };
        self.vector::<Vec3<T>>(wi);
        self.numbers(match density {
            Density::Continuous(pdf) => [weight, eta, pdf, T::ZERO],
            Density::Delta(probability) => [weight, eta, probability, T::ONE],
        });
    }
}

/// The hash of one function or model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hash {
    /// Function or model.
    pub name: &'static str,
    /// Precision.
    pub scalar: &'static str,
    /// Number of inputs.
    pub count: u64,
    /// What their results hash to.
    pub hash: u64,
}

impl fmt::Display for Hash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x} {} {} {}", self.hash, self.scalar, self.count, self.name)
    }
}

/// Hashes everything in precision `T` over `inputs` inputs, and hands over each hash as it is ready.
pub fn all<T: Scalar>(inputs: u64, report: &mut impl FnMut(Hash)) {
    all_but::<T>(&[], inputs, report);
}

/// The same without the models of these names.
pub fn all_but<T: Scalar>(without: &[&str], inputs: u64, report: &mut impl FnMut(Hash)) {
    all_functions::<T>(inputs, report);
    let scalar = PhantomData::<T>;
    for_each(&mut Models::<T, _, b'a', b'z'> { without, inputs, report, scalar });
}

/// The part of [`all`] that is functions.
pub fn all_functions<T: Scalar>(inputs: u64, report: &mut impl FnMut(Hash)) {
    for (name, function) in functions::<T>() {
        run::<T>(name, inputs, function, report);
    }
}

/// The part of [`all`] that is models whose names begin with `FROM` to `TO`: a program contains no others, for
/// targets that cannot hold all at once.
pub fn models_between<T: Scalar, const FROM: u8, const TO: u8>(
    inputs: u64,
    report: &mut impl FnMut(Hash),
) {
    for_each(&mut Models::<T, _, FROM, TO> { without: &[], inputs, report, scalar: PhantomData });
}

/// Runs one function, reporting where the module says.
fn run<T: Scalar>(
    name: &'static str,
    inputs: u64,
    mut function: impl FnMut(&Inputs<T>, &mut Results),
    report: &mut impl FnMut(Hash),
) {
    let mut results = Results::default();
    for index in 0..inputs {
        function(&Inputs::new(index), &mut results);
        let count = index + 1;
        if [BRIEF, SHORT, LONG].contains(&count) {
            report(Hash { name, scalar: T::NAME, count, hash: results.0 });
        }
    }
}

struct Models<'a, T, R, const FROM: u8, const TO: u8> {
    without: &'a [&'a str],
    inputs: u64,
    report: &'a mut R,
    scalar: PhantomData<T>,
}

impl<T: Scalar, R: FnMut(Hash), const FROM: u8, const TO: u8> Each for Models<'_, T, R, FROM, TO> {
    fn each<S: Specimen>(&mut self) {
        let wanted = const { FROM <= S::NAME.as_bytes()[0] && S::NAME.as_bytes()[0] <= TO };
        if !wanted || self.without.contains(&S::NAME) {
            return;
        }
        let visitor = Model { name: S::NAME, inputs: self.inputs, report: self.report };
        S::show::<T, _>(&mut Typical, visitor).expect("typical parameters are valid");
    }
}

struct Model<'a, R> {
    name: &'static str,
    inputs: u64,
    report: &'a mut R,
}

impl<T: Scalar, R: FnMut(Hash)> Visitor<T> for Model<'_, R> {
    type Output = ();

    fn visit(self, model: &impl Bsdf<Color = T>) {
        let function = |i: &Inputs<T>, out: &mut Results| {
            let (f, pdf) = model.eval_pdf(i.wo, i.wi);
            out.numbers([f, pdf]);
            out.sample(model.sample(i.wo, i.u[2], [i.u[0], i.u[1]]));
        };
        run(self.name, self.inputs, function, self.report);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_reported_and_all_hashes_differ() {
        let mut seen = alloc::collections::BTreeMap::new();
        all::<f32>(BRIEF, &mut |hash| {
            assert_eq!(hash.count, BRIEF);
            assert!(seen.insert(hash.hash, hash.name).is_none(), "{hash}");
        });
        assert_eq!(seen.len(), functions::<f32>().len() + crate::models::NAMES.len());
    }

    #[test]
    fn a_last_bit_changes_a_hash_and_the_sign_of_nan_does_not() {
        let hash = |x: f32| {
            let mut results = Results::default();
            results.number(x);
            results
        };
        assert_ne!(hash(1.0), hash(1.0_f32.next_up()));
        assert_eq!(hash(f32::NAN), hash(-f32::NAN));
    }
}
