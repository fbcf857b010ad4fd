//! Changes of files at random: those that coverage-guided fuzzers make, but addressed, so that a number is enough to make one again.

use flate2::Crc;

/// Random numbers of an address.
pub(crate) struct Random(u64);

impl Random {
    /// Those of one mutation of a kind of file.
    pub(crate) fn of(kind: &str, index: u64) -> Self {
        let next = |seed: u64, byte| seed.wrapping_mul(257).wrapping_add(u64::from(byte));
        let seed = kind.bytes().fold(index, next);
        Self(seed)
    }

    /// The next number, below a bound that is positive. The bias towards small numbers is of no matter here.
    ///
    /// # Source
    /// SplitMix64.
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % bound as u64) as usize
    }
}

/// What numbers in text are replaced by.
const WORDS: [&str; 24] = [
    "",
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "255",
    "256",
    "65536",
    "2147483647",
    "2147483648",
    "-2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "1e30",
    "-1e30",
    "1e-45",
    "3.4e38",
    "1e309",
    "nan",
    "inf",
    "x",
];

/// What numbers in binary files are replaced by.
const NUMBERS: [u64; 20] = [
    0,
    1,
    2,
    3,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0x8000,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    // NaN, infinity, the largest and the smallest number in single precision.
    0x7fc0_0000,
    0x7f80_0000,
    0x7f7f_ffff,
    1 << 32,
    1 << 61,
    i64::MAX as u64,
    u64::MAX,
];

/// A file after one to four changes; `other` is one of the same kind.
pub(crate) fn mutated(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut file = bytes.to_vec();
    for _ in 0..=random.below(4) {
        change(&mut file, other, random);
    }
    if file.starts_with(b"\x89PNG") && random.below(4) > 0 {
        mend_checksums(&mut file);
    }
    file
}

fn change(file: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    if file.is_empty() {
        file.extend(other);
        return;
    }
    let at = random.below(file.len());
    // A stretch that begins there, mostly a short one.
    let longest = (file.len() - at).min([4, 16, 64, usize::MAX][random.below(4)]);
    let end = at + 1 + random.below(longest);
    match random.below(10) {
        0 => file[at] ^= 1 << random.below(8),
        1 => file[at] = random.below(256) as u8,
        2 | 3 => {
            let number = NUMBERS[random.below(NUMBERS.len())];
            let width = [1, 2, 4, 8][random.below(4)].min(file.len() - at);
            let ends =
                if random.below(2) == 0 { number.to_le_bytes() } else { number.to_be_bytes() };
            let from = if ends == number.to_le_bytes() { 0 } else { 8 - width };
            file[at..at + width].copy_from_slice(&ends[from..from + width]);
        }
        4 | 5 => {
            // The number of a text that begins there or later.
            let is_digit = |byte: &u8| byte.is_ascii_digit() || b".-+e".contains(byte);
            let begin = file[at..].iter().position(is_digit).map_or(at, |offset| at + offset);
            let end =
                file[begin..].iter().position(|b| !is_digit(b)).map_or(file.len(), |n| begin + n);
            let word = WORDS[random.below(WORDS.len())];
            file.splice(begin..end, word.bytes());
        }
        6 => drop(file.drain(at..end)),
        7 => {
            let copy = file[at..end].to_vec();
            let to = random.below(file.len() + 1);
            file.splice(to..to, copy);
        }
        8 => {
            let from = random.below(other.len().max(1)).min(other.len());
            let part = &other[from..other.len().min(from + (end - at))];
            file.splice(at..end, part.iter().copied());
        }
        _ => file.truncate(at),
    }
}

/// Gives the chunks of a PNG file the checksums of what they hold, without which nothing would look at it.
fn mend_checksums(file: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = file.get(at..).and_then(<[u8]>::first_chunk::<4>) {
        let end = at + 8 + u32::from_be_bytes(*length) as usize;
        if file.len() < end + 4 {
            break;
        }
        let mut crc = Crc::new();
        crc.update(&file[at + 4..end]);
        file[end..end + 4].copy_from_slice(&crc.sum().to_be_bytes());
        at = end + 4;
    }
}
