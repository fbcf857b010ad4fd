//! Exact summation.

/// Bits of a limb.
const RADIX: u32 = 32;

/// Limbs of an accumulator: bits of the weights 2⁻¹⁴⁹ to 2²⁰², of which the last one holds 64 instead of 32.
const LIMBS: usize = 10;

/// Bytes of an accumulator as one integer: 352 bits.
const BYTES: usize = 4 * (LIMBS + 1);

/// Terms after which carries have to be passed on: each adds less than 2³² to a limb of 63 bits.
const CARRY_AFTER: u32 = 1 << 30;

/// A sum of `f32` numbers without any rounding: an integer in units of 2⁻¹⁴⁹, the smallest `f32`.
///
/// Exact addition is associative and commutative. However terms are ordered, split into groups, stored in between and
/// [joined](Self::merge), the sum has the same bits; only what leaves it is rounded, once.
///
/// # Domain
/// All finite numbers, subnormal ones included, up to 2⁶² terms of any size. NaN and infinities are left out, and
/// [`add`](Self::add) says so.
///
/// # Cost
/// That of a [compensated sum](crate::CompensatedSum), a few nanoseconds per term: carries between limbs are deferred for 2³⁰ terms.
/// 88 bytes.
///
/// # Source
/// Kulisch, "Computer Arithmetic and Validity", 2nd edition, 2013, section 8 (complete arithmetic); with deferred carries as in
/// Neal, "Fast Exact Summation Using Small and Large Superaccumulators", arXiv:1505.05571, 2015.
///
/// # Examples
/// ```
/// use etendue_math::ExactSum;
/// let mut sum = ExactSum::default();
/// for x in [1e30_f32, 1.0, -1e30, 1e-30] {
///     sum.add(x);
/// }
/// assert_eq!(sum.total(), 1.0);
/// sum.add(-1.0);
/// assert_eq!(sum.total(), 1e-30);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct ExactSum {
    /// Limb `i` has the weight `2^(32 i − 149)`; limbs overlap and have signs until carries are passed on.
    limbs: [i64; LIMBS],
    /// Terms since then.
    pending: u32,
}

impl ExactSum {
    /// Bytes of the form in which a sum is stored.
    pub const BYTES: usize = BYTES;

    /// Adds one term and says whether it counts: NaN and infinities do not.
    #[inline]
    pub fn add(&mut self, x: f32) -> bool {
        if !x.is_finite() {
            return false;
        }
        let bits = x.to_bits();
        let exponent = bits >> 23 & 0xff;
        // Subnormal numbers have the exponent of the smallest normal ones, without their leading bit.
        let leading = u32::from(exponent != 0) << 23;
        let magnitude = i64::from(bits & 0x007f_ffff | leading);
        let sign = i64::from(bits as i32 >> 31);
        let significand = (magnitude ^ sign) - sign;
        let shift = exponent.saturating_sub(1);
        let (limb, offset) = ((shift / RADIX) as usize & 7, shift % RADIX);
        let shifted = significand << offset;
        self.limbs[limb] += shifted & 0xffff_ffff;
        self.limbs[limb + 1] += shifted >> RADIX;
        self.pending += 1;
        if self.pending == CARRY_AFTER {
            self.carry();
        }
        true
    }

    /// Adds all terms of another sum.
    pub fn merge(&mut self, other: &Self) {
        for (limb, more) in self.limbs.iter_mut().zip(other.limbs) {
            *limb = limb.wrapping_add(more);
        }
        // Limbs from which carries have been passed on hold as much as one term more.
        self.pending += other.pending + 1;
        if self.pending >= CARRY_AFTER {
            self.carry();
        }
    }

    /// Passes on carries: every limb but the last is then from 0 to 2³² − 1.
    fn carry(&mut self) {
        let mut carry = 0;
        let [limbs @ .., last] = &mut self.limbs;
        for limb in limbs {
            let value = *limb + carry;
            *limb = value & 0xffff_ffff;
            carry = value >> RADIX;
        }
        *last = last.wrapping_add(carry);
        self.pending = 0;
    }

    /// The sum rounded to the nearest `f32`, ties to even; infinite beyond the largest.
    pub fn total(&self) -> f32 {
        self.divided_by(1)
    }

    /// The sum divided by `count`, rounded once to the nearest `f32`, ties to even: the mean of `count` terms. 0 if there are none.
    pub fn divided_by(&self, count: u32) -> f32 {
        let mut sum = *self;
        sum.carry();
        let negative = sum.limbs[LIMBS - 1] < 0;
        if negative {
            sum.limbs = sum.limbs.map(i64::wrapping_neg);
            sum.carry();
        }
        let magnitude = rounded(sum.digits(), count);
        if negative { -magnitude } else { magnitude }
    }

    /// 32 bits per digit, the least significant first, of a sum whose carries have been passed on.
    fn digits(&self) -> [u32; LIMBS + 1] {
        core::array::from_fn(|i| match self.limbs.get(i) {
            Some(&limb) => limb as u32,
            None => (self.limbs[LIMBS - 1] >> RADIX) as u32,
        })
    }

