//! One integer of every pixel of a tile.

use core::ops::Range;

use etendue_math::ExactSum;

use crate::codec::{Reader, StateError, Write as _};

/// Bytes of an integer.
const BYTES: usize = ExactSum::BYTES;

/// An integer in two's complement, the least significant byte first.
pub(super) type Integer = [u8; BYTES];

/// Integers of 352 bits without the bytes that say nothing of any of them: zeros below and copies of the sign above.
///
/// Bytes of the same place lie side by side, those of the least significant place first. To add two columns is to add bytes of
/// neighbouring pixels, which compilers turn into vector instructions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Column {
    /// The place of the first plane; 0 if there are none.
    begin: u8,
    /// Plane after plane, one byte per pixel in each.
    planes: Vec<u8>,
}

impl Column {
    /// Fewest bytes of a stored column.
    pub(super) const LEAST_BYTES: usize = 2;

    pub(super) fn new(integers: &[Integer]) -> Self {
        // Bits that differ in any integer from the zeros below and from the copies of the sign above.
        let (mut low, mut high) = ([0; BYTES], [0; BYTES]);
        for integer in integers {
            let above = sign(integer[BYTES - 1]);
            for ((low, high), byte) in low.iter_mut().zip(&mut high).zip(integer) {
                *low |= byte;
                *high |= byte ^ above;
            }
        }
        let says_something = |byte: &u8| *byte != 0;
        let begin = low.iter().position(says_something).unwrap_or(BYTES);
        // One place more for the sign, which is all that there is of some integers.
        let end = high.iter().rposition(says_something).map_or(0, |last| last + 2);
        let places = begin..end.max(begin + 1).min(BYTES);
        let mut planes = vec![0; places.len() * integers.len()];
        for (place, plane) in places.zip(planes.chunks_exact_mut(integers.len())) {
            for (byte, integer) in plane.iter_mut().zip(integers) {
                *byte = integer[place];
            }
        }
        Self { begin: begin as u8, planes }.trimmed(integers.len())
    }

    /// The places of which bytes are kept.
    fn places(&self, pixels: usize) -> Range<usize> {
        let begin = usize::from(self.begin);
        begin..begin + self.planes.len().checked_div(pixels).unwrap_or(0)
    }

    /// The integer of one of `pixels` pixels.
    pub(super) fn get(&self, pixel: usize, pixels: usize) -> Integer {
        if self.planes.is_empty() {
            return [0; BYTES];
        }
        let places = self.places(pixels);
        let top = self.planes[self.planes.len() - pixels + pixel];
        let mut integer = [sign(top); BYTES];
        integer[..places.start].fill(0);
        for (byte, plane) in integer[places].iter_mut().zip(self.planes.chunks_exact(pixels)) {
            *byte = plane[pixel];
        }
        integer
    }

    /// The integers of two columns of `pixels` pixels, added pixel by pixel.
    pub(super) fn sum(&self, other: &Self, pixels: usize) -> Self {
        if self.planes.is_empty() {
            return other.clone();
        }
        if other.planes.is_empty() {
            return self.clone();
        }
        let [a, b] = [self, other].map(|column| column.places(pixels));
        // One place more for what is carried out of the last.
        let places = a.start.min(b.start)..(a.end.max(b.end) + 1).min(BYTES);
        let mut planes = vec![0; places.len() * pixels];
        let (mut more, mut carry) = (vec![0; pixels], vec![0; pixels]);
        for (place, plane) in places.clone().zip(planes.chunks_exact_mut(pixels)) {
            self.read_plane(place, plane);
            other.read_plane(place, &mut more);
            for ((byte, &more), carry) in plane.iter_mut().zip(&more).zip(&mut carry) {
                let (sum, over) = byte.overflowing_add(more);
                let (sum, over_again) = sum.overflowing_add(*carry);
                *carry = u8::from(over | over_again);
                *byte = sum;
            }
        }
        Self { begin: places.start as u8, planes }.trimmed(pixels)
    }

    /// The bytes of any place, of a column that has planes.
    fn read_plane(&self, place: usize, bytes: &mut [u8]) {
        let pixels = bytes.len();
        let places = self.places(pixels);
        if place < places.start {
            bytes.fill(0);
        } else if place < places.end {
            bytes.copy_from_slice(&self.planes[(place - places.start) * pixels..][..pixels]);
        } else {
            let top = &self.planes[self.planes.len() - pixels..];
            for (byte, &top) in bytes.iter_mut().zip(top) {
                *byte = sign(top);
            }
        }
    }

