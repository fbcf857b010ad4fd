//! Models with one fault each, which checks must catch: a check that has never failed is no
//! evidence.

use etendue_brdf::registry::{Albedo, Energy, Reciprocity};
use etendue_brdf::{Bsdf, BsdfVec, Density, Lobes, Sample};
use etendue_math::{Vec3, Vector3};

use crate::budget::Budget;
use crate::checks::Context;
use crate::measure::Outcome;
use crate::scalar::Scalar;
use crate::subject::{Case, Laws, Subject};

/// What is wrong with an otherwise Lambertian model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    None,
    /// 3 instead of π, in `eval` alone.
    WrongConstant,
    /// `weight = f/pdf`.
    MissingCosine,
    /// The density depends on `wo` where it should on `wi`.
    SwappedAngle,
    /// `pdf` is twice the density, in `pdf` alone.
    DoubledDensity,
    /// f depends on `wo` alone.
    OneWayFactor,
    /// Reflects 1.05 of what arrives, consistently.
    EnergyGain,
    NanAtGrazing,
    /// −1/π below the surface.
    NegativeBehind,
    /// Tests `z <= 0` where it should test `!(z > 0)`.
    AcceptsNan,
    /// Sampled directions are 0.1 % too long.
    LongSamples,
    /// The first uniform is squared.
    BiasedSampler,
    /// Loses three digits in `f32` to a detour over a large number.
    Cancels,
}

struct Broken<T> {
    fault: Fault,
    albedo: T,
}

impl<T: Scalar> Broken<T> {
    fn outside(&self, wo: Vec3<T>, wi: Vec3<T>) -> bool {
        if self.fault == Fault::AcceptsNan {
            wo.z() <= T::ZERO || wi.z() <= T::ZERO
        } else {
            !(wo.z() > T::ZERO && wi.z() > T::ZERO && wo.is_finite() && wi.is_finite())
        }
    }
}

impl<T: Scalar> Bsdf for Broken<T> {
    type Color = T;

    fn lobes(&self) -> Lobes {
        Lobes { continuous: true, ..Lobes::default() }
    }

    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (T, T) {
        if self.outside(wo, wi) {
            let negative = self.fault == Fault::NegativeBehind;
            return (if negative { -T::FRAC_1_PI } else { T::ZERO }, T::ZERO);
        }
        let sound = self.albedo * T::FRAC_1_PI;
        let f = match self.fault {
            Fault::WrongConstant => self.albedo / T::lit(3.0),
            Fault::OneWayFactor => sound * wo.z(),
            Fault::NanAtGrazing if wi.z() < T::lit(1e-6) => T::NAN,
            Fault::Cancels => (sound * wi.z() + T::lit(1e4)) - T::lit(1e4),
            _ => sound,
        };
        let pdf = match self.fault {
            Fault::SwappedAngle => wo.z() * T::FRAC_1_PI,
            Fault::DoubledDensity => T::TWO * wi.z() * T::FRAC_1_PI,
            _ => wi.z() * T::FRAC_1_PI,
        };
        (f, pdf)
    }

    fn sample(&self, wo: BsdfVec<Self>, _: T, u: [T; 2]) -> Option<Sample<T>> {
        let u0 = if self.fault == Fault::BiasedSampler { u[0] * u[0] } else { u[0] };
        let (sin, cos) = (T::TWO * T::PI * u[1]).sin_cos();
        let (r, z) = (u0.sqrt(), (T::ONE - u0).sqrt());
        let wi = Vec3::<T>::new(r * cos, r * sin, z);
        if self.outside(wo, wi) {
            return None;
        }
        Some(Sample {
            wi: if self.fault == Fault::LongSamples { wi * T::lit(1.001) } else { wi },
            weight: if self.fault == Fault::MissingCosine { self.albedo / z } else { self.albedo },
            density: Density::Continuous(z * T::FRAC_1_PI),
            eta: T::ONE,
        })
    }

