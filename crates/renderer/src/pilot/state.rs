//! What a render with reuse knows.

use etendue_scene::film::Crop;

use super::pixel::PilotPixel;
use crate::canvas::{Canvas, CanvasPixel as _};
use crate::codec::{Reader, StateError, Write as _};
use crate::film::Image;
use crate::render::{Progress, Rendering};
use crate::tile::Tile;

/// A render with reuse under way: sums and pilots of all pixels, after some tiles of the first pass, or after the first pass and some tiles
/// of the second.
///
/// To clone it is cheap: the tiles are shared. A render that is stopped, stored and [continued](crate::Renderer::continue_with_reuse) has the
/// bits of one that is not.
///
/// # Examples
/// ```
/// use etendue_renderer::ReuseState;
/// use etendue_scene::film::Crop;
///
/// let nothing = ReuseState::new(Crop { offset: [0, 0], size: [20, 10] });
/// let mut bytes = Vec::new();
/// nothing.encode(&mut bytes);
/// assert_eq!(ReuseState::decode(&bytes)?, nothing);
/// assert_eq!(nothing.rendering().statistics.samples, 0);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ReuseState {
    pub(super) canvas: Canvas<PilotPixel>,
    /// Tiles that have been finished, of both passes.
    pub(super) finished: usize,
}

impl ReuseState {
    /// No samples yet.
    pub fn new(crop: Crop) -> Self {
        Self { canvas: Canvas::new(crop), finished: 0 }
    }

    /// The part of the film.
    pub fn crop(&self) -> Crop {
        self.canvas.crop()
    }

    /// How far it is.
    pub(super) fn progress(&self) -> Progress {
        Progress { finished: self.finished, total: tiles_of_both_passes(&self.crop()) }
    }

    /// The picture as it is now: of the first pass where the second has not been.
    pub fn rendering(&self) -> Rendering {
        let size = self.crop().size;
        let pixels = self.canvas.map(PilotPixel::mean);
        let image = Image::from_pixels(size, pixels).unwrap_or_else(|| Image::black(size));
        Rendering { image, statistics: self.canvas.statistics(), progress: self.progress() }
    }

    /// Adds the bytes that [`decode`](Self::decode) reads. They carry no checksum and no version; whoever stores them adds both.
    pub fn encode(&self, bytes: &mut Vec<u8>) {
        bytes.crop(&self.crop());
        bytes.u64(self.finished as u64);
        self.canvas.write(bytes);
    }

    /// Reads what [`encode`](Self::encode) has written.
    ///
    /// # Errors
    /// Any other bytes that do not happen to be a render. Memory is in proportion to their number, whatever they declare.
    pub fn decode(bytes: &[u8]) -> Result<Self, StateError> {
        let mut reader = Reader::new(bytes);
        let crop = reader.crop()?;
        let pixels = crop.size.map(u64::from).iter().product();
        reader.has(pixels, PilotPixel::BYTES)?;
        let finished = usize::try_from(reader.u64()?).unwrap_or(usize::MAX);
        if finished > tiles_of_both_passes(&crop) {
            return Err(StateError::new("more tiles are finished than there are"));
        }
        let canvas = Canvas::read(crop, &mut reader)?;
        reader.end()?;
        Ok(Self { canvas, finished })
    }
}

fn tiles_of_both_passes(crop: &Crop) -> usize {
    2 * Tile::count(crop) as usize
}
