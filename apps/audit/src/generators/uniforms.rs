//! Uniform numbers addressed by stream and index.

use etendue_math::{Real, mix_u64};

/// Three numbers in `[0, 1)`: `u_lobe`, `u[0]`, `u[1]` of sample `index` of a stream.
///
/// The same for every run, thread and order of evaluation, and the same bits, but for rounding
/// down, in both precisions.
pub fn uniforms<T: Real>(stream: u64, index: u64) -> [T; 3] {
    [0, 1, 2].map(|dimension| {
        T::from_random_bits(mix_u64(mix_u64(mix_u64(0x6175_6469, stream), index), dimension))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_the_unit_interval_and_streams_differ() {
        let n = 10_000;
        let mean = (0..n).map(|i| uniforms::<f64>(1, i)[2]).sum::<f64>() / n as f64;
        // Standard deviation of the mean: 0.0029; 5 of them.
        assert!((mean - 0.5).abs() < 0.0145, "{mean}");
        assert_ne!(uniforms::<f64>(1, 0), uniforms::<f64>(2, 0));
        assert!((uniforms::<f64>(1, 0)[0] - uniforms::<f32>(1, 0)[0] as f64).abs() < 1e-7);
    }
}
