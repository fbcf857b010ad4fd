//! Integer hashes: the source of every random number's address.

/// A bijective mix of 32 bits with good avalanche.
///
/// # Source
/// C. Wellons, "Prospecting for Hash Functions", 2018, `lowbias32`.
#[inline]
pub const fn hash_u32(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A bijective mix of 64 bits with good avalanche.
///
/// # Source
/// S. Vigna's `splitmix64` finaliser (Stafford's variant 13).
#[inline]
pub const fn hash_u64(mut x: u64) -> u64 {
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// One step of an address: a state and the next coordinate give a new state.
#[inline]
pub const fn mix_u64(state: u64, coordinate: u64) -> u64 {
    hash_u64(
        state ^ coordinate.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x9e37_79b9_7f4a_7c15),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flipping_one_bit_flips_about_half_of_the_bits() {
        for bit in 0..64 {
            let flips: u32 = (0..1000_u64)
                .map(|i| (hash_u64(i * 77_777) ^ hash_u64((i * 77_777) ^ (1 << bit))).count_ones())
                .sum();
            // 1000 trials of 64 fair bits: mean 32 000, standard deviation 126; 6 σ.
            assert!((31_240..32_760).contains(&flips), "bit {bit}: {flips}");
        }
    }
}