    /// The same without planes that say nothing. Equal integers have equal columns.
    fn trimmed(self, pixels: usize) -> Self {
        let count = self.places(pixels).len();
        let plane = |i: usize| &self.planes[i * pixels..][..pixels];
        let repeats_the_sign = |i: usize| match i.checked_sub(1) {
            Some(below) => plane(i).iter().zip(plane(below)).all(|(&top, &next)| top == sign(next)),
            None => is_zero(plane(i)),
        };
        let end = (0..count).rev().find(|&i| !repeats_the_sign(i)).map_or(0, |top| top + 1);
        let zeros = (0..end).take_while(|&i| is_zero(plane(i))).count();
        let begin = if end == 0 { 0 } else { self.begin + zeros as u8 };
        Self { begin, planes: self.planes[zeros * pixels..end * pixels].to_vec() }
    }

    pub(super) fn write(&self, pixels: usize, bytes: &mut Vec<u8>) {
        bytes.u8(self.begin);
        bytes.u8(self.places(pixels).len() as u8);
        bytes.extend_from_slice(&self.planes);
    }

    /// Reads what [`write`](Self::write) has written of as many pixels.
    pub(super) fn read(reader: &mut Reader<'_>, pixels: usize) -> Result<Self, StateError> {
        let (begin, count) = (reader.u8()?, reader.u8()?);
        if usize::from(begin) + usize::from(count) > BYTES {
            return Err(StateError::new("a sum is too long"));
        }
        Ok(Self { begin, planes: reader.bytes(usize::from(count) * pixels)?.to_vec() })
    }
}

fn is_zero(plane: &[u8]) -> bool {
    plane.iter().all(|&byte| byte == 0)
}

/// The bytes above one that is the last: copies of its highest bit.
fn sign(byte: u8) -> u8 {
    (byte as i8 >> 7) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::mix_u64;

    /// Integers that fill `places`, of both signs.
    fn integers(seed: u64, pixels: usize, places: Range<usize>) -> Vec<Integer> {
        let integer = |pixel: usize| {
            let random = |place: usize| mix_u64(seed ^ pixel as u64, place as u64) as u8;
            let mut integer = [sign(random(places.end - 1)); BYTES];
            integer[..places.start].fill(0);
            for place in places.clone() {
                integer[place] = random(place);
            }
            integer
        };
        (0..pixels).map(integer).collect()
    }

    fn added(a: &Integer, b: &Integer) -> Integer {
        let mut sum = ExactSum::from_bytes(a);
        sum.merge(&ExactSum::from_bytes(b));
        sum.to_bytes()
    }

    #[test]
    fn integers_come_back_and_are_added_pixel_by_pixel() {
        for pixels in [1, 5, 256] {
            let ranges = [3..4, 0..9, 7..15, 20..BYTES, 0..BYTES, BYTES - 1..BYTES];
            for (seed, first) in ranges.iter().enumerate() {
                let a = integers(seed as u64, pixels, first.clone());
                let column = Column::new(&a);
                assert!(column.planes.len() <= first.len() * pixels, "{first:?}");
                for second in &ranges {
                    let b = integers(99, pixels, second.clone());
                    let sum = column.sum(&Column::new(&b), pixels);
                    let expected: Vec<Integer> =
                        a.iter().zip(&b).map(|(a, b)| added(a, b)).collect();
                    assert_eq!(sum, Column::new(&expected), "{first:?} {second:?}");
                    let found: Vec<Integer> = (0..pixels).map(|i| sum.get(i, pixels)).collect();
                    assert_eq!(found, expected, "{first:?} {second:?}");
                }
            }
        }
    }

    #[test]
    fn what_cancels_leaves_nothing() {
        let ones = [[1; BYTES], [0; BYTES], [2; BYTES]];
        let negated = ones.map(|integer| {
            let inverted = integer.map(|byte| !byte);
            let mut one = [0; BYTES];
            one[0] = 1;
            added(&inverted, &one)
        });
        assert_eq!(Column::new(&ones).sum(&Column::new(&negated), 3), Column::default());
        let minus_one = Column::new(&[[0xff; BYTES]]);
        assert_eq!((minus_one.planes.len(), minus_one.get(0, 1)), (1, [0xff; BYTES]));
    }

    #[test]
    fn stored_columns_come_back_and_longer_ones_than_sums_are_refused() {
        for pixels in [1, 7] {
            for places in [2..6, 30..BYTES] {
                let column = Column::new(&integers(5, pixels, places));
                let mut bytes = Vec::new();
                column.write(pixels, &mut bytes);
                assert_eq!(Column::read(&mut Reader::new(&bytes), pixels), Ok(column));
                assert!(Column::read(&mut Reader::new(&bytes[..bytes.len() - 1]), pixels).is_err());
            }
        }
        for (begin, count) in [(0, BYTES + 1), (BYTES, 1), (255, 255)] {
            let mut bytes = vec![0; 2 + 255];
            [bytes[0], bytes[1]] = [begin as u8, count as u8];
            assert!(Column::read(&mut Reader::new(&bytes), 1).is_err(), "{begin} {count}");
        }
    }
}
