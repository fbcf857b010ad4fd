//! How many samples each pixel gets.

use etendue_math::{Real, hash_u64};
use etendue_scene::film::Crop;

use super::schedule::Bounds;

/// Steps per level in which levels are balanced against the budget.
const STEPS: u32 = 64;

/// Pixels to either side of a pixel over which its error is averaged.
const NEIGHBOURS: usize = 3;

/// For each pixel a number of 64ths of a level: which pixels are the first to be doubled where their
/// errors are alike.
pub(super) fn dither(crop: &Crop) -> Vec<u8> {
    let pixel = |x: u32, y: u32| (hash_u64(u64::from(y) << 32 | u64::from(x)) % 64) as u8;
    let [left, top] = crop.offset;
    let [width, height] = crop.size;
    (top..top + height).flat_map(|y| (left..left + width).map(move |x| pixel(x, y))).collect()
}

/// The level which each pixel deserves, up to a constant: half the binary logarithm of the variance in
/// its neighbourhood. The squared error of a picture is least with samples in proportion to standard
/// deviations.
///
/// * `variances`: of equally many samples of each pixel, row by row. They are averaged over 7 × 7
///   pixels, fewer at the border.
///
/// Where nothing varies the result is −∞.
///
/// # Source
/// Neyman, "On the Two Different Aspects of the Representative Method", JRSS 97(4), 1934.
pub(super) fn merits(variances: &[f32], width: usize) -> Vec<f32> {
    let blurred: Vec<f32> = variances.chunks_exact(width).flat_map(averages).collect();
    let height = blurred.len() / width;
    let mut merits = vec![0.0; blurred.len()];
    for x in 0..width {
        let column: Vec<f32> = (0..height).map(|y| blurred[y * width + x]).collect();
        for (y, variance) in averages(&column).into_iter().enumerate() {
            merits[y * width + x] = 0.5 * core::f32::consts::LOG2_E * Real::ln(variance);
        }
    }
    merits
}

/// Mean of each number and its neighbours.
fn averages(numbers: &[f32]) -> Vec<f32> {
    let around = |i: usize| {
        let end = (i + NEIGHBOURS + 1).min(numbers.len());
        let window = &numbers[i.saturating_sub(NEIGHBOURS)..end];
        window.iter().sum::<f32>() / window.len() as f32
    };
    (0..numbers.len()).map(around).collect()
}

/// The levels that a budget is spent on: `⌊merit + dither + k⌋` within the bounds and not below the
/// present level, with the largest `k` (in 64ths) that keeps the number of samples within the budget.
///
/// Whole levels cost little: samples within a factor √2 of the best number raise the variance by 2 % in
/// the mean.
///
/// * `merits`: of each pixel, from [`merits`]; `None` where all deserve the same.
/// * `budget`: samples of one half of all pixels. Where the least that the bounds allow exceeds it,
///   that is the result.
pub(super) fn levels(
    merits: Option<&[f32]>,
    dither: &[u8],
    present: &[u8],
    bounds: Bounds,
    budget: u64,
) -> Vec<u8> {
    // Far beyond half the logarithm of any f32; −∞ ends up below every bound.
    const LIMIT: i32 = 1 << 20;
    let merit = |i: usize| merits.map_or(0.0, |merits| STEPS as f32 * merits[i]) as i32;
    let deserved: Vec<i32> =
        (0..dither.len()).map(|i| merit(i).clamp(-LIMIT, LIMIT) + i32::from(dither[i])).collect();
    let level = |i: usize, k: i32| {
        let whole = (deserved[i] + k).div_euclid(STEPS as i32);
        (whole.clamp(bounds.lowest as i32, bounds.highest as i32) as u8).max(present[i])
    };
    let cost = |k: i32| (0..deserved.len()).map(|i| 1_u64 << level(i, k)).sum::<u64>();
    let (mut affordable, mut excessive) = (-LIMIT, LIMIT);
    while excessive - affordable > 1 {
        let middle = i32::midpoint(affordable, excessive);
        if cost(middle) <= budget { affordable = middle } else { excessive = middle }
    }
    (0..deserved.len()).map(|i| level(i, affordable)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [40, 30];
    const PIXELS: usize = 1200;
    const ANY: Bounds = Bounds { lowest: 0, highest: 20 };

    fn dithered() -> Vec<u8> {
        dither(&Crop { offset: [0, 0], size: SIZE })
    }

    fn cost(levels: &[u8]) -> u64 {
        levels.iter().map(|&level| 1 << level).sum()
    }

    #[test]
    fn pixels_of_equal_merit_get_powers_of_two_that_fill_the_budget() {
        let mut present = vec![0; PIXELS];
        for samples in [1, 2, 3, 5, 8, 11, 16, 64] {
            let budget = samples * PIXELS as u64;
            let levels = levels(None, &dithered(), &present, ANY, budget);
            let floor = samples.ilog2() as u8;
            let ceiling = floor + u8::from(!samples.is_power_of_two());
            assert_eq!(levels.iter().copied().min(), Some(floor), "{samples}");
            assert_eq!(levels.iter().copied().max(), Some(ceiling), "{samples}");
            // A 64th of the pixels, give or take the evenness of 1200 hashes, double at one step.
            assert!((0.95..=1.0).contains(&(cost(&levels) as f64 / budget as f64)), "{samples}");
            present = levels;
        }
    }

    #[test]
    fn samples_go_in_proportion_to_standard_deviations() {
        // The left half varies 16 times as much (in σ) as the right one.
        let width = SIZE[0] as usize;
        let variances: Vec<f32> =
            (0..PIXELS).map(|i| if i % width < 20 { 256.0 } else { 1.0 }).collect();
        let merits = merits(&variances, width);
        let levels = levels(Some(&merits), &dithered(), &[0; PIXELS], ANY, 100 * PIXELS as u64);
        let samples = |columns: core::ops::Range<usize>| {
            let inside = (0..PIXELS).filter(|i| columns.contains(&(i % width)));
            inside.map(|i| 1_u64 << levels[i]).sum::<u64>() as f64
        };
        // Away from where both sides mix. Levels of 510 pixels a side are rounded at random: 3 %.
        let ratio = samples(0..17) / samples(23..40);
        assert!((ratio / 16.0 - 1.0).abs() < 0.1, "{ratio}");
    }

    #[test]
    fn levels_stay_within_the_bounds_and_never_fall() {
        let mut variances = vec![0.0; PIXELS];
        variances[620] = f32::INFINITY;
        let merits = merits(&variances, SIZE[0] as usize);
        let bounds = Bounds { lowest: 3, highest: 9 };
        let mut present = vec![3; PIXELS];
        present[0] = 7;
        let levels = levels(Some(&merits), &dithered(), &present, bounds, 1 << 40);
        assert_eq!((levels[0], levels[1], levels[620]), (7, 3, 9));
        // 7 × 7 pixels see the infinite one.
        let [left, right] = [616, 624].map(|i| levels[i]);
        assert_eq!((left, &levels[617..624], right), (3, &[9; 7][..], 3));
        let below = [700, 740, 780].map(|i| levels[i]);
        assert_eq!(below, [9, 9, 3]);
    }

    #[test]
    fn a_budget_below_the_least_gives_the_least() {
        let bounds = Bounds { lowest: 3, highest: 9 };
        assert_eq!(levels(None, &dithered(), &[0; PIXELS], bounds, 0), [3; PIXELS]);
    }
}
