//! What every model is tested for.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use crate::quadrature::{density_integral, directional_albedo};
use crate::{Bsdf, BsdfReal, BsdfVec, Density};

fn polar<T: Real>(cos: f64, phi: f64) -> Vec3<T> {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    Vec3::<T>::new(T::lit(sin * Real::cos(phi)), T::lit(sin * Real::sin(phi)), T::lit(cos))
}

fn directions<T: Real>() -> impl Iterator<Item = Vec3<T>> {
    let cosines = [1.0, 0.95, 0.7, 0.4, 0.15, 0.02, -0.1, -0.5, -0.9];
    cosines.into_iter().enumerate().map(|(i, cos)| polar::<T>(cos, 0.3 + 1.7 * i as f64))
}

/// A small regular grid of uniforms, its corners near 0 and 1 included.
fn uniforms<T: Real>() -> impl Iterator<Item = (T, [T; 2])> {
    let grid = [0.0, 1e-6, 0.1, 0.37, 0.5, 0.81, 1.0 - 1e-6, 1.0];
    let unit = |x: f64| T::lit(x).min(T::ONE_MINUS_EPSILON);
    grid.into_iter().flat_map(move |a| {
        grid.into_iter().flat_map(move |b| grid.map(|c| (unit(a), [unit(b), unit(c)])))
    })
}

/// `f(wo, wi) = f(wi, wo)` for directions on the same side.
pub(crate) fn reciprocal<B: Bsdf>(model: &B, tolerance: f64) {
    let mut seen = 0;
    for wo in directions::<BsdfReal<B>>() {
        for wi in directions::<BsdfReal<B>>() {
            let (a, b) = (model.eval(wo, wi), model.eval(wi, wo));
            for i in 0..B::Color::CHANNELS {
                let (a, b) = (a.channel(i).to_f64(), b.channel(i).to_f64());
                assert!((a - b).abs() <= tolerance * a.abs().max(b.abs()), "{wo:?} {wi:?} {a} {b}");
                seen += i32::from(a > 0.0);
            }
        }
    }
    assert!(seen > 20, "the model is black almost everywhere");
}

/// A sample's density is `pdf`, its weight `f cos / pdf`; `eval_pdf` is `eval` and `pdf`.
pub(crate) fn sampling_matches_density<B: Bsdf>(model: &B, tolerance: f64) {
    let mut seen = 0;
    for wo in directions::<BsdfReal<B>>() {
        for (u_lobe, u) in uniforms::<BsdfReal<B>>() {
            let Some(sample) = model.sample(wo, u_lobe, u) else { continue };
            let Density::Continuous(density) = sample.density else { continue };
            let (f, pdf) = model.eval_pdf(wo, sample.wi);
            assert_eq!((f, pdf), (model.eval(wo, sample.wi), model.pdf(wo, sample.wi)));
            let (density, pdf) = (density.to_f64(), pdf.to_f64());
            let conditioned = sample.wi.z().abs().to_f64() > 1e-4;
            // Far out in a lobe's tail the exponent amplifies the direction's rounding likewise.
            if !conditioned {
                continue; // the direction's rounding moves f by more than the tolerance
            }
            assert!(
                (density - pdf).abs() <= tolerance * density.max(1e-6),
                "{wo:?} {u:?}: {density} {pdf}"
            );
            for i in 0..B::Color::CHANNELS {
                let weight = sample.weight.channel(i).to_f64();
                let want = f.channel(i).to_f64() * sample.wi.z().abs().to_f64() / pdf;
                assert!(
                    density < 1e-6 || (weight - want).abs() <= tolerance * want,
                    "{wo:?} {u:?}: {weight} {want}"
                );
            }
            seen += 1;
        }
    }
    assert!(seen > 100, "hardly anything was sampled");
}

/// `∫ pdf ≤ 1`.
pub(crate) fn density_integrates_to_at_most_one<B: Bsdf>(model: &B) {
    for wo in directions::<BsdfReal<B>>().filter(|w| w.z() > BsdfReal::<B>::lit(0.1)) {
        let integral = density_integral::<B, 64>(model, wo).to_f64();
        // The rule's own error for the widths tested.
        assert!(integral < 1.0 + 1e-3 && integral > 0.3, "{wo:?} {integral}");
    }
}

/// The closed-form albedo is the integral.
pub(crate) fn albedo_is_closed_form<B: Bsdf>(model: &B, tolerance: f64) {
    for wo in directions::<BsdfReal<B>>().filter(|w| w.z() > BsdfReal::<B>::ZERO) {
        let closed = model.albedo(wo).map(|a| a.channel(0).to_f64());
        let integral = directional_albedo::<B, 64>(model, wo).channel(0).to_f64();
        assert!(
            closed.is_some_and(|a| (a - integral).abs() < tolerance),
            "{wo:?} {closed:?} {integral}"
        );
    }
}

/// No input gives a NaN, an infinity or a negative number.
pub(crate) fn total<B: Bsdf>(model: &B) {
    let hostile: alloc::vec::Vec<BsdfVec<B>> = hostile_directions::<BsdfReal<B>>().collect();
    for &wo in &hostile {
        for &wi in &hostile {
            let (f, pdf) = model.eval_pdf(wo, wi);
            for value in (0..B::Color::CHANNELS).map(|i| f.channel(i)).chain([pdf]) {
                assert!(
                    value.is_finite() && value >= BsdfReal::<B>::ZERO,
                    "{wo:?} {wi:?} {f:?} {pdf}"
                );
            }
            if !wo.is_finite() || wo.length_squared() == BsdfReal::<B>::ZERO {
                assert!(f.is_black() && pdf == BsdfReal::<B>::ZERO, "{wo:?} {wi:?}");
            }
        }
        for (u_lobe, u) in uniforms::<BsdfReal<B>>() {
            let Some(sample) = model.sample(wo, u_lobe, u) else { continue };
            let (Density::Continuous(p) | Density::Delta(p)) = sample.density;
            assert!(sample.wi.is_finite() && sample.weight.is_finite(), "{wo:?} {u:?} {sample:?}");
            assert!(p > BsdfReal::<B>::ZERO && p.is_finite(), "{wo:?} {u:?} {sample:?}");
            assert!((sample.wi.length().to_f64() - 1.0).abs() < 1e-5, "{wo:?} {u:?} {sample:?}");
        }
    }
}

fn hostile_directions<T: Real>() -> impl Iterator<Item = Vec3<T>> {
    let v = |x: f64, y: f64, z: f64| Vec3::<T>::new(T::lit(x), T::lit(y), T::lit(z));
    let unit = |w: Vec3<T>| w.try_normalize().unwrap_or(w);
    let regular = directions::<T>();
    let grazing = [1e-2, 1e-4, 1e-7, 1e-12].into_iter().flat_map(move |z| {
        [v(1.0, 0.0, z), v(-1.0, 0.0, z), v(0.0, 1.0, -z), v(z, -z, 1.0), v(0.6, 0.8, z)].map(unit)
    });
    let broken = [
        v(0.0, 0.0, 0.0),
        v(0.0, 0.0, 1.0),
        v(0.0, 0.0, -1.0),
        v(1.0, 0.0, 0.0),
        v(f64::NAN, 0.0, 1.0),
        v(0.0, 0.0, f64::NAN),
        v(0.6, f64::INFINITY, 0.8),
        v(0.0, 0.0, f64::INFINITY),
    ];
    regular.chain(grazing).chain(broken)
}
