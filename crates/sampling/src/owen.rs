//! Owen scrambling by a hash.

/// A random permutation of binary digits that keeps nesting: digit `k` counted from the *least*
/// significant is flipped by a hash of the digits below it and the key.
///
/// Applied to a number with reversed bits it is Owen's nested uniform scramble.
///
/// # Source
/// Laine and Karras 2011 introduced the form (multiplications carry upwards only); constants of the
/// improved version by N. Vegdahl, "Building a Better LK Hash", 2021, whose avalanche is better
/// than that of Burley's constants.
#[inline]
pub(crate) const fn scramble_reversed(mut x: u32, key: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(key);
    x = x.wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_digit_depends_only_on_the_digits_below_it() {
        for key in [0, 1, 0xdead_beef, u32::MAX] {
            for x in (0..10_000_u32).map(|i| i.wrapping_mul(0x9e37_79b9)) {
                for bit in 0..32 {
                    let change = scramble_reversed(x, key) ^ scramble_reversed(x ^ 1 << bit, key);
                    // Lower digits are untouched and the digit itself always changes.
                    assert_eq!(change.trailing_zeros(), bit, "{x:x} {key:x}");
                }
            }
        }
    }

    #[test]
    fn half_of_the_keys_flip_each_digit() {
        for bit in 0..32 {
            let flips = (0..10_000_u32)
                .filter(|&i| {
                    let key = etendue_math::hash_u32(i);
                    (scramble_reversed(0x1234_5678, key) ^ 0x1234_5678) >> bit & 1 == 1
                })
                .count();
            // 10 000 fair coins: standard deviation 50; 6 σ.
            assert!((4_700..5_300).contains(&flips), "bit {bit}: {flips}");
        }
    }
}
