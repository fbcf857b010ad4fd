use alloc::vec::Vec;

use super::*;
use crate::Color;
use crate::geometry::Transform;
use crate::medium::{GridFilter, Volume, VolumeGrid};
use crate::texture::Wrap;
use etendue_math::Real;
use etendue_math::quadrature::Adaptive;

fn lobe(g: f32) -> Phase {
    Phase::HenyeyGreenstein(HenyeyGreenstein::new(g).expect("in (−1, 1)"))
}

fn table(values: &[f32]) -> Phase {
    Phase::Tabulated(TabulatedPhase::new(values).expect("a table"))
}

fn blend(weight: f32, parts: [Phase; 2]) -> Phase {
    let weight = Volume::constant(Color::new(weight, weight, weight));
    Phase::Blend(Box::new(BlendPhase { weight, parts }))
}

/// Each with its mean cosine.
fn all() -> Vec<(Phase, f64)> {
    let nested = blend(0.5, [Phase::Isotropic, lobe(0.8)]);
    let mut all = Vec::from([
        (Phase::Isotropic, 0.0),
        (lobe(0.8), 0.8),
        (Phase::Rayleigh, 0.0),
        // Linear from −1 to 1: ∫ μ (1 + μ)/2 dμ.
        (table(&[0.0, 2.0]), 1.0 / 3.0),
        // A tent over [0, 1], and one at either end.
        (table(&[0.0, 0.0, 0.0, 7.0, 0.0]), 0.5),
        (table(&[1.0, 0.0, 1.0]), 0.0),
        (blend(0.0, [Phase::Rayleigh, lobe(0.5)]), 0.0),
        (blend(1.0, [Phase::Rayleigh, lobe(0.5)]), 0.5),
        (blend(0.25, [table(&[2.0, 0.0]), nested]), 0.75 / -3.0 + 0.25 * 0.4),
    ]);
    // Steps that the sampling has to follow.
    let steps: Vec<f32> = (0..40).map(|i| if i % 5 == 0 { 3.0 } else { 0.1 }).collect();
    let ends = |i: usize| [f64::from(steps[i]), f64::from(steps[i + 1])];
    let (mut area, mut moment) = (0.0, 0.0);
    for i in 0..39 {
        let ([a, b], from) = (ends(i), -1.0 + 2.0 * i as f64 / 39.0);
        area += 0.5 * (a + b);
        moment += 0.5 * from * (a + b) + (a + 2.0 * b) / 6.0 * (2.0 / 39.0);
    }
    all.push((table(&steps), moment / area));
    all
}

const ALONG: Vec3 = Vec3::new(0.48, -0.6, 0.64);

/// By the cosine of the angle to `ALONG`.
fn at_cosine(phase: &Phase, cos: f64) -> f64 {
    let (sin, frame) = (Real::sqrt((1.0 - cos) * (1.0 + cos)), Frame::<f32>::from_normal(ALONG));
    let to = frame.to_world(Vec3::new(sin as f32, 0.0, cos as f32));
    f64::from(phase.eval(Vec3::ZERO, ALONG, to))
}

#[test]
fn the_density_of_a_sampled_direction_is_the_phase_function_there() {
    for (phase, _) in all() {
        for i in 0..256 {
            let u = [(i % 16) as f32 / 16.0, (i / 16) as f32 / 16.0];
            let (to, density) = phase.sample(Vec3::ZERO, ALONG, u);
            let found = phase.eval(Vec3::ZERO, ALONG, to);
            // Unit vectors rounded once: 1e-7 of 1 − cos θ + 0.02, cubed; of the cosine, 2e-7 times 30 per unit of the
            // steepest table, beside its smallest values 0.03.
            assert!((found - density).abs() < 1e-4 * density + 1e-5, "{phase:?} {u:?}");
        }
    }
}

#[test]
fn phase_functions_integrate_to_one_and_have_their_mean_cosines() {
    for (phase, mean_cosine) in all() {
        let rule = Adaptive::<f64, 10>::new(40);
        // Between the nodes of every table, where the integrands are smooth.
        let pieces = 39 * 4;
        let integral = |weight: &dyn Fn(f64) -> f64| {
            let mut sum = 0.0;
            for i in 0..pieces {
                let edge = |i: usize| -1.0 + 2.0 * i as f64 / pieces as f64;
                let mut integrand = |cos| 2.0 * f64::PI * weight(cos) * at_cosine(&phase, cos);
                sum += rule.integrate([edge(i), edge(i + 1)], 1e-7, &mut integrand);
            }
            sum
        };
        // Densities have single precision, directions are rounded to 1e-7 of a cosine.
        let total = integral(&|_| 1.0);
        assert!((total - 1.0).abs() < 2e-6, "{phase:?}: {total}");
        let mean = integral(&|cos| cos);
        assert!((mean - mean_cosine).abs() < 2e-6, "{phase:?}: {mean}, not {mean_cosine}");
    }
}

