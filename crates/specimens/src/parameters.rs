//! Where a specimen's parameters come from.

use core::hint::black_box;

use etendue_math::Real;

/// A source of parameters.
pub trait Parameters {
    /// A number in whose place a scene might have `typical`.
    fn number<T: Real>(&mut self, typical: f64) -> T;

    /// One of several forms of a model; the first is the typical one.
    fn choice<F: Copy, const N: usize>(&mut self, forms: [F; N]) -> F;
}

/// The typical parameters.
///
/// Numbers are opaque to the optimiser, as if read at run time; forms are known to it, as in a program
/// that was written for one of them.
#[derive(Clone, Copy, Debug)]
pub struct Typical;

impl Parameters for Typical {
    #[inline(always)]
    fn number<T: Real>(&mut self, typical: f64) -> T {
        T::lit(black_box(typical as f32) as f64)
    }

    #[inline(always)]
    fn choice<F: Copy, const N: usize>(&mut self, forms: [F; N]) -> F {
        forms[0]
    }
}

/// Parameters made of somebody's bytes: any bits at all, numbers in [0, 1], and some next to the
/// typical ones, so that constructors let enough of them pass. Zeros where the bytes end.
#[derive(Clone, Copy, Debug)]
pub struct Hostile<'a>(&'a [u8]);

impl<'a> Hostile<'a> {
    /// A source that reads `bytes` from the front.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// The next `N` bytes.
    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        let n = N.min(self.0.len());
        let (front, rest) = self.0.split_at(n);
        bytes[..n].copy_from_slice(front);
        self.0 = rest;
        bytes
    }

    /// The next number, whatever its bits.
    pub fn raw<T: Real>(&mut self) -> T {
        T::lit(if T::SIGNIFICAND_BITS == f32::SIGNIFICAND_BITS {
            f32::from_le_bytes(self.bytes()) as f64
        } else {
            f64::from_le_bytes(self.bytes())
        })
    }

    /// Whether all bytes have been read.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Parameters for Hostile<'_> {
    fn number<T: Real>(&mut self, typical: f64) -> T {
        let [kind] = self.bytes();
        match kind % 4 {
            0 => self.raw(),
            1 => T::lit(u16::from_le_bytes(self.bytes()) as f64 / u16::MAX as f64),
            2 => {
                // The typical number times a power of two, up to 2⁻³² and 2³² away.
                let [exponent, sign] = self.bytes().map(|b: u8| b as i8);
                let power = Real::powi(2.0_f64, exponent.unsigned_abs() as u32 / 4);
                let scale = if exponent < 0 { 1.0 / power } else { power };
                T::lit(if sign == i8::MIN { -typical } else { typical } * scale)
            }
            _ => T::lit(typical),
        }
    }

    fn choice<F: Copy, const N: usize>(&mut self, forms: [F; N]) -> F {
        let [index] = self.bytes();
        forms[index as usize % N]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_numbers_are_any_bits_and_never_run_out() {
        let mut source = Hostile::new(&[0, 0, 0, 0xc0, 0x7f, 1, 0xff, 0xff, 3]);
        assert!(source.number::<f32>(0.5).is_nan());
        assert_eq!(source.number::<f32>(0.5), 1.0);
        assert_eq!(source.number::<f64>(0.5), 0.5);
        assert!(source.is_empty());
        assert_eq!(source.number::<f64>(0.5), 0.0);
        assert_eq!(source.choice([7, 8]), 7);
    }
}
