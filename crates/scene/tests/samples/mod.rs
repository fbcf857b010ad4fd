//! A small valid file of every kind that the loaders read. Tests damage them, fuzz targets begin with them.

use std::io::{Cursor, Write as _};

use exr::image::Encoding;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, FlatSamples, Layer, LayerAttributes, WritableImage as _,
    f16,
};
use flate2::write::ZlibEncoder;
use image::{DynamicImage, ImageFormat};

/// Names, whose extensions tell the kinds, and contents. The scene refers to some of the other files.
pub(crate) fn samples() -> Vec<(String, Vec<u8>)> {
    let mut all = vec![
        ("scene.xml".into(), SCENE.into()),
        ("shapes.xml".into(), SHAPES.into()),
        ("old.xml".into(), OLD.into()),
        ("included.xml".into(), INCLUDED.into()),
        ("mesh.obj".into(), OBJ.into()),
        ("mesh.mtl".into(), MTL.into()),
        ("mesh.ply".into(), ply("ascii", |number| format!("{number}\n").into_bytes())),
        ("little.ply".into(), ply("binary_little_endian", Number::little)),
        (
            "big.ply".into(),
            ply("binary_big_endian", |number| {
                let mut bytes = number.little();
                bytes.reverse();
                bytes
            }),
        ),
        ("mesh.serialized".into(), serialized(4, flate2::Compression::default())),
        ("stored.serialized".into(), serialized(4, flate2::Compression::none())),
        ("old.serialized".into(), serialized(3, flate2::Compression::default())),
        ("two.curves".into(), CURVES.into()),
        ("light.spd".into(), SPECTRUM.into()),
        ("model.glb".into(), glb()),
        ("model.gltf".into(), gltf()),
        ("grey.vol".into(), volume(1)),
        ("rgb.vol".into(), volume(3)),
        ("grey.pfm".into(), floats(b"Pf 2 3 -1.0\n", &[0.5; 6])),
        ("rgb.pfm".into(), floats(b"PF\n3 1\n-0.5\n", &[2.0; 9])),
    ];
    let picture =
        image::RgbaImage::from_fn(5, 4, |x, y| image::Rgba([50 * x as u8, 60 * y as u8, 7, 200]));
    let picture = DynamicImage::from(picture);
    let pictures = [
        ("rgba.png", picture.clone(), ImageFormat::Png),
        ("rgb.png", picture.to_rgb8().into(), ImageFormat::Png),
        ("deep.png", picture.to_luma_alpha16().into(), ImageFormat::Png),
        ("rgb.jpg", picture.to_rgb8().into(), ImageFormat::Jpeg),
        ("grey.jpg", picture.to_luma8().into(), ImageFormat::Jpeg),
        ("rgb.bmp", picture.to_rgb8().into(), ImageFormat::Bmp),
        ("rgba.tga", picture.clone(), ImageFormat::Tga),
        ("rgb.hdr", picture.to_rgb32f().into(), ImageFormat::Hdr),
    ];
    for (name, picture, format) in pictures {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("memory");
        all.push((name.into(), bytes.into_inner()));
    }
    let compressions = [
        ("plain.exr", Compression::Uncompressed),
        ("rle.exr", Compression::RLE),
        ("zip.exr", Compression::ZIP16),
        ("piz.exr", Compression::PIZ),
        ("pxr24.exr", Compression::PXR24),
        ("b44.exr", Compression::B44),
    ];
    all.extend(compressions.map(|(name, compression)| (name.into(), exr(compression))));
    all
}

const SCENE: &str = r#"<scene version="3.0.0">
<default name="spp" value="4"/>
<path value="."/>
<integrator type="volpath"><integer name="max_depth" value="5"/></integrator>
<sensor type="thinlens">
<float name="fov" value="45"/><float name="aperture_radius" value="0.1"/>
<transform name="to_world"><lookat origin="0, 1, 5" target="0, 0, 0" up="0, 1, 0"/></transform>
<film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="6"/><rfilter type="gaussian"/></film>
<sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
</sensor>
<bsdf type="twosided" id="card"><bsdf type="diffuse">
<texture type="bitmap" name="reflectance"><string name="filename" value="rgba.png"/></texture>
</bsdf></bsdf>
<bsdf type="roughconductor" id="metal"><string name="material" value="Au"/><float name="alpha" value="0.2"/></bsdf>
<shape type="obj"><string name="filename" value="mesh.obj"/><ref id="card"/></shape>
<shape type="ply"><string name="filename" value="little.ply"/><ref id="metal"/></shape>
<shape type="serialized"><string name="filename" value="mesh.serialized"/><integer name="shape_index" value="1"/></shape>
<shape type="sphere"><float name="radius" value="0.5"/><bsdf type="null"/>
<medium name="interior" type="heterogeneous"><volume name="albedo" type="constvolume"><rgb name="value" value="0.9 0.8 0.7"/></volume>
<volume name="sigma_t" type="gridvolume"><string name="filename" value="grey.vol"/></volume><phase type="hg"><float name="g" value="0.3"/></phase></medium></shape>
<emitter type="envmap"><string name="filename" value="zip.exr"/></emitter>
<include filename="included.xml"/>
</scene>
"#;