    fn albedo(&self, wo: BsdfVec<Self>) -> Option<T> {
        Some(if self.outside(wo, wo) { T::ZERO } else { self.albedo })
    }
}

/// What is wrong with an otherwise perfect, half-transparent pane of index 1.5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MirrorFault {
    None,
    /// Reflects 1.05 of its share.
    Gain,
    /// Reports half of the probability of reflection.
    HalfProbability,
    /// Refracts without dividing the tangential part by η.
    BentRay,
    /// Loses three digits of the refracted cosine in `f32` to a detour over a large number.
    Cancels,
}

struct Mirror<T> {
    fault: MirrorFault,
    eta: T,
}

impl<T: Scalar> Bsdf for Mirror<T> {
    type Color = T;

    fn lobes(&self) -> Lobes {
        Lobes { delta: true, transmission: true, ..Lobes::default() }
    }

    fn sample(&self, wo: BsdfVec<Self>, u_lobe: T, _: [T; 2]) -> Option<Sample<T>> {
        if wo.z() <= T::ZERO {
            return None;
        }
        let (eta, one) = (self.eta, T::ONE);
        let gain = if self.fault == MirrorFault::Gain { T::lit(1.05) } else { one };
        let p = T::lit(if self.fault == MirrorFault::HalfProbability { 0.25 } else { 0.5 });
        let bend = if self.fault == MirrorFault::BentRay { one } else { eta };
        Some(if u_lobe < T::HALF {
            let wi = Vec3::<T>::new(-wo.x(), -wo.y(), wo.z());
            Sample { wi, weight: gain, density: Density::Delta(p), eta: one }
        } else {
            let (x, y) = (-wo.x() / bend, -wo.y() / bend);
            let detour = T::lit(if self.fault == MirrorFault::Cancels { 1e4 } else { 0.0 });
            let z = ((one - x * x - y * y).sqrt() + detour) - detour;
            let wi = Vec3::<T>::new(x, y, -z);
            Sample { wi, weight: one / (eta * eta), density: Density::Delta(T::HALF), eta }
        })
    }
}

pub(crate) fn context() -> Context {
    // Large enough for the rarest of the faults to show, small enough for a test.
    Context { budget: Budget { samples: 1 << 14, pairs: 2000, ..Budget::TEST }, significance: 1e-4 }
}

pub(crate) fn laws() -> Laws {
    Laws {
        reciprocity: Reciprocity::UpToSquaredIndex,
        energy: Energy::Conserves,
        albedo: Albedo::ClosedForm,
    }
}

pub(crate) fn case<T: Scalar>(fault: Fault) -> Case<T> {
    let albedo = T::lit(if fault == Fault::EnergyGain { 1.05 } else { 1.0 });
    let lambert = |wo: [f64; 3], wi: [f64; 3]| {
        if wo[2] > 0.0 && wi[2] > 0.0 { core::f64::consts::FRAC_1_PI } else { 0.0 }
    };
    Case::new(format!("{fault:?}"), Broken { fault, albedo })
        .lossless()
        .published(&[(0.8, 1.0)])
        .textbook(lambert)
}

/// Outcome of a check on a model with a fault, in `f64`.
pub(crate) fn verdict(fault: Fault, check: fn(&Subject<f64>, &Context) -> Outcome) -> Outcome {
    check(&Subject { laws: &laws(), case: &case(fault) }, &context())
}

pub(crate) fn mirror<T: Scalar>(fault: MirrorFault) -> Case<T> {
    Case::new(format!("{fault:?}"), Mirror { fault, eta: T::lit(1.5) })
}

/// Outcome of a check on a delta model with a fault.
pub(crate) fn mirror_verdict(
    fault: MirrorFault,
    check: fn(&Subject<f64>, &Context) -> Outcome,
) -> Outcome {
    check(&Subject { laws: &laws(), case: &mirror(fault) }, &context())
}
