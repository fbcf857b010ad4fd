//! Every model in both precisions: no bits as parameters, directions or uniforms make it panic or answer with
//! a NaN, an infinity or a negative number.
//!
//! The first byte chooses model and precision; the variable `MODEL` restricts the run to one of them.
#![no_main]

use std::env;
use std::sync::LazyLock;

use etendue_brdf::{Bsdf, Density};
use etendue_math::{Real, Vec3, Vector3};
use etendue_specimens::models::NAMES;
use etendue_specimens::{Each, Hostile, Scalar, Specimen, Visitor, for_each};
use libfuzzer_sys::fuzz_target;

/// Index of the one model that is wanted.
static WANTED: LazyLock<Option<usize>> = LazyLock::new(|| {
    let name = env::var("MODEL").ok()?;
    Some(NAMES.iter().position(|n| *n == name).expect("MODEL is the name of no specimen"))
});

fuzz_target!(|data: &[u8]| {
    let Some((&first, bytes)) = data.split_first() else { return };
    let chosen = WANTED.unwrap_or(first as usize / 2 % NAMES.len());
    for_each(&mut Attack { chosen, single: first % 2 == 0, bytes });
});

struct Attack<'a> {
    /// How many models come before the one under attack.
    chosen: usize,
    single: bool,
    bytes: &'a [u8],
}

impl Each for Attack<'_> {
    fn each<S: Specimen>(&mut self) {
        if self.chosen == 0 {
            if self.single { attack::<f32, S>(self.bytes) } else { attack::<f64, S>(self.bytes) }
        }
        self.chosen = self.chosen.wrapping_sub(1);
    }
}

/// Builds the model from the front of the bytes, if it lets itself be built, and calls it with the rest.
fn attack<T: Scalar, S: Specimen>(bytes: &[u8]) {
    // Parameters come from the first 32 bytes, whether the constructor takes them all or not.
    let (parameters, inputs) = bytes.split_at(bytes.len().min(32));
    let _refused = S::show::<T, _>(&mut Hostile::new(parameters), Calls(Hostile::new(inputs)));
}

struct Calls<'a>(Hostile<'a>);

impl<T: Scalar> Visitor<T> for Calls<'_> {
    type Output = ();

    fn visit(mut self, model: &impl Bsdf<Color = T>) {
        // The first call is made with zeros where there are no bytes.
        loop {
            let (wo, wi) = (direction::<T>(&mut self.0), direction::<T>(&mut self.0));
            let [u_lobe, u, v] = [(); 3].map(|()| self.0.raw::<T>());
            call(model, wo, wi, u_lobe, [u, v]);
            if self.0.is_empty() {
                break;
            }
        }
    }
}

/// Any bits; every other time brought to unit length where that is possible, and to the near side.
fn direction<T: Real>(source: &mut Hostile) -> Vec3<T> {
    let [kind] = source.bytes();
    let w = Vec3::<T>::new(source.raw(), source.raw(), source.raw());
    match kind % 4 {
        0 | 1 => w,
        2 => w.try_normalize().unwrap_or(w),
        _ => {
            let upper = Vec3::<T>::new(w.x(), w.y(), w.z().abs());
            upper.try_normalize().unwrap_or(upper)
        }
    }
}

fn call<T: Scalar>(model: &impl Bsdf<Color = T>, wo: Vec3<T>, wi: Vec3<T>, u_lobe: T, u: [T; 2]) {
    let valid = |x: T| Real::is_finite(x) && x >= T::ZERO;
    let (f, pdf) = model.eval_pdf(wo, wi);
    assert!(valid(f) && valid(pdf), "wo {wo:?} wi {wi:?}: f {f:?} pdf {pdf:?}");
    assert_eq!((f, pdf), (model.eval(wo, wi), model.pdf(wo, wi)), "wo {wo:?} wi {wi:?}");
    if let Some(albedo) = model.albedo(wo) {
        assert!(valid(albedo), "wo {wo:?}: albedo {albedo:?}");
    }
    let Some(sample) = model.sample(wo, u_lobe, u) else { return };
    let (Density::Continuous(p) | Density::Delta(p)) = sample.density;
    assert!(
        valid(sample.weight)
            && valid(p)
            && p > T::ZERO
            && valid(sample.eta)
            && sample.wi.is_finite(),
        "wo {wo:?} u_lobe {u_lobe:?} u {u:?}: {sample:?}"
    );
}
