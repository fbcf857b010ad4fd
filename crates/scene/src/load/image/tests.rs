use super::*;
use crate::ErrorKind;
use alloc::string::ToString;
use alloc::vec;
use std::io::Cursor;

use super::super::srgb;
use ::exr::image::Encoding as Storage;
use ::exr::prelude::{
    AnyChannel, AnyChannels, Compression, FlatSamples, Layer, LayerAttributes, Vec2,
    WritableImage as _, f16,
};
use ::image::{DynamicImage, ImageFormat};

fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).expect("memory");
    bytes.into_inner()
}

fn parse(bytes: &[u8], encoding: Encoding) -> Result<Image, SceneError> {
    parse_image(bytes, Path::new("a.tga"), encoding)
}

/// An EXR file of one layer whose channels hold their own number, in half, float or integer.
fn exr(channels: &[(&str, FlatSamples)], compression: Compression) -> Vec<u8> {
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone()));
    let encoding = Storage { compression, ..Storage::SMALL_FAST_LOSSLESS };
    let layer = Layer::new(
        (2, 2),
        LayerAttributes::named("first").with_position(Vec2(-3, 7)),
        encoding,
        AnyChannels::sort(list.collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    ::exr::image::Image::from_layer(layer).write().to_buffered(&mut bytes).expect("memory");
    bytes.into_inner()
}

fn floats(x: f32) -> FlatSamples {
    FlatSamples::F32(vec![x, 10.0 * x, 100.0 * x, 1000.0 * x])
}

#[test]
fn integer_formats_are_decoded_from_srgb_unless_raw() {
    let rgba8 = ::image::RgbaImage::from_raw(1, 2, vec![0, 51, 255, 51, 1, 2, 3, 4]);
    let rgb8 = ::image::RgbImage::from_raw(1, 2, vec![0, 51, 255, 1, 2, 3]);
    let grey16 = ::image::ImageBuffer::from_raw(2, 1, vec![0x3333u16, 0xffff]);
    let grey_alpha = ::image::GrayAlphaImage::from_raw(1, 1, vec![51, 51]);
    let fifth = srgb::decode(0.2f32);
    let cases: [(DynamicImage, &[ImageFormat], usize, [f32; 2]); 4] = [
        (
            rgba8.expect("sized").into(),
            &[ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tga],
            1,
            [fifth, 1.0],
        ),
        (
            rgb8.expect("sized").into(),
            &[ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tga],
            1,
            [fifth, 1.0],
        ),
        (DynamicImage::ImageLuma16(grey16.expect("sized")), &[ImageFormat::Png], 0, [fifth, 1.0]),
        (grey_alpha.expect("sized").into(), &[ImageFormat::Png], 0, [fifth, 0.2]),
    ];
    for (picture, formats, start, expected) in cases {
        for &format in formats {
            let bytes = encode(&picture, format);
            let image = parse(&bytes, Encoding::Srgb).expect("a valid file");
            assert_eq!(image.channels(), usize::from(picture.color().channel_count()));
            assert_eq!(image.data()[start..start + 2], expected, "{format:?}");
            assert!(image.srgb_decoded());
            let raw = parse(&bytes, Encoding::Raw).expect("a valid file");
            assert_eq!(raw.data()[start], 0.2, "{format:?}");
            assert!(!raw.srgb_decoded());
        }
    }
}

#[test]
fn alpha_is_linear_in_both_encodings() {
    let picture = ::image::RgbaImage::from_raw(1, 1, vec![255, 255, 255, 51]).expect("sized");
    let bytes = encode(&picture.into(), ImageFormat::Png);
    for encoding in [Encoding::Srgb, Encoding::Raw] {
        assert_eq!(parse(&bytes, encoding).expect("valid").data(), [1.0, 1.0, 1.0, 0.2]);
    }
}

#[test]
fn jpeg_is_close_and_hdr_is_linear() {
    let picture = DynamicImage::from(::image::RgbImage::from_pixel(8, 8, ::image::Rgb([128; 3])));
    let image = parse(&encode(&picture, ImageFormat::Jpeg), Encoding::Raw).expect("valid");
    // A flat block: only the rounding of its mean, at quality 75, is lost.
    assert!(image.data().iter().all(|x| (x - 128.0 / 255.0).abs() < 0.01));
    let picture = ::image::Rgb32FImage::from_pixel(9, 2, ::image::Rgb([0.5, 2.0, 1024.0]));
    let image = parse(&encode(&picture.into(), ImageFormat::Hdr), Encoding::Srgb).expect("valid");
    // Red is below the shared exponent's step of 1024 / 128; the others are powers of two.
    assert_eq!(image.data()[2], 1024.0);
    assert!((image.data()[0] - 0.5).abs() <= 4.0 && !image.srgb_decoded());
}

#[test]
fn exr_channels_of_every_type_and_compression_are_read_in_their_data_window() {
    let half = |x: f32| FlatSamples::F16(vec![f16::from_f32(x); 4]);
    let channels = [
        ("R", floats(1.0)),
        ("G", half(0.5)),
        ("B", FlatSamples::U32(vec![7; 4])),
        ("Z", floats(9.0)),
    ];
    for compression in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
    ] {
        let image = parse(&exr(&channels, compression), Encoding::Srgb).expect("a valid file");
        assert_eq!((image.width(), image.height(), image.channels()), (2, 2, 3));
        assert_eq!(image.data()[3..6], [10.0, 0.5, 7.0], "{compression:?}");
        assert_eq!(image.data()[9], 1000.0, "{compression:?}");
        assert!(!image.srgb_decoded());
    }
}