#[test]
fn samples_fall_where_the_density_says() {
    let (cells, n) = (24, 200_000);
    for (phase, _) in all() {
        let mut counts = Vec::from([0.0; 24]);
        for i in 0..n {
            // A lattice by the golden ratio.
            let u = (f64::from(i) + 0.5) / f64::from(n);
            let v = 0.618_033_988_749_895 * f64::from(i);
            let u = [u as f32, (v - Real::floor(v)) as f32];
            let u = u.map(|u| Real::min(u, f32::ONE_MINUS_EPSILON));
            let (to, _) = phase.sample(Vec3::ZERO, ALONG, u);
            assert!((to.length() - 1.0).abs() < 1e-6);
            let cell = (0.5 * (1.0 + to.dot(ALONG)) * cells as f32) as usize;
            counts[cell.min(cells - 1)] += 1.0 / f64::from(n);
        }
        for (cell, found) in counts.into_iter().enumerate() {
            let edge = |i: usize| -1.0 + 2.0 * i as f64 / cells as f64;
            let mut density = |cos| 2.0 * f64::PI * at_cosine(&phase, cos);
            let rule = Adaptive::<f64, 10>::new(40);
            let expected = rule.integrate([edge(cell), edge(cell + 1)], 1e-6, &mut density);
            // Every inverse is monotonous: but for the choice among two parts, counts are exact to one of each edge and
            // to 1e-7 of a cosine.
            assert!((found - expected).abs() < 2e-4, "{phase:?} {cell}: {found} {expected}");
        }
    }
}

#[test]
fn values_are_those_of_mitsuba() {
    // Values by Mitsuba 3.9.1.
    let tab = table(&[0.5, 1.0, 0.0, 3.0]);
    let mix = blend(0.25, [lobe(0.5), lobe(-0.5)]);
    let of_tab = [
        (-1.0, 0.043_405_894),
        (-0.9, 0.049_916_781),
        (-0.3, 0.082_471_199),
        (0.0, 0.043_405_894),
        (0.2, 0.017_362_351),
        (0.5, 0.065_108_843),
        (1.0, 0.260_435_37),
    ];
    let others = [(&Phase::Rayleigh, 0.5, 0.074_603_871), (&mix, 0.5, 0.075_361_282)];
    let of_tab = of_tab.into_iter().map(|(cos, value)| (&tab, cos, value));
    for (phase, cos, value) in of_tab.chain(others) {
        let found = at_cosine(phase, cos);
        // Eight digits; a cosine rounded to 1e-7.
        assert!((found - value).abs() < 2e-7, "{phase:?} {cos}: {found} {value}");
    }
}

#[test]
fn the_weight_of_a_blend_differs_from_place_to_place() {
    let grid = VolumeGrid::new([2, 1, 1], 1, [0.0, 3.0].into()).expect("two cells");
    let weight = Volume::grid(grid, Transform::IDENTITY, GridFilter::Nearest, Wrap::Clamp);
    let parts = [Phase::Isotropic, Phase::Rayleigh];
    let phase = Phase::Blend(Box::new(BlendPhase { weight, parts }));
    let at = |x| phase.eval(Vec3::new(x, 0.5, 0.5), Vec3::Z, Vec3::Z);
    assert_eq!(at(0.25), uniform_sphere::pdf::<f32>());
    // A weight above 1 counts as 1.
    assert_eq!(at(0.75), rayleigh::pdf(1.0_f32));
    for (x, first) in [(0.25, true), (0.75, false)] {
        let place = Vec3::new(x, 0.5, 0.5);
        let (to, density) = phase.sample(place, Vec3::Z, [0.4, 0.1]);
        let part = if first { Phase::Isotropic } else { Phase::Rayleigh };
        assert_eq!((to, density), part.sample(place, Vec3::Z, [0.4, 0.1]));
    }
}

#[test]
fn tables_that_are_none_are_refused() {
    use etendue_sampling::TableError;
    for few in [&[] as &[f32], &[1.0]] {
        assert_eq!(TabulatedPhase::new(few).err(), Some(TableError::Empty));
    }
    assert_eq!(TabulatedPhase::new(&[0.0; 3]).err(), Some(TableError::AllZero));
    for bad in [-1.0, f32::NAN, f32::INFINITY] {
        let refused = TabulatedPhase::new(&[1.0, 1.0, bad]).err();
        assert_eq!(refused, Some(TableError::Weight { index: 2 }));
    }
    // As large and as small as numbers are.
    for extreme in [f32::MAX, f32::MIN_POSITIVE] {
        let phase = table(&[extreme, extreme]);
        // A few roundings.
        assert!((at_cosine(&phase, 0.3) * 4.0 * f64::PI - 1.0).abs() < 1e-6, "{extreme}");
    }
}
