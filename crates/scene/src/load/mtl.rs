//! MTL material libraries.
//!
//! Values are kept as written; what they mean for a BSDF is decided by whoever uses them. `Ka`,
//! spectral files, CIE XYZ colours and texture options other than the file are left aside.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use crate::Color;
use crate::error::{Location, SceneError, Warning};

use super::file::read_asset;
use super::lines::{Lines, fields, quote, real, statement};
use super::warnings::KindWarnings;

/// A material of an MTL file. What the file does not state is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MtlMaterial {
    /// `newmtl`: its name.
    pub name: String,
    /// `Kd`: diffuse reflectance.
    pub diffuse: Option<Color>,
    /// `Ks`: specular reflectance.
    pub specular: Option<Color>,
    /// `Ke`: emitted radiance.
    pub emission: Option<Color>,
    /// `Ns`: Phong exponent.
    pub shininess: Option<f32>,
    /// `Ni`: index of refraction.
    pub ior: Option<f32>,
    /// `d`, or 1 − `Tr`: opacity, 1 is opaque.
    pub opacity: Option<f32>,
    /// `illum`: illumination model, 0 to 10.
    pub illumination: Option<f32>,
    /// `Pr`: roughness of the PBR extension.
    pub roughness: Option<f32>,
    /// `Pm`: metalness of the PBR extension.
    pub metallic: Option<f32>,
    /// `map_Kd`: texture of the diffuse reflectance.
    pub diffuse_map: Option<PathBuf>,
    /// `map_d`: texture of the opacity.
    pub opacity_map: Option<PathBuf>,
}

/// The materials of an MTL file in order, and what was ignored.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_mtl`] refuses.
pub fn load_mtl(path: &Path) -> Result<(Vec<MtlMaterial>, Vec<Warning>), SceneError> {
    parse_mtl(&read_asset(path)?, path)
}

/// The materials of MTL text in order, and what was ignored. `path` stands in messages, and texture
/// paths are relative to its folder.
///
/// A colour of one number is grey. Unknown statements are ignored with one warning per kind.
///
/// # Errors
/// A missing, malformed or non-finite number; a property before the first `newmtl`.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use etendue_scene::load::parse_mtl;
/// let (materials, _) = parse_mtl(b"newmtl wall\nKd 0.5\n", Path::new("room.mtl"))?;
/// assert_eq!(materials[0].diffuse, Some(etendue_scene::Color::new(0.5, 0.5, 0.5)));
/// # Ok::<(), etendue_scene::SceneError>(())
/// ```
pub fn parse_mtl(
    bytes: &[u8],
    path: &Path,
) -> Result<(Vec<MtlMaterial>, Vec<Warning>), SceneError> {
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut warnings = KindWarnings::default();
    for line in Lines::new(bytes) {
        let here = || Location::line(path, line.number);
        let (keyword, rest) = statement(&line.text);
        if keyword.is_empty() || keyword.starts_with(b"#") {
            continue;
        }
        if keyword == b"newmtl" {
            let name = String::from_utf8_lossy(rest).into_owned();
            materials.push(MtlMaterial { name, ..MtlMaterial::default() });
            continue;
        }
        let Some(material) = materials.last_mut() else {
            let message = format!("{} comes before the first 'newmtl'", quote(keyword));
            return Err(SceneError::scene(here(), message));
        };
        if let Some(ignored) =
            property(material, keyword, rest, path).map_err(|m| SceneError::scene(here(), m))?
        {
            warnings.add(here, &ignored);
        }
    }
    Ok((materials, warnings.into_vec()))
}

/// Reads one property; returns what of it is ignored, if anything.
fn property(
    material: &mut MtlMaterial,
    keyword: &[u8],
    rest: &[u8],
    path: &Path,
) -> Result<Option<String>, String> {
    let name = || String::from_utf8_lossy(keyword);
    let number = || match fields(rest).next() {
        Some(field) => real(field).map_err(|m| format!("{}: {m}", name())),
        None => Err(format!("{} needs a number", name())),
    };
    match keyword {
        b"Kd" | b"Ks" | b"Ke" => {
            let Some(value) = color(rest).map_err(|m| format!("{}: {m}", name()))? else {
                return Ok(Some(format!("'{} spectral' and '{0} xyz'", name())));
            };
            match keyword {
                b"Kd" => material.diffuse = Some(value),
                b"Ks" => material.specular = Some(value),
                _ => material.emission = Some(value),
            }
        }
        b"Ns" => material.shininess = Some(number()?),
        b"Ni" => material.ior = Some(number()?),
        b"d" => {
            let value = rest.strip_prefix(b"-halo").map_or(rest, <[u8]>::trim_ascii_start);
            let field = fields(value).next().unwrap_or_default();
            material.opacity = Some(real(field).map_err(|m| format!("d: {m}"))?);
            if value.len() != rest.len() {
                return Ok(Some("'d -halo'".into()));
            }
        }
        b"Tr" => material.opacity = Some(1.0 - number()?),
        b"illum" => material.illumination = Some(number()?),
        b"Pr" => material.roughness = Some(number()?),
        b"Pm" => material.metallic = Some(number()?),
        b"map_Kd" | b"map_d" => {
            let (file, options) = texture(rest);
            if file.is_empty() {
                return Err(format!("{} needs a file name", name()));
            }
            let file = Some(relative(path, file));
            match keyword {
                b"map_Kd" => material.diffuse_map = file,
                _ => material.opacity_map = file,
            }
            if options {
                return Ok(Some(format!("options of '{}'", name())));
            }
        }
        b"Ka" | b"map_Ka" => {} // ambient light has no place in a path tracer
        _ => return Ok(Some(quote(keyword))),
    }
    Ok(None)
}

