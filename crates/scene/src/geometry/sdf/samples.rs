//! The samples of a distance field.

use alloc::vec::Vec;

/// Why values do not make a distance field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SdfError {
    /// There is no voxel, or there are 2³⁰ samples or more.
    #[error(
        "a distance field of {0} × {1} × {2} samples cannot be used: 2 or more along each axis make a voxel"
    )]
    Size(u32, u32, u32),
    /// Size and data disagree.
    #[error("{found} values instead of {expected}")]
    Length {
        /// As many as there are samples.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A value is NaN or infinite.
    #[error("the value {value} of sample ({x}, {y}, {z}) is not finite")]
    Value {
        /// The value.
        value: f32,
        /// Counted from 0.
        x: u32,
        /// Counted from 0.
        y: u32,
        /// Counted from 0.
        z: u32,
    },
}

/// Finite values at the points of a regular grid over the unit cube, its corners included: positive outside, negative
/// inside. x varies fastest, then y, then z.
#[derive(Clone, Debug, PartialEq)]
pub struct SdfSamples {
    size: [u32; 3],
    values: Vec<f32>,
}

impl SdfSamples {
    /// As many values as the size has samples.
    ///
    /// # Errors
    /// Fewer than 2 samples along an axis, 2³⁰ or more in all, another number of values, a value that is NaN or infinite.
    pub fn new(size: [u32; 3], values: Vec<f32>) -> Result<Self, SdfError> {
        let [x, y, z] = size;
        let count = size.iter().try_fold(1_u32, |count, &n| count.checked_mul(n));
        // The objects of a hierarchy are numbered with 30 bits.
        let count = count.filter(|&count| count < 1 << 30);
        let (true, Some(count)) = (size.iter().all(|&n| n >= 2), count) else {
            return Err(SdfError::Size(x, y, z));
        };
        if values.len() != count as usize {
            return Err(SdfError::Length { expected: count as usize, found: values.len() });
        }
        let samples = Self { size, values };
        if let Some(index) = samples.values.iter().position(|value| !value.is_finite()) {
            let [x, y, z] = samples.place(index as u32);
            return Err(SdfError::Value { value: samples.values[index], x, y, z });
        }
        Ok(samples)
    }

    /// Samples along x, y and z.
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    /// All values.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The place of a sample by its index.
    #[inline]
    pub(super) fn place(&self, index: u32) -> [u32; 3] {
        let row = index / self.size[0];
        [index % self.size[0], row % self.size[1], row / self.size[1]]
    }

    /// The index of a sample by its place.
    #[inline]
    pub(super) fn index(&self, [x, y, z]: [u32; 3]) -> u32 {
        (z * self.size[1] + y) * self.size[0] + x
    }

    /// A value by its place.
    #[inline]
    pub(super) fn value(&self, place: [u32; 3]) -> f64 {
        f64::from(self.values[self.index(place) as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn x_varies_fastest() {
        let values = (0..24).map(|i| i as f32).collect();
        let samples = SdfSamples::new([2, 3, 4], values).expect("24 values");
        assert_eq!(samples.value([1, 0, 0]), 1.0);
        assert_eq!(samples.value([0, 1, 0]), 2.0);
        assert_eq!(samples.value([0, 0, 1]), 6.0);
        assert_eq!(samples.place(samples.index([1, 2, 3])), [1, 2, 3]);
    }

    #[test]
    fn what_makes_no_distance_field_is_refused() {
        let refused = |size, values| SdfSamples::new(size, values).expect_err("bad");
        assert_eq!(refused([2, 1, 2], vec![0.0; 4]), SdfError::Size(2, 1, 2));
        assert_eq!(refused([0, 2, 2], vec![]), SdfError::Size(0, 2, 2));
        assert_eq!(refused([1 << 16, 1 << 16, 2], vec![]), SdfError::Size(1 << 16, 1 << 16, 2));
        let short = SdfError::Length { expected: 8, found: 7 };
        assert_eq!(refused([2; 3], vec![0.0; 7]), short);
        let mut values = vec![-1.0; 8];
        values[5] = f32::INFINITY;
        let infinite = SdfError::Value { value: f32::INFINITY, x: 1, y: 0, z: 1 };
        assert_eq!(refused([2; 3], values), infinite);
    }
}