const SHAPES: &str = r##"<scene version="3.0.0">
<shape type="shapegroup" id="group"><shape type="rectangle"><bsdf type="principled"><float name="metallic" value="0.5"/></bsdf></shape></shape>
<shape type="instance"><ref id="group"/><transform name="to_world"><rotate y="1" angle="30"/><scale value="2"/><translate x="1"/>
<matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform></shape>
<shape type="cylinder"><point name="p0" x="0" y="0" z="0"/><point name="p1" value="0, 0, 1"/><float name="radius" value="0.2"/>
<bsdf type="dielectric"><string name="int_ior" value="bk7"/></bsdf></shape>
<shape type="disk"><emitter type="area"><spectrum name="radiance" value="400:1, 700:2"/></emitter></shape>
<shape type="cube"><bsdf type="mask"><float name="opacity" value="0.5"/><bsdf type="plastic"/></bsdf></shape>
<emitter type="point"><rgb name="intensity" value="#ff8000"/></emitter>
<emitter type="spot"><boolean name="unused" value="false"/></emitter>
</scene>
"##;

const OLD: &str = r#"<scene version="0.6.0">
<integrator type="path"><integer name="maxDepth" value="3"/></integrator>
<sensor type="perspective"><float name="focusDistance" value="3"/><transform name="toWorld"><translate z="-4"/></transform></sensor>
<shape type="obj"><string name="filename" value="mesh.obj"/><bsdf type="diffuse"><srgb name="reflectance" value="0.5"/></bsdf></shape>
<alias id="x" as="y"/>
</scene>
"#;

const INCLUDED: &str = r#"<scene version="3.0.0"><emitter type="constant"><rgb name="radiance" value="0.1"/></emitter></scene>
"#;

const SPECTRUM: &str = "# nm, W/(m² sr nm)\n380 0.25\n500 1e0\n\n780.5 .5 # the end\n";

const CURVES: &str = "0 0 0 0.1\n1 0 0 0.1\n2 1 0 0.05\n3 1 -1e-1 0\n\n0 1 0 .2\r\n1 1 0 .2\n1 2 0 .2\n2 2 2 .2\n3 2 2 .2\n";

const OBJ: &str = "\u{feff}# two quads\r\nmtllib mesh.mtl\no first\nv 0 0 0\nv 1 \\\n0 0 .1 .2 .3\nv 1 1 -1e-2\nv 0 1 0\nvt 0 0\nvt 1.0\n\
vn 0 0 1\nusemtl wood\ns off\nf 1/1/1 2/2/1 3//1 4\ng second\nusemtl glass\nf -4 -3/-1 -1//-1\nl 1 2\nf 1 2\n";

const MTL: &str = "newmtl wood\nKa 0\nKd 0.5 0.4 0.3\nmap_Kd -s 1 1 1 -clamp on rgba.png\nNs 10\nillum 2\n\
newmtl glass\nKs 0.1\nKe 1 2 3\nNi 1.5\nTr 0.25\nd -halo 0.5\nPr .3\nPm 1\nfoo bar\nKd spectral a.rfl\n";

/// A number of a PLY file.
enum Number {
    Byte(u8),
    Short(i16),
    Int(i32),
    Float(f32),
    Double(f64),
}

impl Number {
    fn little(&self) -> Vec<u8> {
        match self {
            Self::Byte(n) => n.to_le_bytes().to_vec(),
            Self::Short(n) => n.to_le_bytes().to_vec(),
            Self::Int(n) => n.to_le_bytes().to_vec(),
            Self::Float(n) => n.to_le_bytes().to_vec(),
            Self::Double(n) => n.to_le_bytes().to_vec(),
        }
    }
}

impl core::fmt::Display for Number {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Byte(n) => n.fmt(f),
            Self::Short(n) => n.fmt(f),
            Self::Int(n) => n.fmt(f),
            Self::Float(n) => n.fmt(f),
            Self::Double(n) => n.fmt(f),
        }
    }
}