/// A colour of three numbers, or of one for grey; `None` for spectral curves and XYZ.
fn color(rest: &[u8]) -> Result<Option<Color>, String> {
    let mut values = [0.0; 3];
    let mut count = 0;
    for field in fields(rest) {
        if count == 0 && (field == b"spectral" || field == b"xyz") {
            return Ok(None);
        }
        if count < 3 {
            values[count] = real(field)?;
        }
        count += 1;
    }
    match count {
        1 => Ok(Some(Color::new(values[0], values[0], values[0]))),
        3 => Ok(Some(Color::new(values[0], values[1], values[2]))),
        n => Err(format!("expected one number or three, found {n}")),
    }
}

/// The file name of a texture statement, which may hold spaces, and whether options precede it.
fn texture(rest: &[u8]) -> (&[u8], bool) {
    let mut file = rest;
    let mut options = false;
    while let (option @ [b'-', ..], tail) = statement(file) {
        // Most to fewest arguments: of -o, -s and -t the second and third number may be missing.
        let (required, optional) = match option {
            b"-o" | b"-s" | b"-t" => (1, 2),
            b"-mm" => (2, 0),
            b"-blendu" | b"-blendv" | b"-boost" | b"-bm" | b"-cc" | b"-clamp" | b"-imfchan"
            | b"-texres" | b"-type" => (1, 0),
            _ => break,
        };
        options = true;
        file = tail;
        for argument in 0..required + optional {
            let (value, after) = statement(file);
            if argument >= required && real(value).is_err() {
                break;
            }
            file = after;
        }
    }
    (file, options)
}

/// A path written in a file, relative to that file. Backslashes separate folders as well.
pub(super) fn relative(file: &Path, written: &[u8]) -> PathBuf {
    let written = String::from_utf8_lossy(written).replace('\\', "/");
    file.parent().unwrap_or(Path::new("")).join(written)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<(Vec<MtlMaterial>, Vec<Warning>), SceneError> {
        parse_mtl(text.as_bytes(), Path::new("dir/a.mtl"))
    }

    fn material(text: &str) -> MtlMaterial {
        parse(text).expect("a valid file").0.remove(0)
    }

    #[test]
    fn one_number_is_grey_and_three_are_a_colour() {
        let m = material("newmtl a\nKd 0.5\nKs 0.1 0.2 0.3\nKe 10 # bright\n");
        assert_eq!(m.diffuse, Some(Color::new(0.5, 0.5, 0.5)));
        assert_eq!(m.specular, Some(Color::new(0.1, 0.2, 0.3)));
        assert_eq!(m.emission, Some(Color::new(10.0, 10.0, 10.0)));
    }

    #[test]
    fn scalars_and_textures_are_kept() {
        let m = material(
            "newmtl a b\nNs 10\nNi 1.5\nTr 0.25\nillum 2\nPr .3\nPm 1\nmap_Kd tex\\my wood.png\n\
             map_d -s 1 2 -clamp on -bm 1 leaf.png",
        );
        assert_eq!(m.name, "a b");
        assert_eq!((m.shininess, m.ior, m.opacity), (Some(10.0), Some(1.5), Some(0.75)));
        assert_eq!((m.illumination, m.roughness, m.metallic), (Some(2.0), Some(0.3), Some(1.0)));
        assert_eq!(m.diffuse_map.as_deref(), Some(Path::new("dir/tex/my wood.png")));
        assert_eq!(m.opacity_map.as_deref(), Some(Path::new("dir/leaf.png")));
        assert_eq!(material("newmtl a\nd -halo 0.5").opacity, Some(0.5));
    }

    #[test]
    fn malformed_values_name_file_and_line() {
        for (text, expected) in [
            ("newmtl a\nKd", "dir/a.mtl:2: Kd: expected one number or three, found 0"),
            ("newmtl a\nKd 1 2", "dir/a.mtl:2: Kd: expected one number or three, found 2"),
            ("newmtl a\n\nKd nan", "dir/a.mtl:3: Kd: 'nan' is not a finite number"),
            ("newmtl a\nNs x", "dir/a.mtl:2: Ns: 'x' is not a number"),
            ("newmtl a\nNi", "dir/a.mtl:2: Ni needs a number"),
            ("newmtl a\nd", "dir/a.mtl:2: d: '' is not a number"),
            ("newmtl a\nmap_Kd -bm 1", "dir/a.mtl:2: map_Kd needs a file name"),
            ("Kd 1", "dir/a.mtl:1: 'Kd' comes before the first 'newmtl'"),
        ] {
            assert_eq!(parse(text).map_err(|e| alloc::format!("{e}")), Err(expected.into()));
        }
    }

    #[test]
    fn each_ignored_kind_is_named_once() {
        let (_, warnings) =
            parse("newmtl a\nKa 1\nfoo 1\nfoo 2\nKd spectral a.rfl\n").expect("a valid file");
        let messages: Vec<_> = warnings.iter().map(|w| alloc::format!("{w}")).collect();
        assert_eq!(
            messages,
            ["dir/a.mtl:3: 'foo' is ignored", "dir/a.mtl:5: 'Kd spectral' and 'Kd xyz' is ignored"]
        );
    }

    #[test]
    fn truncated_files_never_panic() {
        let text = b"\xef\xbb\xbfnewmtl a\r\nKd 0.5 \\\n 0.5 1\nmap_d -o 1 2 -s 1 x.png\nd -halo 1";
        for end in 0..text.len() {
            let _ = parse_mtl(&text[..end], Path::new("a.mtl"));
        }
    }
}
