//! Values that may vary in space.

use alloc::boxed::Box;

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;

use super::VolumeGrid;
use crate::Color;
use crate::geometry::{Aabb, Transform};
use crate::texture::{Wrap, split};

/// How values between the centres of a grid's cells are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GridFilter {
    /// Linearly along all three axes.
    #[default]
    Trilinear,
    /// The value of the cell.
    Nearest,
}

/// A colour at every point of space: finite and not negative.
///
/// # Source
/// Mitsuba 3's `constvolume` and `gridvolume`.
#[derive(Clone, Debug)]
pub struct Volume {
    values: Values,
    /// The unit cube, in the world.
    bounds: Aabb,
}

#[derive(Clone, Debug)]
enum Values {
    /// With the placement of the unit cube, which bounds it.
    Constant(Color, Box<Transform>),
    Grid(Box<PlacedGrid>),
}

/// A grid that fills the image of the unit cube.
#[derive(Clone, Debug)]
pub struct PlacedGrid {
    /// Its values.
    pub grid: VolumeGrid,
    /// What places the unit cube.
    pub to_world: Transform,
    /// How values between the centres of cells are found.
    pub filter: GridFilter,
    /// What lies outside.
    pub wrap: Wrap,
}

const UNIT_CUBE: Aabb = Aabb { min: Vec3::ZERO, max: Vec3::ONE };

impl Volume {
    /// The same colour everywhere; a channel that is NaN, infinite or negative counts as 0.
    pub fn constant(color: Color) -> Self {
        Self::constant_in(color, &Transform::IDENTITY)
    }

    /// The same, with the image of the unit cube as [`bounds`](Self::bounds).
    pub fn constant_in(color: Color, to_world: &Transform) -> Self {
        let color = color.map(|c| if c > 0.0 && c.is_finite() { c } else { 0.0 });
        let values = Values::Constant(color, Box::new(*to_world));
        Self { values, bounds: to_world.aabb(&UNIT_CUBE) }
    }

    /// A grid that fills the unit cube, placed by `to_world` and continued beyond by `wrap`.
    pub fn grid(grid: VolumeGrid, to_world: Transform, filter: GridFilter, wrap: Wrap) -> Self {
        let bounds = to_world.aabb(&UNIT_CUBE);
        Self { values: Values::Grid(Box::new(PlacedGrid { grid, to_world, filter, wrap })), bounds }
    }

    /// The same without colour: the mean of the channels.
    pub(super) fn grey(self) -> Self {
        let values = match self.values {
            Values::Constant(color, place) => Values::Constant(Color::splat(color.mean()), place),
            Values::Grid(mut placed) => {
                placed.grid = placed.grid.grey();
                Values::Grid(placed)
            }
        };
        Self { values, ..self }
    }

    /// What places the unit cube that [`bounds`](Self::bounds) surrounds.
    pub fn to_world(&self) -> &Transform {
        match &self.values {
            Values::Constant(_, to_world) => to_world,
            Values::Grid(placed) => &placed.to_world,
        }
    }

    /// The grid that it is, if it is one; else it is the same everywhere.
    pub fn placed_grid(&self) -> Option<&PlacedGrid> {
        match &self.values {
            Values::Constant(..) => None,
            Values::Grid(placed) => Some(placed),
        }
    }

    /// A box around the unit cube, in the world.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether channels may differ.
    pub fn is_coloured(&self) -> bool {
        match &self.values {
            Values::Constant(color, _) => !(color.r == color.g && color.g == color.b),
            Values::Grid(placed) => placed.grid.has_colours(),
        }
    }

    /// The colour at a point of the world.
    #[inline]
    pub fn at(&self, position: Vec3) -> Color {
        match &self.values {
            Values::Constant(color, _) => *color,
            Values::Grid(placed) => placed.at(position),
        }
    }

    /// The number at a point of the world: the mean of a constant colour, the luminance of a grid's; of greys the value
    /// itself, as in Mitsuba 3 (3.9.1).
    pub fn value_at(&self, position: Vec3) -> f32 {
        match &self.values {
            Values::Constant(color, _) => color.mean(),
            Values::Grid(placed) if !placed.grid.has_colours() => placed.at(position).r,
            Values::Grid(placed) => placed.at(position).luminance(),
        }
    }

    /// The mean over the cells.
    pub(crate) fn mean(&self) -> Color {
        match &self.values {
            Values::Constant(color, _) => *color,
            Values::Grid(placed) => placed.grid.mean(),
        }
    }

    /// The largest value of each channel.
    pub(crate) fn max(&self) -> Color {
        match &self.values {
            Values::Constant(color, _) => *color,
            Values::Grid(placed) => placed.grid.max(),
        }
    }

    /// A bound of all channels within a box of the world.
    pub(super) fn largest_within(&self, region: &Aabb) -> f32 {
        match &self.values {
            Values::Constant(color, _) => color.max_channel(),
            Values::Grid(placed) => placed.largest_within(region),
        }
    }
}

