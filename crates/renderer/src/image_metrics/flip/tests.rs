use super::*;
use etendue_scene::Color;

const WIDTH: u32 = 32;
const HEIGHT: u32 = 24;

fn picture(value: impl Fn(u32, u32) -> [f64; 3]) -> Image {
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let pixels = places.map(|(x, y)| value(x, y).map(|c| c as f32).into()).collect();
    Image::from_pixels([WIDTH, HEIGHT], pixels).expect("as many pixels")
}

/// Busy colours, and the same brighter and darker in places.
fn busy(scale: f64) -> [Image; 2] {
    let reference = |x: u32, y: u32| {
        [(x * 7 + y * 3) % 13, (x * 5 + y * 11) % 17, (x * x + y) % 19].map(f64::from)
    };
    let base = move |x, y| {
        let [r, g, b] = reference(x, y);
        [r / 13.0, g / 17.0, b / 19.0]
    };
    let factor = |x: u32, y: u32| 0.75 + 0.5 * f64::from((x + 2 * y) % 5) / 5.0;
    let test = picture(move |x, y| base(x, y).map(|c| scale * (c * factor(x, y)).min(1.0)));
    [test, picture(move |x, y| base(x, y).map(|c| scale * c))]
}

/// A smooth gradient, and the same with a darker patch.
fn patch(scale: f64) -> [Image; 2] {
    let base = move |x: u32, y: u32| {
        let [x, y] = [f64::from(x) / f64::from(WIDTH), f64::from(y) / f64::from(HEIGHT)];
        [0.2 + 0.6 * x, 0.3 + 0.4 * y, 0.5].map(|c| scale * c)
    };
    let inside = |x: u32, y: u32| (10..20).contains(&x) && (8..16).contains(&y);
    let test = picture(move |x, y| base(x, y).map(|c| if inside(x, y) { 0.6 * c } else { c }));
    [test, picture(base)]
}

/// Rounding of the published program, which computes in single precision: a few ε of colours of order 100, raised to 0.7.
const TOLERANCE: f64 = 2e-5;

#[test]
fn differences_are_those_of_the_published_program() {
    // NVIDIA's flip-evaluator 1.7 on the same pictures: mean, and pixels in columns 0, 7, 16, 31 of rows 0, 5, 12, 23.
    let [test, reference] = busy(1.0);
    let map = ldr(&test, &reference).expect("equal sizes");
    assert!((mean(&map) - 0.126_459_852).abs() < TOLERANCE, "{}", mean(&map));
    let want = [0.129_723_251, 0.143_245_399, 0.137_887_895, 0.213_214_591];
    for ([x, y], want) in [[0, 0], [7, 5], [16, 12], [31, 23]].into_iter().zip(want) {
        let got: f64 = map[y * WIDTH as usize + x];
        assert!((got - want).abs() < TOLERANCE, "{x} {y}: {got} {want}");
    }
    let [test, reference] = patch(1.0);
    let map = ldr(&test, &reference).expect("equal sizes");
    assert!((mean(&map) - 0.071_004_950).abs() < TOLERANCE, "{}", mean(&map));
    assert!((map[12 * WIDTH as usize + 16] - 0.530_758_858).abs() < TOLERANCE);
}

#[test]
fn differences_of_radiance_are_those_of_the_published_program_at_any_scale() {
    for scale in [1.0, 4.0] {
        let [test, reference] = busy(scale);
        let got = mean(&hdr(&test, &reference).expect("equal sizes"));
        assert!((got - 0.073_013_961).abs() < TOLERANCE, "{scale}: {got}");
    }
    let [test, reference] = patch(8.0);
    let got = mean(&hdr(&test, &reference).expect("equal sizes"));
    assert!((got - 0.045_565_996).abs() < TOLERANCE, "{got}");
}

#[test]
fn equal_pictures_do_not_differ_and_black_differs_from_white_by_all() {
    let [test, _] = busy(1.0);
    assert_eq!(mean(&ldr(&test, &test).expect("equal sizes")), 0.0);
    assert_eq!(mean(&hdr(&test, &test).expect("equal sizes")), 0.0);
    let [black, white] = [0.0, 1.0].map(|v| picture(|_, _| [v; 3]));
    let all = mean(&ldr(&black, &white).expect("equal sizes"));
    // By the map of colour differences: lightness differs by 100, green from blue by more.
    assert!((0.95..=1.0).contains(&all), "{all}");
    let nothing =
        Image::from_pixels([1, 1], vec![Color::new(f32::NAN, 0.0, 0.0)]).expect("a pixel");
    assert!(mean(&hdr(&nothing, &nothing).expect("equal sizes")).is_finite());
    assert!(ldr(&black, &nothing).is_err());
}
