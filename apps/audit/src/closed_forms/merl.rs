//! Files of measurements read as their authors' own code reads them.

use std::sync::OnceLock;

use etendue_brdf::{Bsdf, Interpolation, Measured, MerlTable};
use etendue_math::{Real, Rgb, Spectrum, Vec3};

use super::ClosedForm;
use crate::budget::Budget;
use crate::generators::unit_pair;
use crate::measure::{Outcome, Worst};
use crate::scalar::{Scalar, widen};

/// The entry that Matusik's BRDFRead.cpp finds, times its scale.
pub(super) const NEAREST: ClosedForm = ClosedForm {
    function: "Measured",
    name: "the published look-up",
    single: nearest::<f32>,
    double: nearest::<f64>,
};

/// Between the centres of bins: exactly what is linear between them.
pub(super) const TRILINEAR: ClosedForm = ClosedForm {
    function: "Measured",
    name: "linear data between bins",
    single: trilinear::<f32>,
    double: trilinear::<f64>,
};

const SIZE: [usize; 3] = [90, 90, 180];
const SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// Data that is linear in the bins and differs in every one of them.
fn entry(channel: usize, [h, d, phi]: [f64; 3]) -> f64 {
    1000.0 * (1.0 + channel as f64) + 3.0 * h + 2.0 * d + phi
}

/// The file as its format is described: three `i32`, then red, green and blue with φd running fastest.
fn file() -> &'static [u8] {
    static FILE: OnceLock<Vec<u8>> = OnceLock::new();
    FILE.get_or_init(|| {
        let mut file = Vec::with_capacity(MerlTable::BYTES);
        file.extend(SIZE.iter().flat_map(|&n| (n as i32).to_le_bytes()));
        for channel in 0..3 {
            for h in 0..SIZE[0] {
                for d in 0..SIZE[1] {
                    for phi in 0..SIZE[2] {
                        let at = [h, d, phi].map(|i| i as f64);
                        file.extend(entry(channel, at).to_le_bytes());
                    }
                }
            }
        }
        file
    })
}

/// θh, θd and φd in bins: the half vector turned to the pole about the normal and then about the bitangent.
fn bins(wo: [f64; 3], wi: [f64; 3]) -> [f64; 3] {
    let half = [0, 1, 2].map(|k| wo[k] + wi[k]);
    let length = half.iter().map(|x| x * x).sum::<f64>().sqrt();
    let half = half.map(|x| x / length);
    let (theta_h, phi_h) = (Real::acos(half[2].min(1.0)), Real::atan2(half[1], half[0]));
    let (sin, cos) = Real::sin_cos(-phi_h);
    let turned = [wi[0] * cos - wi[1] * sin, wi[0] * sin + wi[1] * cos, wi[2]];
    let (sin, cos) = Real::sin_cos(-theta_h);
    let difference =
        [turned[2] * sin + turned[0] * cos, turned[1], turned[2] * cos - turned[0] * sin];
    let theta_d = Real::acos(difference[2].min(1.0));
    let phi_d = Real::atan2(difference[1], difference[0]);
    let phi_d = if phi_d < 0.0 { phi_d + f64::PI } else { phi_d };
    let degrees = theta_h / (0.5 * f64::PI) * 90.0;
    [(degrees * 90.0).sqrt(), theta_d / (0.5 * f64::PI) * 90.0, phi_d / f64::PI * 180.0]
}

/// `worst` over pairs above the surface and channels, of the model's value against `literal` of the bins.
fn compared<T: Scalar>(
    budget: Budget,
    interpolation: Interpolation,
    literal: fn(usize, [f64; 3]) -> Option<f64>,
) -> Outcome
where
    Rgb<T>: Spectrum<Real = T>,
{
    let mut worst = Worst::default();
    let Ok(table) = MerlTable::parse(file()) else { return worst.within(0.0, "") };
    let model = Measured::<Rgb<T>>::new(table, interpolation);
    for i in 0..budget.pairs as u64 {
        let [wo, wi]: [Vec3<T>; 2] = unit_pair::<T>(321, i);
        let [o, w] = [wo, wi].map(widen::<T>);
        if o[2] < 0.05 || w[2] < 0.05 {
            continue;
        }
        let (value, at) = (model.eval(wo, wi), bins(o, w));
        for (channel, scale) in SCALE.into_iter().enumerate() {
            if let Some(want) = literal(channel, at) {
                let got = value.channel(channel).to_f64();
                let error = (got / (want * scale) - 1.0).abs();
                worst.observe(error, || format!("channel {channel}, bins {at:?}: {got}"));
            }
        }
    }
    // acos loses half of the digits near the pole; at bin edges nothing is compared.
    worst.within(1e-6, "relative")
}

/// The entry, unless rounding may decide between two.
fn nearest<T: Scalar>(budget: Budget) -> Outcome
where
    Rgb<T>: Spectrum<Real = T>,
{
    compared::<T>(budget, Interpolation::Nearest, |channel, at| {
        let inside = at.iter().all(|x| (x - x.round()).abs() > 1e-4);
        inside.then(|| entry(channel, [0, 1, 2].map(|k| at[k].floor().min(SIZE[k] as f64 - 1.0))))
    })
}

/// The same numbers at the fractions of bins, away from the ends, where nothing lies beyond, and
/// from the seam of φd.
fn trilinear<T: Scalar>(budget: Budget) -> Outcome
where
    Rgb<T>: Spectrum<Real = T>,
{
    compared::<T>(budget, Interpolation::Trilinear, |channel, at| {
        let inside = [0, 1, 2].iter().all(|&k| at[k] > 0.51 && at[k] < SIZE[k] as f64 - 0.51);
        inside.then(|| entry(channel, at.map(|x| x - 0.5)))
    })
}
