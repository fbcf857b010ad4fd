//! The binary files of the MERL database.

use core::error::Error;
use core::fmt;

/// Bins of θh, θd and φd.
pub(super) const SIZE: [usize; 3] = [90, 90, 180];
/// Entries of one channel.
const ENTRIES: usize = SIZE[0] * SIZE[1] * SIZE[2];
/// Bytes of the dimensions.
const HEADER: usize = 12;
/// What a stored number is multiplied by, per channel.
pub(super) const SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// The bytes of a file of the MERL database, checked.
///
/// ```text
/// 3 × i32    90, 90, 180: bins of θh, θd, φd
/// 3 × 1 458 000 × f64    red, then green, then blue; φd runs fastest, then θd
/// f = entry · (1, 1.15, 1.66)/1500
/// ```
///
/// all little-endian. The table borrows the bytes and decodes what is asked for: the file may be
/// mapped into memory, and nothing is allocated. Bin i of θh ends at `((i + 1)/90)² π/2`; the others are
/// evenly spaced, φd up to π. Negative entries mark what was not measured (pairs with a direction below
/// the surface) and count as 0.
///
/// # Source
/// W. Matusik et al., "A Data-Driven Reflectance Model", SIGGRAPH 2003; layout of the reader that comes with
/// the database.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MerlTable<'a> {
    /// Behind the header.
    entries: &'a [u8],
}

impl<'a> MerlTable<'a> {
    /// Length of a file in bytes.
    pub const BYTES: usize = HEADER + 3 * ENTRIES * 8;

    /// Checks the bytes of a file.
    ///
    /// # Errors
    /// [`MerlError`] where the dimensions are not those of the database, the length is not
    /// [`BYTES`](Self::BYTES), or an entry is NaN or infinite.
    pub fn parse(file: &'a [u8]) -> Result<Self, MerlError> {
        let given = file.len();
        let wrong_length = MerlError::Length { given };
        let (header, entries) = file.split_at_checked(HEADER).ok_or(wrong_length)?;
        let dimension = |i: usize| {
            let bytes = header[4 * i..4 * i + 4].try_into().unwrap_or_default();
            i32::from_le_bytes(bytes)
        };
        let dimensions = [0, 1, 2].map(dimension);
        if SIZE.map(|n| n as i32) != dimensions {
            return Err(MerlError::Dimensions { given: dimensions });
        }
        if given != Self::BYTES {
            return Err(wrong_length);
        }
        let table = Self { entries };
        match (0..3 * ENTRIES).find(|&i| !table.entry(i).is_finite()) {
            Some(entry) => Err(MerlError::NotFinite { entry }),
            None => Ok(table),
        }
    }

    /// How many entries are negative.
    pub fn unmeasured(&self) -> usize {
        (0..3 * ENTRIES).filter(|&i| self.entry(i) < 0.0).count()
    }

    /// Value of a channel in sr⁻¹ at a bin within [`SIZE`]; not negative.
    #[inline]
    pub(super) fn value(&self, channel: usize, [h, d, phi]: [usize; 3]) -> f64 {
        let entry = self.entry(channel * ENTRIES + (h * SIZE[1] + d) * SIZE[2] + phi);
        if entry > 0.0 { entry * SCALE[channel] } else { 0.0 }
    }

    #[inline]
    fn entry(&self, i: usize) -> f64 {
        match self.entries.get(8 * i..).and_then(|rest| rest.first_chunk()) {
            Some(bytes) => f64::from_le_bytes(*bytes),
            None => 0.0,
        }
    }
}

/// Writes header and entries; `entry` is asked in the order of the file. Refuses a
/// `file` of another length.
pub(super) fn write(
    file: &mut [u8],
    mut entry: impl FnMut(usize, [usize; 3]) -> f64,
) -> Result<(), MerlError> {
    let given = file.len();
    if given != MerlTable::BYTES {
        return Err(MerlError::Length { given });
    }
    let (header, entries) = file.split_at_mut(HEADER);
    for (bytes, n) in header.chunks_exact_mut(4).zip(SIZE) {
        bytes.copy_from_slice(&(n as i32).to_le_bytes());
    }
    for (i, bytes) in entries.chunks_exact_mut(8).enumerate() {
        let bin = [i / (SIZE[1] * SIZE[2]) % SIZE[0], i / SIZE[2] % SIZE[1], i % SIZE[2]];
        bytes.copy_from_slice(&entry(i / ENTRIES, bin).to_le_bytes());
    }
    Ok(())
}

/// Why bytes are not a table of the MERL database.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MerlError {
    /// The first twelve bytes are not 90, 90, 180.
    Dimensions {
        /// What they are.
        given: [i32; 3],
    },
    /// Truncated, or followed by something.
    Length {
        /// Length in bytes.
        given: usize,
    },
    /// A NaN or an infinity.
    NotFinite {
        /// Index among all entries.
        entry: usize,
    },
}

impl fmt::Display for MerlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dimensions { given: [h, d, phi] } => {
                write!(
                    f,
                    "a MERL file begins with the dimensions 90 × 90 × 180, not {h} × {d} × {phi}"
                )
            }
            Self::Length { given } => {
                write!(f, "a MERL file has {} bytes, not {given}", MerlTable::BYTES)
            }
            Self::NotFinite { entry } => {
                write!(f, "entry {entry} of the MERL file is not a finite number")
            }
        }
    }
}

impl Error for MerlError {}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
    use alloc::{vec, vec::Vec};

    fn file() -> Vec<u8> {
        let mut file = vec![0; MerlTable::BYTES];
        write(&mut file, |channel, [h, d, phi]| (channel * 1000 + h * 100 + d * 10 + phi) as f64)
            .unwrap();
        file
    }

    #[test]
    fn entries_are_where_the_layout_says() {
        let file = file();
        let table = MerlTable::parse(&file).unwrap();
        assert_eq!(table.value(2, [3, 4, 5]), 2345.0 * SCALE[2]);
        // Red of the bin after the first ring of θd begins at 12 + 8 · 180.
        assert_eq!(file[12 + 8 * 180..][..8], 10.0_f64.to_le_bytes());
    }

    #[test]
    fn broken_files_are_refused_with_their_reason() {
        let mut broken = file();
        for length in [0, 11, 12, 1000, MerlTable::BYTES - 1] {
            assert_eq!(
                MerlTable::parse(&broken[..length]),
                Err(MerlError::Length { given: length })
            );
        }
        broken[12 + 8 * 7..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        assert_eq!(MerlTable::parse(&broken), Err(MerlError::NotFinite { entry: 7 }));
        broken[..4].copy_from_slice(&(-90_i32).to_le_bytes());
        let error = MerlTable::parse(&broken).unwrap_err();
        assert_eq!(error, MerlError::Dimensions { given: [-90, 90, 180] });
        assert!(error.to_string().contains("not -90 × 90 × 180"));
        broken.push(0);
        assert!(MerlTable::parse(&broken).is_err());
    }

    #[test]
    fn negative_entries_are_black_and_counted() {
        let mut file = file();
        file[12 + 8 * 9..][..8].copy_from_slice(&(-1.0_f64).to_le_bytes());
        let table = MerlTable::parse(&file).unwrap();
        assert_eq!((table.value(0, [0, 0, 9]), table.unmeasured()), (0.0, 1));
    }
}
