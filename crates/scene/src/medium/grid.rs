//! Values on a regular grid in space.

use alloc::vec::Vec;

use etendue_math::Spectrum;

use crate::Color;

/// Why values do not make a grid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GridError {
    /// There is no cell, or there are more than can be numbered.
    #[error("a grid of {0} × {1} × {2} cells cannot be used")]
    Size(u32, u32, u32),
    /// Only 1 (grey) and 3 (RGB) channels have a meaning.
    #[error("a grid of {0} channels cannot be used, only one of 1 or 3")]
    Channels(u32),
    /// Size and data disagree.
    #[error("{found} values instead of {expected}")]
    Length {
        /// Cells × channels.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A value is NaN, infinite or negative.
    #[error("the value {value} in cell ({x}, {y}, {z}) is not finite or negative")]
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

/// A grid of values, grey or RGB: finite and not negative. x varies fastest, then y, then z.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeGrid {
    size: [u32; 3],
    values: Values,
}

#[derive(Clone, Debug, PartialEq)]
enum Values {
    Grey(Vec<f32>),
    Rgb(Vec<[f32; 3]>),
}

impl VolumeGrid {
    /// A grid of values with interleaved channels.
    ///
    /// # Errors
    /// A size of 0, another number of channels than 1 or 3, another number of values than these make,
    /// a value that is NaN, infinite or negative.
    pub fn new(size: [u32; 3], channels: u32, data: Vec<f32>) -> Result<Self, GridError> {
        let [x, y, z] = size;
        // Cells are numbered with 31 bits along each axis, so that look-ups can count below 0.
        let numbered = size.iter().all(|&n| n > 0 && n < 1 << 31);
        let cells = size.iter().try_fold(1_usize, |cells, &n| cells.checked_mul(n as usize));
        let (true, Some(cells)) = (numbered, cells) else {
            return Err(GridError::Size(x, y, z));
        };
        if channels != 1 && channels != 3 {
            return Err(GridError::Channels(channels));
        }
        let expected = cells.saturating_mul(channels as usize);
        if data.len() != expected {
            return Err(GridError::Length { expected, found: data.len() });
        }
        let is_bad = |value: &f32| !(*value >= 0.0 && value.is_finite());
        if let Some(index) = data.iter().position(is_bad) {
            let cell = index / channels as usize;
            let (row, x) = (cell / size[0] as usize, cell % size[0] as usize);
            let (z, y) = (row / size[1] as usize, row % size[1] as usize);
            let [x, y, z] = [x, y, z].map(|i| i as u32);
            return Err(GridError::Value { value: data[index], x, y, z });
        }
        let values = if channels == 1 {
            Values::Grey(data)
        } else {
            Values::Rgb(data.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
        };
        Ok(Self { size, values })
    }

    /// The same without colour: the means of the channels.
    pub(super) fn grey(mut self) -> Self {
        if let Values::Rgb(colours) = &self.values {
            self.values = Values::Grey(colours.iter().map(|&c| Color::from(c).mean()).collect());
        }
        self
    }

    /// Cells along x, y and z.
    #[inline]
    pub fn size(&self) -> [u32; 3] {
        self.size
    }

    /// Memory of the values.
    #[cfg(feature = "std")]
    pub(crate) fn bytes(&self) -> usize {
        match &self.values {
            Values::Grey(values) => size_of_val(&**values),
            Values::Rgb(values) => size_of_val(&**values),
        }
    }

    /// Whether it has colours.
    pub fn has_colours(&self) -> bool {
        matches!(self.values, Values::Rgb(_))
    }

    /// The mean over all cells.
    pub(super) fn mean(&self) -> Color {
        let mut sums = [0.0_f64; 3];
        self.for_each(|color| {
            for (sum, channel) in sums.iter_mut().zip(color.to_array()) {
                *sum += f64::from(channel);
            }
        });
        let cells = self.size.iter().map(|&n| f64::from(n)).product::<f64>();
        sums.map(|sum| (sum / cells) as f32).into()
    }

    /// The largest value of each channel.
    pub(super) fn max(&self) -> Color {
        let mut largest = Color::black();
        self.for_each(|color| largest = largest.zip(color, f32::max));
        largest
    }

    fn for_each(&self, see: impl FnMut(Color)) {
        match &self.values {
            Values::Grey(values) => values.iter().map(|&value| Color::splat(value)).for_each(see),
            Values::Rgb(values) => values.iter().map(|&value| Color::from(value)).for_each(see),
        }
    }

    /// The value of a cell; the last one along an axis for larger indices.
    #[inline]
    pub fn cell(&self, cell: [u32; 3]) -> Color {
        let [x, y, z] = [0, 1, 2].map(|axis| cell[axis].min(self.size[axis] - 1) as usize);
        match &self.values {
            Values::Grey(values) => Color::splat(values[self.index(x, y, z)]),
            Values::Rgb(values) => Color::from(values[self.index(x, y, z)]),
        }
    }

    /// The value between two cells along each axis, which exist, at fractions of the way.
    #[inline]
    pub(super) fn between(&self, cells: [[u32; 2]; 3], fractions: [f32; 3]) -> Color {
        match &self.values {
            Values::Grey(values) => {
                Color::splat(self.blend(cells, fractions, |index| values[index]))
            }
            Values::Rgb(values) => self.blend(cells, fractions, |index| Color::from(values[index])),
        }
    }

    #[inline(always)]
    fn blend<C: Spectrum<Real = f32>>(
        &self,
        cells: [[u32; 2]; 3],
        [fx, fy, fz]: [f32; 3],
        value: impl Fn(usize) -> C,
    ) -> C {
        let [xs, ys, zs] = cells.map(|pair| pair.map(|cell| cell as usize));
        let mix = |a: C, b: C, fraction: f32| a.scale(1.0 - fraction) + b.scale(fraction);
        let along_x =
            |y, z| mix(value(self.index(xs[0], y, z)), value(self.index(xs[1], y, z)), fx);
        let along_y = |z| mix(along_x(ys[0], z), along_x(ys[1], z), fy);
        mix(along_y(zs[0]), along_y(zs[1]), fz)
    }

    #[inline(always)]
    fn index(&self, x: usize, y: usize, z: usize) -> usize {
        (z * self.size[1] as usize + y) * self.size[0] as usize + x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn x_varies_fastest() {
        let grid = VolumeGrid::new([2, 3, 4], 1, (0..24).map(|i| i as f32).collect()).expect("24");
        assert_eq!(grid.cell([1, 0, 0]).r, 1.0);
        assert_eq!(grid.cell([0, 1, 0]).g, 2.0);
        assert_eq!(grid.cell([0, 0, 1]).b, 6.0);
        assert_eq!(grid.cell([9, 9, 9]).r, 23.0);
        let rgb = VolumeGrid::new([1, 1, 2], 3, (0..6).map(|i| i as f32).collect()).expect("two");
        assert_eq!(rgb.cell([0, 0, 1]), Color::new(3.0, 4.0, 5.0));
        assert_eq!((rgb.mean(), rgb.max()), (Color::new(1.5, 2.5, 3.5), Color::new(3.0, 4.0, 5.0)));
        assert_eq!((grid.mean(), grid.max()), (Color::splat(11.5), Color::splat(23.0)));
    }

    #[test]
    fn what_makes_no_grid_is_refused() {
        let refused =
            |size, channels, data| VolumeGrid::new(size, channels, data).expect_err("bad");
        assert_eq!(refused([0, 1, 1], 1, vec![]), GridError::Size(0, 1, 1));
        assert_eq!(refused([1, 1, 1], 2, vec![0.0; 2]), GridError::Channels(2));
        let short = GridError::Length { expected: 3, found: 2 };
        assert_eq!(refused([1, 1, 1], 3, vec![0.0; 2]), short);
        let negative = GridError::Value { value: -1.0, x: 1, y: 0, z: 1 };
        let data = vec![0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0];
        assert_eq!(refused([2, 2, 2], 1, data), negative);
        assert!(matches!(refused([1; 3], 1, vec![f32::NAN]), GridError::Value { x: 0, .. }));
    }
}
