//! One way of computing a quantity.

use core::hint::black_box;
use std::rc::Rc;

use etendue_math::{Real, Spectrum};

use super::domain::Domain;

/// A precision that is also a colour of one channel.
pub(super) trait Scalar: Real + Spectrum<Real = Self> {}
impl<T: Real + Spectrum<Real = T>> Scalar for T {}

/// The width of the numbers a variant computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
}

impl Precision {
    /// Of a type.
    pub fn of<T: Real>() -> Self {
        if T::SIGNIFICAND_BITS > 24 { Self::Double } else { Self::Single }
    }

    /// As in Rust.
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "f32",
            Self::Double => "f64",
        }
    }
}

/// One way of computing what its family computes, in one precision.
pub struct Variant {
    name: &'static str,
    precision: Precision,
    evaluator: Box<dyn Evaluator>,
}

impl Variant {
    /// `function` at what `prepare` makes of every point of the domain.
    ///
    /// What `prepare` does is done once per material or earlier and costs no time; what `function` does is measured.
    pub fn new<P: 'static, I: 'static, C: Spectrum>(
        name: &'static str,
        domain: &Rc<Domain<P>>,
        prepare: impl Fn(&P) -> I + 'static,
        function: impl Fn(&I) -> C + 'static,
    ) -> Self {
        let inputs = domain.points.iter().map(&prepare).collect();
        let evaluator = Prepared { domain: Rc::clone(domain), inputs, prepare, function };
        Self { name, precision: Precision::of::<C::Real>(), evaluator: Box::new(evaluator) }
    }

    /// Its name, without the precision.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The width of its numbers.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Its name and precision.
    pub fn label(&self) -> String {
        format!("{}, {}", self.name, self.precision.name())
    }

    /// Its values at all points.
    pub fn values(&self) -> Vec<f64> {
        self.evaluator.values()
    }

    /// Its energies.
    pub fn energies(&self) -> Vec<f64> {
        self.evaluator.energies()
    }

    /// Evaluates it at every point and returns how many there are.
    pub fn pass(&self) -> usize {
        self.evaluator.pass()
    }

    /// The loop of [`pass`](Self::pass) without the evaluation.
    pub fn idle(&self) -> usize {
        self.evaluator.idle()
    }
}

/// A variant without the types of its inputs.
trait Evaluator {
    fn values(&self) -> Vec<f64>;
    fn energies(&self) -> Vec<f64>;
    fn pass(&self) -> usize;
    fn idle(&self) -> usize;
}

struct Prepared<P, I, A, F> {
    domain: Rc<Domain<P>>,
    inputs: Vec<I>,
    prepare: A,
    function: F,
}

impl<P, I, C: Spectrum, A: Fn(&P) -> I, F: Fn(&I) -> C> Evaluator for Prepared<P, I, A, F> {
    fn values(&self) -> Vec<f64> {
        self.inputs.iter().map(|input| (self.function)(input).mean().to_f64()).collect()
    }

    fn energies(&self) -> Vec<f64> {
        self.domain.energies(|point| (self.function)(&(self.prepare)(point)).mean().to_f64())
    }

    fn pass(&self) -> usize {
        for input in black_box(self.inputs.as_slice()) {
            black_box((self.function)(input));
        }
        self.inputs.len()
    }

    fn idle(&self) -> usize {
        for input in black_box(self.inputs.as_slice()) {
            black_box(input);
        }
        self.inputs.len()
    }
}
