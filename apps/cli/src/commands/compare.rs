//! `etendue compare`: how far apart two pictures are.

use std::path::{Path, PathBuf};

use etendue_renderer::Image;
use etendue_renderer::image_metrics::{self, Comparison, SizeMismatch, flip};
use etendue_scene::Color;
use etendue_scene::load::{self, load_image};
use serde_json::json;

use crate::failure::{Exit, Failure};
use crate::output::{Encoding, Metadata, Output, Precision};

/// Prints MSE, relMSE, PSNR and the mean difference of two pictures.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The picture in question.
    image: PathBuf,
    /// The picture it is compared with.
    reference: PathBuf,
    /// Write a false-colour picture of the differences: red where the picture is brighter than the
    /// reference, blue where it is darker.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print ꟻLIP too, which takes ten seconds per million pixels: the difference, from 0 to 1, that an observer sees who flips
    /// between the two; the largest over exposures if one of them holds radiance (EXR, HDR, PFM).
    #[arg(long)]
    flip: bool,
    /// Print one line of JSON.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let output = arguments.output.as_deref().map(Output::check).transpose()?;
    let image = read(&arguments.image)?;
    let reference = read(&arguments.reference)?;
    let mismatch = |error| {
        let (a, b) = (arguments.image.display(), arguments.reference.display());
        Failure::usage(format!("{a} and {b}: {error}"))
    };
    let comparison = image_metrics::compare(&image, &reference).map_err(mismatch)?;
    let flip = arguments.flip.then(|| arguments.flip_of(&image, &reference)).transpose();
    let flip = flip.map_err(mismatch)?;
    if arguments.json {
        println!("{}", as_json(&comparison, flip));
    } else {
        print(&comparison, flip);
    }
    if let Some(output) = output {
        let picture = image_metrics::difference_picture(&image, &reference).map_err(mismatch)?;
        let encoding = Encoding { precision: Precision::Float, exposure: 0.0 };
        output.write(&picture, &[], encoding, &Metadata::default())?;
    }
    Ok(Exit::Done)
}

fn print(comparison: &Comparison, flip: Option<f64>) {
    println!("MSE              {:.6e}", comparison.mse);
    println!("relMSE           {:.6e}", comparison.relative_mse);
    println!("PSNR             {:.2} dB", comparison.psnr);
    println!("mean difference  {:+.4} %", 100.0 * comparison.mean_difference);
    println!("max difference   {:.6e}", comparison.max_difference);
    if let Some(flip) = flip {
        println!("ꟻLIP             {flip:.6}");
    }
    if comparison.non_finite_pixels > 0 {
        println!(
            "non-finite       {} pixels, left out of the figures",
            comparison.non_finite_pixels
        );
    }
}

impl Arguments {
    fn flip_of(&self, image: &Image, reference: &Image) -> Result<f64, SizeMismatch> {
        let radiance = holds_radiance(&self.image) || holds_radiance(&self.reference);
        let differences = if radiance { flip::hdr } else { flip::ldr };
        Ok(flip::mean(&differences(image, reference)?))
    }
}

/// Whether a file holds radiance and not what a screen shows, as its extension tells.
fn holds_radiance(path: &Path) -> bool {
    path.extension()
        .is_some_and(|e| ["exr", "hdr", "pfm"].iter().any(|r| e.eq_ignore_ascii_case(r)))
}

/// JSON has no infinity: the PSNR of equal pictures is null, as is a ꟻLIP that nobody asked for.
fn as_json(comparison: &Comparison, flip: Option<f64>) -> serde_json::Value {
    json!({
        "mse": comparison.mse,
        "rel_mse": comparison.relative_mse,
        "psnr": comparison.psnr.is_finite().then_some(comparison.psnr),
        "mean_difference": comparison.mean_difference,
        "max_difference": comparison.max_difference,
        "flip": flip,
        "non_finite_pixels": comparison.non_finite_pixels,
    })
}

/// Reads a picture as linear RGB: grey is spread over the channels, alpha dropped.
pub(crate) fn read(path: &Path) -> Result<Image, Failure> {
    let loaded = load_image(path, load::Encoding::Srgb)?;
    let pixels = loaded.data().chunks_exact(loaded.channels()).map(|pixel| match *pixel {
        [r, g, b, ..] => Color::new(r, g, b),
        [grey, ..] => Color::new(grey, grey, grey),
        [] => Color::default(),
    });
    let size = [loaded.width() as u32, loaded.height() as u32];
    Image::from_pixels(size, pixels.collect())
        .ok_or_else(|| Failure::new(Exit::Scene, format!("{}: not a picture", path.display())))
}
