//! Numbers to bytes and back, for renders that are stored. Little-endian; nothing is read that is not there.

use core::fmt;

use etendue_scene::film::Crop;

/// Bytes that are no stored render: cut short, or with values that no render has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateError {
    what: &'static str,
}

impl StateError {
    pub(crate) fn new(what: &'static str) -> Self {
        Self { what }
    }
}

impl fmt::Display for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not a stored render: {}", self.what)
    }
}

impl core::error::Error for StateError {}

/// What is left to read.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'b> {
    rest: &'b [u8],
}

impl<'b> Reader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self { rest: bytes }
    }

    pub(crate) fn bytes(&mut self, count: usize) -> Result<&'b [u8], StateError> {
        let (taken, rest) =
            self.rest.split_at_checked(count).ok_or(StateError::new("it is cut short"))?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], StateError> {
        let mut array = [0; N];
        array.copy_from_slice(self.bytes(N)?);
        Ok(array)
    }

    pub(crate) fn u8(&mut self) -> Result<u8, StateError> {
        self.array().map(u8::from_le_bytes)
    }

    pub(crate) fn bool(&mut self) -> Result<bool, StateError> {
        match self.u8()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(StateError::new("a choice is neither yes nor no")),
        }
    }

    pub(crate) fn u32(&mut self) -> Result<u32, StateError> {
        self.array().map(u32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self) -> Result<f32, StateError> {
        self.u32().map(f32::from_bits)
    }

    pub(crate) fn u64(&mut self) -> Result<u64, StateError> {
        self.array().map(u64::from_le_bytes)
    }

    /// Reads what [`Write::crop`] has written.
    ///
    /// # Errors
    /// It reaches beyond the largest film.
    pub(crate) fn crop(&mut self) -> Result<Crop, StateError> {
        let [mut offset, mut size] = [[0; 2]; 2];
        for number in [&mut offset, &mut size].into_iter().flatten() {
            *number = self.u32()?;
        }
        if (0..2).any(|axis| offset[axis].checked_add(size[axis]).is_none()) {
            return Err(StateError::new("its part of the film cannot be"));
        }
        Ok(Crop { offset, size })
    }

    /// That there may be so many pieces of at least so many bytes each.
    pub(crate) fn has(&self, pieces: u64, bytes_of_each: u64) -> Result<(), StateError> {
        if pieces.saturating_mul(bytes_of_each) > self.rest.len() as u64 {
            return Err(StateError::new("it is cut short"));
        }
        Ok(())
    }

    /// That nothing is left.
    pub(crate) fn end(&self) -> Result<(), StateError> {
        if self.rest.is_empty() { Ok(()) } else { Err(StateError::new("bytes are left over")) }
    }
}

/// Adds numbers to bytes.
pub(crate) trait Write {
    fn u8(&mut self, x: u8);
    fn u32(&mut self, x: u32);
    fn u64(&mut self, x: u64);

    fn f32(&mut self, x: f32) {
        self.u32(x.to_bits());
    }

    fn crop(&mut self, crop: &Crop) {
        for &number in [crop.offset, crop.size].as_flattened() {
            self.u32(number);
        }
    }
}

impl Write for Vec<u8> {
    fn u8(&mut self, x: u8) {
        self.push(x);
    }

    fn u32(&mut self, x: u32) {
        self.extend_from_slice(&x.to_le_bytes());
    }

    fn u64(&mut self, x: u64) {
        self.extend_from_slice(&x.to_le_bytes());
    }
}
