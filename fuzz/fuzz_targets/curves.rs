//! Control points of curves: no panic, and as many points as the curves have.
#![no_main]

use std::path::Path;

use etendue_scene::geometry::CurveBasis;
use etendue_scene::load::parse_curves;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    for basis in [CurveBasis::Linear, CurveBasis::BSpline] {
        let Ok(file) = parse_curves(data, Path::new("a.txt"), basis) else { continue };
        let points: u64 = file.lengths.iter().map(|&length| u64::from(length)).sum();
        assert_eq!(points, file.points.len() as u64);
    }
});
