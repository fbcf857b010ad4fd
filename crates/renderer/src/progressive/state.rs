//! What a progressive render knows.

use alloc::sync::Arc;

use etendue_scene::film::Crop;

use super::convergence::Round;
use super::goal::Allocation;
use super::half::Half;
use super::halves::{halves, mean, variance};
use super::image_error::ImageError;
use super::rounds::ProgressiveRendering;
use super::schedule::{HIGHEST, Stage};
use crate::canvas::{Canvas, CanvasPixel as _};
use crate::codec::{Reader, StateError, Write as _};

/// A progressive render under way: the halves of all pixels, and how far the present round is.
///
/// To clone it is cheap: the tiles are shared. A render that is stopped, stored and [continued](crate::Renderer::continue_progressively) with
/// the same goal or a smaller error has the bits of one that is not. With more samples per pixel it has them if the last round was not one
/// that the old limit had cut short; otherwise some samples lie in other pixels, and the picture is as good.
///
/// # Examples
/// ```
/// use etendue_renderer::progressive::{Allocation, ProgressiveState};
/// use etendue_scene::film::Crop;
///
/// let crop = Crop { offset: [0, 0], size: [20, 10] };
/// let nothing = ProgressiveState::new(crop, Allocation::Adaptive);
/// let mut bytes = Vec::new();
/// nothing.encode(&mut bytes);
/// assert_eq!(ProgressiveState::decode(&bytes)?, nothing);
/// assert_eq!(nothing.rendering().error, None);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ProgressiveState {
    pub(super) allocation: Allocation,
    pub(super) canvas: Canvas<[Half; 2]>,
    /// Level that each half of each pixel has or is being brought to.
    pub(super) levels: Arc<[Vec<u8>; 2]>,
    /// How many rounds have begun, and the last of them.
    pub(super) begun: u32,
    pub(super) last: Option<Stage>,
    /// Whether that one is finished.
    pub(super) is_finished: bool,
    pub(super) finished: Vec<Round>,
}

/// Bytes of a stored pixel: two levels and two halves.
const PIXEL: u64 = 2 + <[Half; 2]>::BYTES;

impl ProgressiveState {
    /// No samples yet.
    pub fn new(crop: Crop, allocation: Allocation) -> Self {
        let pixels = crop.size.map(|n| n as usize).iter().product();
        Self {
            allocation,
            canvas: Canvas::new(crop),
            levels: Arc::new([vec![0; pixels], vec![0; pixels]]),
            begun: 0,
            last: None,
            is_finished: false,
            finished: Vec::new(),
        }
    }

    /// The part of the film.
    pub fn crop(&self) -> Crop {
        self.canvas.crop()
    }

    /// Where samples go.
    pub fn allocation(&self) -> Allocation {
        self.allocation
    }

    /// The picture as it is now.
    pub fn rendering(&self) -> ProgressiveRendering {
        let halves = halves(&self.canvas);
        ProgressiveRendering {
            image: mean(&halves),
            variance: variance(&halves),
            samples: self.canvas.map(|halves| halves.iter().map(Half::drawn).sum()),
            error: self.error(),
            rounds: self.finished.clone(),
            statistics: self.canvas.statistics(),
        }
    }

    /// The error of the picture; `None` where some pixel has less than a sample in either half.
    pub(super) fn error(&self) -> Option<ImageError> {
        let whole = self.canvas.map(|halves| halves.iter().all(|half| half.drawn() > 0));
        let [a, b] = halves(&self.canvas);
        whole.into_iter().all(|whole| whole).then(|| ImageError::between(&a, &b))
    }

    /// Samples per pixel, in the mean over the picture.
    pub(super) fn samples_per_pixel(&self) -> f64 {
        self.canvas.statistics().samples as f64 / self.levels[0].len() as f64
    }

    /// Adds the bytes that [`decode`](Self::decode) reads. They carry no checksum and no version; whoever stores them adds both.
    pub fn encode(&self, bytes: &mut Vec<u8>) {
        bytes.crop(&self.canvas.crop());
        bytes.u8(u8::from(self.allocation == Allocation::Uniform));
        bytes.u32(self.begun);
        bytes.u8(u8::from(self.is_finished));
        bytes.u8(u8::from(self.last.is_some()));
        if let Some(stage) = self.last {
            stage.write(bytes);
        }
        bytes.u32(self.finished.len() as u32);
        for Round { samples_per_pixel, error } in &self.finished {
            let ImageError { estimate, lower, upper, degrees_of_freedom } = error;
            for number in [samples_per_pixel, estimate, lower, upper, degrees_of_freedom] {
                bytes.u64(number.to_bits());
            }
        }
        for levels in self.levels.iter() {
            bytes.extend_from_slice(levels);
        }
        self.canvas.write(bytes);
    }

    /// Reads what [`encode`](Self::encode) has written.
    ///
    /// # Errors
    /// Any other bytes that do not happen to be a render. Memory is in proportion to their number, whatever they declare.
    pub fn decode(bytes: &[u8]) -> Result<Self, StateError> {
        let mut reader = Reader::new(bytes);
        let crop = reader.crop()?;
        let pixels: u64 = crop.size.map(u64::from).iter().product();
        reader.has(pixels, PIXEL)?;
        let allocation = if reader.bool()? { Allocation::Uniform } else { Allocation::Adaptive };
        let begun = reader.u32()?;
        let is_finished = reader.bool()?;
        let last = if reader.bool()? { Some(Stage::read(&mut reader)?) } else { None };
        let rounds = reader.u32()?;
        if last.is_some() != (begun > 0) || rounds > begun || (is_finished && rounds == 0) {
            return Err(StateError::new("its rounds cannot be"));
        }
        let mut finished = Vec::new();
        for _ in 0..rounds {
            let mut next = || reader.u64().map(f64::from_bits);
            let samples_per_pixel = next()?;
            let (estimate, lower, upper, degrees_of_freedom) = (next()?, next()?, next()?, next()?);
            let error = ImageError { estimate, lower, upper, degrees_of_freedom };
            finished.push(Round { samples_per_pixel, error });
        }
        let mut levels = || -> Result<Vec<u8>, StateError> {
            let levels = reader.bytes(pixels as usize)?;
            if levels.iter().any(|&level| u32::from(level) > HIGHEST) {
                return Err(StateError::new("a pixel has more samples than there are"));
            }
            Ok(levels.to_vec())
        };
        let levels = Arc::new([levels()?, levels()?]);
        let canvas = Canvas::read(crop, &mut reader)?;
        reader.end()?;
        Ok(Self { allocation, canvas, levels, begun, last, is_finished, finished })
    }
}