/// A quad and a triangle with normals, texture coordinates, colours, weights, and an element of another kind.
fn ply(format: &str, encode: impl Fn(&Number) -> Vec<u8>) -> Vec<u8> {
    use Number::{Byte, Double, Float, Int, Short};
    let mut file = format!(
        "ply\nformat {format} 1.0\ncomment by hand\nelement vertex 5\nproperty float x\nproperty double y\n\
         property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float u\n\
         property float v\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
         element edge 1\nproperty list ushort short ends\nelement face 2\n\
         property list uchar int vertex_indices\nproperty float w_0\nend_header\n"
    )
    .into_bytes();
    let mut numbers = Vec::new();
    for i in 0..5u8 {
        let x = f32::from(i);
        numbers.extend([Float(x), Double(f64::from(i * i)), Float(-0.5)]);
        numbers.extend([Float(0.0), Float(0.0), Float(1.0), Float(0.25 * x), Float(0.5)]);
        numbers.extend([Byte(i), Byte(100), Byte(200)]);
    }
    numbers.extend([Short(2), Short(-3), Short(4)]);
    numbers.extend([Byte(4), Int(0), Int(1), Int(2), Int(3), Float(0.5)]);
    numbers.extend([Byte(3), Int(4), Int(1), Int(0), Float(0.75)]);
    file.extend(numbers.iter().flat_map(encode));
    file
}

/// Two meshes of one triangle each: with normals, texture coordinates and colours in single precision, and bare in double.
fn serialized(version: u16, compression: flate2::Compression) -> Vec<u8> {
    let (mut file, mut offsets) = (Vec::new(), Vec::new());
    for flags in [0x1_u32 | 0x2 | 0x8, 0x2000 | 0x10] {
        offsets.push(file.len() as u64);
        file.extend(0x041C_u16.to_le_bytes());
        file.extend(version.to_le_bytes());
        let mut content = flags.to_le_bytes().to_vec();
        if version == 4 {
            content.extend(b"part\0");
        }
        content.extend([3_u64, 1].iter().flat_map(|count| count.to_le_bytes()));
        let mut numbers = vec![0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, 1.0];
        if flags & 0x1 != 0 {
            numbers.extend([[0.0, 0.0, 1.0]; 3].as_flattened());
            numbers.extend([0.25; 6 + 9]);
            content.extend(numbers.iter().flat_map(|&x| (x as f32).to_le_bytes()));
        } else {
            content.extend(numbers.iter().flat_map(|x: &f64| x.to_le_bytes()));
        }
        content.extend([0_u32, 1, 2].iter().flat_map(|index| index.to_le_bytes()));
        let mut zlib = ZlibEncoder::new(file, compression);
        zlib.write_all(&content).expect("memory");
        file = zlib.finish().expect("memory");
    }
    let width = if version == 4 { 8 } else { 4 };
    file.extend(offsets.iter().flat_map(|offset| offset.to_le_bytes().into_iter().take(width)));
    file.extend(2_u32.to_le_bytes());
    file
}

/// A binary glTF file of one triangle that shines.
fn glb() -> Vec<u8> {
    let mut json = GLTF.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = Vec::new();
    for x in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        binary.extend(x.to_le_bytes());
    }
    for index in [0_u16, 1, 2, 0] {
        binary.extend(index.to_le_bytes());
    }
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// The same triangle, its buffer in the document.
fn gltf() -> Vec<u8> {
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA=";
    let buffer =
        format!(r#"{{"uri":"data:application/octet-stream;base64,{data}","byteLength":44}}"#);
    GLTF.replace(r#"{"byteLength":44}"#, &buffer).into_bytes()
}

fn volume(channels: i32) -> Vec<u8> {
    let integers = [1, 2, 2, 2, channels];
    let header = integers.iter().flat_map(|number: &i32| number.to_le_bytes());
    let bytes: Vec<u8> = b"VOL\x03".iter().copied().chain(header).collect();
    let values = vec![0.5; 8 * channels as usize];
    floats(&bytes, &[[0.0, 0.0, 0.0, 1.0, 1.0, 1.0].as_slice(), &values].concat())
}

fn floats(header: &[u8], values: &[f32]) -> Vec<u8> {
    header.iter().copied().chain(values.iter().flat_map(|value| value.to_le_bytes())).collect()
}

fn exr(compression: Compression) -> Vec<u8> {
    const SIZE: (usize, usize) = (6, 5);
    let values = |step: f32| (0..30).map(move |i| step * i as f32);
    let list = [
        AnyChannel::new("R", FlatSamples::F32(values(0.5).collect())),
        AnyChannel::new("G", FlatSamples::F16(values(0.25).map(f16::from_f32).collect())),
        AnyChannel::new("B", FlatSamples::U32(vec![7; 30])),
    ];
    let encoding = Encoding { compression, ..Encoding::SMALL_FAST_LOSSLESS };
    let channels = AnyChannels::sort(list.into_iter().collect());
    let layer = Layer::new(SIZE, LayerAttributes::named("first"), encoding, channels);
    let mut bytes = Cursor::new(Vec::new());
    exr::image::Image::from_layer(layer).write().to_buffered(&mut bytes).expect("memory");
    bytes.into_inner()
}

const GLTF: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[0,1,0]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"roughnessFactor":0.5},"emissiveFactor":[1,1,0]}],
"buffers":[{"byteLength":44}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]}"#;
