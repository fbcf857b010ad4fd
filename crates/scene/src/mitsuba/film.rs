//! Films and reconstruction filters.

use alloc::format;

use super::reader::PluginReader;
use super::{Context, Family};
use crate::film::{Crop, Film, ReconstructionFilter};
use crate::xml::Kind;
use crate::{Location, SceneError};

/// The films there are. How the picture is stored is chosen by whoever writes it.
const FILMS: &Family<Film> = &[("hdrfilm", film), ("ldrfilm", film)];

const FILTERS: &Family<ReconstructionFilter> = &[
    ("box", box_filter),
    ("catmullrom", catmull_rom),
    ("gaussian", gaussian),
    ("lanczos", lanczos),
    ("mitchell", mitchell),
    ("tent", tent),
];

/// Pixels beyond which a film is refused: 3 GiB of sums.
const MOST_PIXELS: u64 = 1 << 28;

/// Mitsuba's size of a picture.
pub(super) const DEFAULT_SIZE: [u32; 2] = [768, 576];

/// The film of a sensor: the one inside its plugin, or the default.
pub(super) fn of<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Film, SceneError> {
    match reader.child(Kind::Film, context)? {
        Some(child) => context.translate(FILMS, context.description.node(child.node)),
        None => overridden(Film::new(DEFAULT_SIZE), context, |name| reader.location(name)),
    }
}

/// `width` (768), `height` (576), `crop_width`, `crop_height`, `crop_offset_x`, `crop_offset_y`,
/// `sample_border` (`high_quality_edges` in version 0.6; false), and a filter.
fn film<'a>(reader: &mut PluginReader<'a>, context: &mut Context<'a>) -> Result<Film, SceneError> {
    let [width, height] = DEFAULT_SIZE;
    let size = [pixels(reader, "width", width)?, pixels(reader, "height", height)?];
    for (name, n) in ["width", "height"].into_iter().zip(size) {
        if n == 0 {
            return Err(reader.error(name, format!("the film has no pixels: its {name} is 0")));
        }
    }
    let offset = [pixels(reader, "crop_offset_x", 0)?, pixels(reader, "crop_offset_y", 0)?];
    let rest = [0, 1].map(|axis| size[axis].saturating_sub(offset[axis]));
    let crop = [pixels(reader, "crop_width", rest[0])?, pixels(reader, "crop_height", rest[1])?];
    let filter = match reader.child(Kind::ReconstructionFilter, context)? {
        Some(child) => context.translate(FILTERS, context.description.node(child.node))?,
        None => ReconstructionFilter::default(),
    };
    let high_quality = reader.boolean("high_quality_edges", false)?;
    let sample_border = reader.boolean("sample_border", high_quality)?;
    reader.ignore(&[
        "file_format",
        "pixel_format",
        "component_format",
        "channel_names",
        "attach_log",
        "banner",
        "compensate",
        "exposure",
        "gamma",
        "key",
        "burn",
        "tonemap_method",
    ]);
    let crop = Crop { offset, size: crop };
    let film = Film { size, crop, filter, sample_border };
    overridden(film, context, |name| reader.location(name))
}

/// The film in the size and with the crop the caller asks for, checked. `location` tells where the
/// file states a parameter of the film.
///
/// # Errors
/// More pixels than [`MOST_PIXELS`], a crop that is empty or exceeds the film.
pub(super) fn overridden(
    mut film: Film,
    context: &Context<'_>,
    location: impl Fn(&str) -> Location,
) -> Result<Film, SceneError> {
    let options = context.options;
    if let Some(size) = options.film_size {
        film.size = size;
        film.crop = Crop { offset: [0, 0], size };
    }
    if let Some(crop) = options.crop {
        film.crop = crop;
    }
    let [width, height] = film.size.map(u64::from);
    if width * height > MOST_PIXELS {
        let message = format!("a film of {width} × {height} pixels is too large");
        return Err(SceneError::resource(location("width"), message)
            .help(format!("at most {MOST_PIXELS} pixels are possible")));
    }
    if film.contains_crop() {
        return Ok(film);
    }
    let [x, y] = film.crop.offset;
    let [w, h] = film.crop.size;
    let message = format!(
        "the crop of {w} × {h} pixels at ({x}, {y}) is empty or exceeds the film of \
         {width} × {height} pixels"
    );
    Err(if options.film_size.is_some() || options.crop.is_some() {
        SceneError::options(message)
    } else {
        SceneError::scene(location("crop_width"), message)
    })
}

fn pixels(
    reader: &mut PluginReader<'_>,
    name: &'static str,
    default: u32,
) -> Result<u32, SceneError> {
    match reader.integer(name)? {
        None => Ok(default),
        Some(n) => u32::try_from(n)
            .map_err(|_| reader.error(name, format!("“{name}” cannot be {n} pixels"))),
    }
}

/// A positive parameter of a filter.
fn width(
    reader: &mut PluginReader<'_>,
    name: &'static str,
    default: f64,
) -> Result<f32, SceneError> {
    // Wider filters than this would average a picture away, and cost time without end.
    let valid = |x: f64| x > 0.0 && x <= 64.0;
    reader.float_in(name, default, "between 0 and 64 pixels", valid).map(|x| x as f32)
}

fn box_filter<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    Ok(ReconstructionFilter::Box { radius: width(reader, "radius", 0.5)? })
}

fn tent<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    Ok(ReconstructionFilter::Tent { radius: width(reader, "radius", 1.0)? })
}

fn gaussian<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    Ok(ReconstructionFilter::Gaussian { stddev: width(reader, "stddev", 0.5)? })
}

/// `B` (⅓), `C` (⅓). Mitsuba 3's documentation calls them `A` and `B`; its code does not.
fn mitchell<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    // Both lie in [0, 1] in the paper; larger ones are sharper still, but sums of samples are to stay in range.
    let valid = |x: f64| x.abs() <= 10.0;
    let mut parameter =
        |name| reader.float_in(name, 1.0 / 3.0, "between -10 and 10", valid).map(|x| x as f32);
    let (b, c) = (parameter("B")?, parameter("C")?);
    Ok(ReconstructionFilter::Mitchell { b, c })
}

#[allow(clippy::unnecessary_wraps, reason = "one signature for every filter of the table")]
fn catmull_rom<'a>(
    _: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    Ok(ReconstructionFilter::CatmullRom)
}

fn lanczos<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<ReconstructionFilter, SceneError> {
    let lobes = reader.integer("lobes")?.unwrap_or(3);
    match u32::try_from(lobes) {
        Ok(lobes @ 1..=64) => Ok(ReconstructionFilter::Lanczos { lobes }),
        _ => Err(reader.error("lobes", format!("“lobes” must be from 1 to 64, not {lobes}"))),
    }
}
