//! The pieces that a picture is rendered in.

use etendue_scene::film::Crop;

/// Edge of a tile in pixels: small enough for an even load, large enough for coherent rays.
const EDGE: u32 = 16;

/// A rectangle of pixels on the full film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tile {
    pub(crate) offset: [u32; 2],
    pub(crate) size: [u32; 2],
}

impl From<Tile> for Crop {
    fn from(Tile { offset, size }: Tile) -> Self {
        Self { offset, size }
    }
}

impl Tile {
    /// Number of tiles of a crop.
    pub(crate) fn count(crop: &Crop) -> u64 {
        crop.size.map(|pixels| u64::from(pixels.div_ceil(EDGE))).iter().product()
    }

    /// The tiles of a crop along a Hilbert curve, so that consecutive tiles look at the same part of
    /// the scene.
    pub(crate) fn cover(crop: &Crop) -> Vec<Self> {
        let counts = crop.size.map(|pixels| pixels.div_ceil(EDGE));
        let mut places: Vec<[u32; 2]> =
            (0..counts[1]).flat_map(|y| (0..counts[0]).map(move |x| [x, y])).collect();
        places.sort_by_cached_key(|&place| hilbert_index(place));
        places
            .into_iter()
            .map(|place| {
                let begin = place.map(|p| p * EDGE);
                Self {
                    offset: [0, 1].map(|axis| crop.offset[axis] + begin[axis]),
                    size: [0, 1].map(|axis| EDGE.min(crop.size[axis] - begin[axis])),
                }
            })
            .collect()
    }

    /// Number of its pixels.
    pub(crate) fn area(self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }

    /// The pixels of the tile, row by row.
    pub(crate) fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        let Self { offset: [left, top], size: [width, height] } = self;
        (top..top + height).flat_map(move |y| (left..left + width).map(move |x| [x, y]))
    }
}

impl Tile {
    /// Groups of neighbouring pixels, all of one colour of a chessboard over the film and from a rectangle of the given size: of
    /// each the places in the tile, row by row.
    pub(crate) fn groups(
        self,
        rectangle: [u32; 2],
    ) -> impl Iterator<Item = impl Iterator<Item = usize>> {
        let [width, height] = self.size;
        let squares = (0..height.div_ceil(rectangle[1]))
            .flat_map(move |y| (0..width.div_ceil(rectangle[0])).map(move |x| [x, y]));
        squares.flat_map(|square| [0, 1].map(|colour| (square, colour))).map(
            move |(square, colour)| {
                let range = |axis: usize| {
                    let begin = square[axis] * rectangle[axis];
                    begin..(begin + rectangle[axis]).min(self.size[axis])
                };
                let (columns, rows) = (range(0), range(1));
                rows.flat_map(move |y| columns.clone().map(move |x| [x, y]))
                    .filter(move |[x, y]| (x + self.offset[0] + y + self.offset[1]) % 2 == colour)
                    .map(move |[x, y]| (y * width + x) as usize)
            },
        )
    }

    /// The pixel at a place.
    pub(crate) fn pixel(self, place: usize) -> [u32; 2] {
        let (width, place) = (self.size[0], place as u32);
        [self.offset[0] + place % width, self.offset[1] + place / width]
    }
}

/// How far along the Hilbert curve through the square of 2³² × 2³² cells a cell lies.
///
/// # Source
/// Warren, "Hacker's Delight", 2nd edition, section 16-3: quadrant by quadrant from the largest.
fn hilbert_index([mut x, mut y]: [u32; 2]) -> u64 {
    let mut index = 0_u64;
    for bit in (0..u32::BITS).rev() {
        let (right, upper) = (x >> bit & 1, y >> bit & 1);
        index = index << 2 | u64::from((3 * right) ^ upper);
        if upper == 0 {
            // The two lower quadrants are traversed transposed, the right one mirrored as well.
            if right == 1 {
                (x, y) = (!x, !y);
            }
            (x, y) = (y, x);
        }
    }
    index
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn tiles_cover_every_pixel_of_the_crop_once() {
        for size in [[1, 1], [16, 16], [17, 33], [100, 3]] {
            let crop = Crop { offset: [5, 7], size };
            let pixels: Vec<[u32; 2]> =
                Tile::cover(&crop).into_iter().flat_map(Tile::pixels).collect();
            let distinct: HashSet<[u32; 2]> = pixels.iter().copied().collect();
            assert_eq!(Tile::count(&crop), Tile::cover(&crop).len() as u64);
            assert_eq!(pixels.len(), (size[0] * size[1]) as usize);
            assert_eq!(distinct.len(), pixels.len());
            assert!(pixels.iter().all(|p| (0..2).all(|axis| {
                (crop.offset[axis]..crop.offset[axis] + size[axis]).contains(&p[axis])
            })));
        }
    }

    #[test]
    fn groups_hold_every_pixel_of_a_tile_once_and_one_colour_each() {
        for (size, rectangle) in [([16, 16], [4, 4]), ([16, 16], [8, 4]), ([5, 3], [4, 4])] {
            let tile = Tile { offset: [7, 2], size };
            let mut places = HashSet::new();
            for group in tile.groups(rectangle) {
                let group: Vec<usize> = group.collect();
                let colours: HashSet<u32> =
                    group.iter().map(|&place| tile.pixel(place).iter().sum::<u32>() % 2).collect();
                assert!(group.len() <= (rectangle[0] * rectangle[1] / 2) as usize);
                assert!(colours.len() <= 1);
                assert!(group.into_iter().all(|place| places.insert(place)));
            }
            let pixels: Vec<[u32; 2]> = (0..places.len()).map(|place| tile.pixel(place)).collect();
            assert_eq!(pixels, tile.pixels().collect::<Vec<_>>());
        }
    }

    #[test]
    fn consecutive_tiles_of_a_square_are_neighbours() {
        let tiles = Tile::cover(&Crop { offset: [0, 0], size: [EDGE * 16; 2] });
        for pair in tiles.windows(2) {
            let distance: u32 =
                (0..2).map(|axis| pair[0].offset[axis].abs_diff(pair[1].offset[axis])).sum();
            assert_eq!(distance, EDGE);
        }
    }
}