#[test]
fn exr_without_colours_is_named() {
    let bytes = exr(&[("u", floats(1.0)), ("v", floats(2.0))], Compression::RLE);
    let error = parse(&bytes, Encoding::Srgb).expect_err("no colours").to_string();
    assert!(error.starts_with("a.tga: no colours among the channels u, v"), "{error}");
    let bytes = exr(&[("Y", floats(1.0)), ("A", floats(f32::NAN))], Compression::RLE);
    let image = parse(&bytes, Encoding::Srgb).expect("a valid file");
    assert_eq!((image.channels(), image.data()[2], image.non_finite()), (2, 10.0, 4));
}

#[test]
fn huge_dimensions_are_refused_before_memory_is_taken() {
    let mut png = encode(&DynamicImage::new_luma8(1, 1), ImageFormat::Png);
    png[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    let crc = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&crc.to_be_bytes());
    let bmp = {
        let mut bmp = encode(&DynamicImage::new_rgb8(1, 1), ImageFormat::Bmp);
        bmp[18..26].copy_from_slice(&[0xff, 0xff, 0, 0, 0xff, 0xff, 0, 0]);
        bmp
    };
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n".to_vec();
    for bytes in [png, bmp, hdr] {
        let error = parse(&bytes, Encoding::Srgb).expect_err("too large");
        assert_eq!(error.kind, ErrorKind::Resource, "{error}");
    }
}

/// The check sum of PNG chunks, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| (c >> 1) ^ (0xEDB8_8320 & (c & 1).wrapping_neg()))
    })
}

#[test]
fn unknown_content_is_refused() {
    let error = parse_image(b"GIF89a", Path::new("a.gif"), Encoding::Srgb).expect_err("no image");
    assert_eq!(error.kind, ErrorKind::Scene);
    let error = parse_image(b"hello", Path::new("a.txt"), Encoding::Srgb).expect_err("no image");
    assert!(error.message.starts_with("not an image of a known format"), "{error}");
    assert!(parse_image(b"", Path::new("a.tga"), Encoding::Srgb).is_err());
}

/// An EXR file with room for the counters of a DWA chunk, which a smaller one stores raw.
fn dwa() -> Vec<u8> {
    let ramp = FlatSamples::F16((0..256u16).map(|i| f16::from_f32(f32::from(i % 37))).collect());
    let channels = ["B", "G", "R"].into_iter().map(|name| AnyChannel::new(name, ramp.clone()));
    let encoding = Storage { compression: Compression::DWAA(None), ..Storage::SMALL_FAST_LOSSLESS };
    let attributes = LayerAttributes::default();
    let layer = Layer::new((16, 16), attributes, encoding, AnyChannels::sort(channels.collect()));
    let mut bytes = Cursor::new(Vec::new());
    ::exr::image::Image::from_layer(layer).write().to_buffered(&mut bytes).expect("memory");
    bytes.into_inner()
}

#[test]
fn dwa_chunks_that_declare_absurd_sizes_are_refused_before_memory_is_taken() {
    let good = dwa();
    assert_eq!(parse(&good, Encoding::Srgb).map(|i| (i.width(), i.channels())), Ok((16, 3)));
    let mut refused = 0;
    for at in 0..good.len() {
        let mut altered = good.clone();
        altered[at] ^= 0x40;
        let error = parse(&altered, Encoding::Srgb).err();
        refused += usize::from(error.is_some_and(|e| e.message.contains("a DWA chunk declares")));
    }
    // The upper bytes, from the fourth on, of each of the eleven counters.
    assert!(refused >= 11 * 5, "{refused}");
}

#[test]
fn truncated_and_altered_files_never_panic() {
    let picture =
        DynamicImage::from(::image::RgbImage::from_pixel(3, 2, ::image::Rgb([9, 99, 200])));
    let float = ::image::Rgb32FImage::from_pixel(9, 2, ::image::Rgb([0.5, 2.0, 8.0]));
    let channels = [("R", floats(1.0)), ("G", floats(2.0)), ("B", floats(3.0))];
    let mut files = vec![encode(&float.into(), ImageFormat::Hdr)];
    files.extend(
        [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tga].map(|f| encode(&picture, f)),
    );
    files.extend(
        [Compression::PIZ, Compression::ZIP16, Compression::PXR24].map(|c| exr(&channels, c)),
    );
    for bytes in files {
        for at in 0..bytes.len() {
            let _ = parse(&bytes[..at], Encoding::Srgb);
            let mut altered = bytes.clone();
            altered[at] ^= 0xff;
            let _ = parse(&altered, Encoding::Srgb);
        }
    }
}
