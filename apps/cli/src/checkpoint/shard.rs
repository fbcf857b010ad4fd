//! A part of the samples of a render.

use core::fmt;
use core::ops::Range;

use serde::{Deserialize, Serialize};

/// The `index`-th of `count` equal parts, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Shard {
    pub(crate) index: u32,
    pub(crate) count: u32,
}

impl Shard {
    /// `I/N`.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            Some(Self { index: index.parse().ok()?, count: count.parse().ok()? })
        });
        match numbers {
            Some(shard) if shard.exists() => Ok(shard),
            _ => Err("expected I/N with I from 1 to N, as in 2/8".to_owned()),
        }
    }

    /// Whether there is such a part.
    pub(crate) fn exists(self) -> bool {
        (1..=self.count).contains(&self.index)
    }

    /// The samples of the part, one that [exists](Self::exists): neighbouring ranges of the one sequence, whose lengths differ by one at most.
    pub(crate) fn samples(self, samples_per_pixel: u32) -> Range<u32> {
        let begin = |index: u32| {
            (u64::from(index) * u64::from(samples_per_pixel) / u64::from(self.count)) as u32
        };
        begin(self.index - 1)..begin(self.index)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_neighbours_and_cover_everything_once() {
        for count in [1, 2, 3, 7, 64] {
            for samples in [1, 6, 64, u32::MAX] {
                let mut end = 0;
                for index in 1..=count {
                    let range = Shard { index, count }.samples(samples);
                    assert_eq!(range.start, end);
                    assert!(range.end - range.start <= samples.div_ceil(count));
                    end = range.end;
                }
                assert_eq!(end, samples);
            }
        }
    }

    #[test]
    fn numbers_that_are_no_part_are_refused() {
        assert_eq!(Shard::parse("3/8"), Ok(Shard { index: 3, count: 8 }));
        for text in ["0/8", "9/8", "1", "1/0", "-1/2", "a/b", "1/2/3"] {
            assert!(Shard::parse(text).is_err(), "{text}");
        }
    }
}