    /// The sum as an integer in units of 2⁻¹⁴⁹: two's complement, the least significant byte first. Equal sums have equal bytes.
    pub fn to_bytes(&self) -> [u8; BYTES] {
        let mut sum = *self;
        sum.carry();
        let mut bytes = [0; BYTES];
        for (four, digit) in bytes.as_chunks_mut().0.iter_mut().zip(sum.digits()) {
            *four = digit.to_le_bytes();
        }
        bytes
    }

    /// The sum of [`to_bytes`](Self::to_bytes). Any bytes are a sum.
    pub fn from_bytes(bytes: &[u8; BYTES]) -> Self {
        let (digits, _) = bytes.as_chunks();
        let mut limbs = [0; LIMBS];
        for (limb, &digit) in limbs.iter_mut().zip(digits) {
            *limb = i64::from(u32::from_le_bytes(digit));
        }
        limbs[LIMBS - 1] |= i64::from(i32::from_le_bytes(digits[LIMBS])) << RADIX;
        Self { limbs, pending: 0 }
    }
}

impl PartialEq for ExactSum {
    fn eq(&self, other: &Self) -> bool {
        self.to_bytes() == other.to_bytes()
    }
}

impl Eq for ExactSum {}

/// An integer in units of 2⁻¹⁴⁹ divided by `count`, rounded to the nearest `f32`, ties to even; 0 for a count of 0.
fn rounded(digits: [u32; LIMBS + 1], count: u32) -> f32 {
    let Some(top) = digits.iter().rposition(|&digit| digit != 0) else { return 0.0 };
    if count == 0 {
        return 0.0;
    }
    // Division by a power of two only makes the unit smaller.
    let (divisor, finer) =
        if count.is_power_of_two() { (1, count.trailing_zeros()) } else { (u64::from(count), 0) };
    let mut quotient = digits;
    let mut remainder = 0_u64;
    if divisor > 1 {
        for digit in quotient[..=top].iter_mut().rev() {
            let dividend = remainder << RADIX | u64::from(*digit);
            // The remainder is below the divisor, so that a digit of the quotient has 32 bits.
            *digit = (dividend / divisor) as u32;
            remainder = dividend % divisor;
        }
    }
    let top = quotient.iter().rposition(|&digit| digit != 0).unwrap_or(0);
    let length = RADIX * top as u32 + (RADIX - quotient[top].leading_zeros());
    // What is left are the 24 bits of a significand, or fewer in a number that is subnormal: none is finer than 2⁻¹⁴⁹. The remainder is
    // finer still and only breaks ties.
    let dropped = length.saturating_sub(24).max(finer);
    // The bits from a place on, 32 of them at least.
    let from = |place: u32| {
        let digit = (place / RADIX) as usize;
        let next = quotient.get(digit + 1).copied().unwrap_or(0);
        (u64::from(next) << RADIX | u64::from(quotient[digit])) >> (place % RADIX)
    };
    let kept = from(dropped) as u32 & 0x00ff_ffff;
    let (half, beyond) = if dropped == 0 {
        let twice = 2 * remainder;
        (twice >= divisor, twice > divisor)
    } else {
        let place = dropped - 1;
        let (digit, offset) = ((place / RADIX) as usize, place % RADIX);
        let below = quotient[digit] & ((1 << offset) - 1) != 0
            || quotient[..digit].iter().any(|&digit| digit != 0);
        (from(place) & 1 == 1, below || remainder != 0)
    };
    // The leading bit of a significand counts as one more exponent, and rounding up carries into the exponent as it has to: the encoding of
    // floats is consecutive.
    let up = u32::from(half && (beyond || kept & 1 == 1));
    let exponent = dropped - finer;
    if exponent > 253 {
        return f32::INFINITY;
    }
    f32::from_bits(((exponent << 23) + kept + up).min(f32::INFINITY.to_bits()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mix_u64;

    extern crate alloc;
    use alloc::vec::Vec;

    /// Of any sign, any bits, and exponents from 2^`lowest` on over `span` of them.
    fn terms(count: u64, lowest: u32, span: u32) -> impl Iterator<Item = f32> {
        (0..count).map(move |i| {
            let random = mix_u64(i, u64::from(lowest));
            let exponent = lowest + (random >> 32) as u32 % span;
            f32::from_bits((random as u32 & 0x807f_ffff) | exponent << 23)
        })
    }

    fn sum(terms: impl IntoIterator<Item = f32>) -> ExactSum {
        let mut sum = ExactSum::default();
        for x in terms {
            assert!(sum.add(x));
        }
        sum
    }

    /// In units of the smallest f32; of numbers below 2⁻⁴⁰, which fit.
    fn reference(terms: impl IntoIterator<Item = f32>) -> i128 {
        let units = |x: f32| (f64::from(x) * f64::from_bits((1023 + 149) << 52)) as i128;
        terms.into_iter().map(units).sum()
    }

    /// That `value` is the f32 nearest to `sum / count` units, even where two are.
    fn is_nearest(value: f32, sum: i128, count: i128) -> bool {
        let error = |x: f32| (reference([x]) * count - sum).abs();
        let [below, above] = [value.next_down(), value.next_up()];
        let nearest = error(value) <= error(below) && error(value) <= error(above);
        let tie = error(value) == error(below) || error(value) == error(above);
        nearest && (!tie || value.to_bits() & 1 == 0)
    }

    const COUNT: u64 = if cfg!(miri) { 50 } else { 3000 };

    #[test]
    fn totals_and_means_are_those_of_integers_rounded_once() {
        for (lowest, span) in [(0, 1), (0, 3), (0, 25), (1, 90), (30, 40), (60, 1)] {
            for count in [1, 2, 3, 7, 64, 1000].into_iter().filter(|&n| n <= COUNT) {
                let terms: Vec<f32> = terms(count, lowest, span).collect();
                let (sum, exact) = (sum(terms.clone()), reference(terms.clone()));
                assert!(is_nearest(sum.total(), exact, 1), "{lowest} {span} {count}");
                for divisor in [1, 2, 3, 4, 5, 32, 1000, 1024, 1 << 31, u32::MAX] {
                    let mean = sum.divided_by(divisor);
                    assert!(
                        is_nearest(mean, exact, i128::from(divisor)),
                        "{lowest} {span} {count}: {mean:e} of {exact} / {divisor}"
                    );
                }
            }
        }
    }

    #[test]
    fn any_order_and_any_grouping_give_the_same_bits() {
        let all: Vec<f32> = terms(COUNT, 0, 255).collect();
        let whole = sum(all.clone());
        assert_eq!(whole, sum(all.iter().rev().copied()));
        for groups in [2, 3, 7] {
            let mut joined = ExactSum::default();
            for group in (0..groups).rev() {
                let part = sum(all.iter().skip(group).step_by(groups).copied());
                joined.merge(&ExactSum::from_bytes(&part.to_bytes()));
            }
            assert_eq!(whole.to_bytes(), joined.to_bytes());
            assert_eq!(whole.total().to_bits(), joined.total().to_bits());
        }
    }

    #[test]
    fn a_power_of_two_moves_through_all_limbs_without_a_trace() {
        // Numbers of the exponents 0 to 2²³ with the lowest bits set, scaled up to the largest.
        let small: Vec<f32> = terms(100, 127, 20).collect();
        let unscaled = sum(small.iter().copied()).total();
        for exponent in 27..227 {
            let scale = f32::from_bits(exponent << 23);
            assert_eq!(
                sum(small.iter().map(|x| x * scale)).total(),
                unscaled * scale,
                "{exponent}"
            );
        }
    }

    #[test]
    fn terms_cancel_to_nothing_and_the_smallest_one_is_kept() {
        let tiny = f32::from_bits(1);
        let mut sum = sum([f32::MAX, f32::MAX, -1.0, tiny, -f32::MAX, 1.0, -f32::MAX]);
        assert_eq!(sum.total(), tiny);
        assert!(sum.add(-tiny));
        assert_eq!(sum, ExactSum::default());
        assert_eq!(sum.total().to_bits(), 0);
    }

    #[test]
    fn beyond_the_largest_number_a_total_is_infinite_and_a_mean_is_not() {
        let sum = sum([-f32::MAX; 1000]);
        assert_eq!(sum.total(), f32::NEG_INFINITY);
        assert_eq!(sum.divided_by(1000), -f32::MAX);
        assert_eq!(sum.divided_by(0), 0.0);
    }

    #[test]
    fn what_is_not_finite_is_refused_and_leaves_the_sum_alone() {
        let mut sum = sum([0.25]);
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(!sum.add(x));
        }
        assert_eq!(sum.total(), 0.25);
    }

    #[test]
    fn carries_are_passed_on_before_a_limb_overflows() {
        // A limb that holds as much as 2³⁰ of the largest additions to it.
        let mut sum = ExactSum { pending: CARRY_AFTER - 1, ..ExactSum::default() };
        sum.limbs[4] = (1 << 62) - (1 << 32);
        let before = sum.total();
        assert!(sum.add(1.0));
        assert_eq!(sum.pending, 0);
        assert!(sum.limbs.iter().all(|limb| (0..1 << 32).contains(limb)));
        assert!((sum.total() - before).abs() <= before * f32::EPSILON);
    }

    #[test]
    fn any_bytes_are_a_sum_and_come_back() {
        let mut lowest = [0; BYTES];
        lowest[BYTES - 1] = 0x80;
        assert_eq!(ExactSum::from_bytes(&lowest).total(), f32::NEG_INFINITY);
        for seed in 0..if cfg!(miri) { 5 } else { 200 } {
            let bytes = core::array::from_fn(|i| mix_u64(seed, i as u64) as u8);
            let sum = ExactSum::from_bytes(&bytes);
            assert_eq!(sum.to_bytes(), bytes);
            let _ = sum.divided_by(3);
        }
    }
}