impl PlacedGrid {
    #[inline]
    fn at(&self, position: Vec3) -> Color {
        let place = self.to_world.inverse_point(position);
        match self.filter {
            GridFilter::Trilinear => trilinear(&self.grid, place, self.wrap),
            GridFilter::Nearest => {
                let cell = [0, 1, 2].map(|axis| {
                    let cells = self.grid.size()[axis];
                    self.wrap.apply(split(place[axis] * cells as f32).0, cells)
                });
                self.grid.cell(cell)
            }
        }
    }

    fn largest_within(&self, region: &Aabb) -> f32 {
        let local = self.to_world.inverse().aabb(region);
        let cells = [0, 1, 2].map(|axis| {
            cells_between(local.min[axis], local.max[axis], self.grid.size()[axis], self.wrap)
        });
        largest_cell(&self.grid, cells)
    }
}

/// Along one axis, the first and the last cell that a value between two places depends on.
fn cells_between(first: f32, last: f32, cells: u32, wrap: Wrap) -> [u32; 2] {
    // Half a cell for what is between centres, and another one for rounding.
    let [first, last] = [split(first * cells as f32 - 1.0).0, split(last * cells as f32 + 1.0).0];
    let inside = 0..cells as i32;
    match wrap {
        Wrap::Clamp => [first, last].map(|cell| wrap.apply(cell, cells)),
        _ if inside.contains(&first) && inside.contains(&last) => [first as u32, last as u32],
        _ => [0, cells - 1],
    }
}

fn largest_cell(grid: &VolumeGrid, [xs, ys, zs]: [[u32; 2]; 3]) -> f32 {
    let mut largest = 0.0_f32;
    for z in zs[0]..=zs[1] {
        for y in ys[0]..=ys[1] {
            for x in xs[0]..=xs[1] {
                largest = largest.max(grid.cell([x, y, z]).max_channel());
            }
        }
    }
    largest
}

#[inline]
fn trilinear(grid: &VolumeGrid, place: Vec3, wrap: Wrap) -> Color {
    let axes = [0, 1, 2].map(|axis| {
        let cells = grid.size()[axis];
        let (below, fraction) = split(place[axis] * cells as f32 - 0.5);
        let pair = [below, below.saturating_add(1)];
        (pair.map(|cell| wrap.apply(cell, cells)), fraction)
    });
    grid.between(axes.map(|axis| axis.0), axes.map(|axis| axis.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;

    /// Two cells along x with 1 and 3, stretched over [0, 4] × [0, 1]².
    fn pair(filter: GridFilter, wrap: Wrap) -> Volume {
        let grid = VolumeGrid::new([2, 1, 1], 1, [1.0, 3.0].into()).expect("two cells");
        let to_world = Transform::scale(DVec3::new(4.0, 1.0, 1.0)).expect("a scale");
        Volume::grid(grid, to_world, filter, wrap)
    }

    #[test]
    fn values_lie_at_the_centres_of_cells_and_are_linear_between() {
        let volume = pair(GridFilter::Trilinear, Wrap::Clamp);
        let at = |x| volume.at(Vec3::new(x, 0.5, 0.2)).r;
        assert_eq!([at(1.0), at(2.0), at(3.0)], [1.0, 2.0, 3.0]);
        assert_eq!([at(0.0), at(-9.0), at(3.9), at(9.0)], [1.0, 1.0, 3.0, 3.0]);
        assert!(!volume.is_coloured());
    }

    #[test]
    fn cells_are_continued_as_asked() {
        let at = |wrap, x| pair(GridFilter::Nearest, wrap).at(Vec3::new(x, 0.5, 0.5)).r;
        assert_eq!([at(Wrap::Clamp, 5.0), at(Wrap::Clamp, -1.0)], [3.0, 1.0]);
        assert_eq!([at(Wrap::Repeat, 5.0), at(Wrap::Repeat, -1.0)], [1.0, 3.0]);
        assert_eq!([at(Wrap::Mirror, 5.0), at(Wrap::Mirror, 7.0)], [3.0, 1.0]);
    }

    #[test]
    fn the_bound_of_a_region_holds_and_knows_where_little_is() {
        let volume = pair(GridFilter::Nearest, Wrap::Clamp);
        let region = |min: f32, max: f32| Aabb {
            min: Vec3::new(min, 0.0, 0.0),
            max: Vec3::new(max, 1.0, 1.0),
        };
        assert_eq!(volume.largest_within(&region(-1.0, 4.0)), 3.0);
        let grid = VolumeGrid::new([8, 1, 1], 1, (0..8).map(|i| i as f32).collect()).expect("8");
        let ramp = Volume::grid(grid, Transform::IDENTITY, GridFilter::Trilinear, Wrap::Clamp);
        let low = ramp.largest_within(&region(0.0, 0.25));
        assert!((2.0..=4.0).contains(&low), "{low}");
    }
}
