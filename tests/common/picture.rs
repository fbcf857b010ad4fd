//! Pictures, and a reader and a writer of PFM that share no code with the command under test.

use std::path::Path;

/// Linear RGB, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<[f32; 3]>,
}

impl Picture {
    /// The pixel in a column and a row from the top.
    pub(crate) fn pixel(&self, column: usize, row: usize) -> [f32; 3] {
        self.pixels[row * self.width + column]
    }

    /// The part that starts at a column and a row.
    pub(crate) fn crop(&self, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> Self {
        let rows = (y..y + height).flat_map(|row| {
            let start = row * self.width + x;
            &self.pixels[start..start + width]
        });
        Self { width, height, pixels: rows.copied().collect() }
    }

    /// All samples one after the other.
    pub(crate) fn samples(&self) -> impl Iterator<Item = f32> {
        self.pixels.iter().flatten().copied()
    }

    /// The bits of all samples: equality that tells 0 from −0 and accepts equal NaNs.
    pub(crate) fn bits(&self) -> Vec<u32> {
        self.samples().map(f32::to_bits).collect()
    }

    /// Reads a colour PFM of little-endian samples.
    pub(crate) fn read_pfm(path: &Path) -> Self {
        let bytes = std::fs::read(path).expect("the picture exists");
        let mut parts = bytes.splitn(4, |&b| b == b'\n');
        let mut line = || core::str::from_utf8(parts.next().expect("a line")).expect("text");
        assert_eq!(line(), "PF");
        let size: Vec<usize> = line().split(' ').map(|n| n.parse().expect("a size")).collect();
        let scale: f32 = line().parse().expect("a scale");
        assert!(scale < 0.0, "little-endian samples have a negative scale");
        let [width, height] = size[..] else { panic!("two sizes, not {size:?}") };
        let samples = parts.next().expect("samples");
        assert_eq!(samples.len(), width * height * 12);
        let sample = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
        let pixel = |p: &[u8]| [sample(&p[..4]), sample(&p[4..8]), sample(&p[8..])];
        let rows_from_below = samples.chunks_exact(12 * width).rev();
        let pixels = rows_from_below.flat_map(|row| row.chunks_exact(12)).map(pixel).collect();
        Self { width, height, pixels }
    }

    /// The picture as a colour PFM of little-endian samples.
    pub(crate) fn to_pfm(&self) -> Vec<u8> {
        let mut bytes = format!("PF\n{} {}\n-1\n", self.width, self.height).into_bytes();
        for row in self.pixels.chunks_exact(self.width).rev() {
            bytes.extend(row.iter().flatten().flat_map(|x| x.to_le_bytes()));
        }
        bytes
    }
}
