//! MTL material libraries.
//!
//! Values are kept as written; what they mean for a BSDF is decided by whoever uses them. `Ka`,
//! spectral files, CIE XYZ colours and texture options other than those of [`MtlMap`] are left aside.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use crate::Color;
use crate::error::{Location, SceneError, Warning};

use super::file::read_asset;
use super::lines::{Lines, fields, quote, real, statement};
use super::warnings::KindWarnings;

/// A texture of an MTL file.
#[derive(Clone, Debug, PartialEq)]
pub struct MtlMap {
    /// The image, relative to the folder of the MTL file.
    pub path: PathBuf,
    /// `-s`: what texture coordinates are multiplied by.
    pub scale: [f32; 2],
    /// `-o`: what is then added to them.
    pub offset: [f32; 2],
    /// `-bm`: what heights of bumps are multiplied by.
    pub bump: f32,
    /// `-clamp`: whether the image is not repeated.
    pub clamp: bool,
}

impl MtlMap {
    fn new(path: PathBuf) -> Self {
        Self { path, scale: [1.0; 2], offset: [0.0; 2], bump: 1.0, clamp: false }
    }
}

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
    /// `Tf`: colour of light that is let through.
    pub transmission: Option<Color>,
    /// `d`, or 1 − `Tr`: opacity, 1 is opaque.
    pub opacity: Option<f32>,
    /// `illum`: illumination model, 0 to 10.
    pub illumination: Option<f32>,
    /// `Pr`: roughness of the PBR extension.
    pub roughness: Option<f32>,
    /// `Pm`: metalness of the PBR extension.
    pub metallic: Option<f32>,
    /// `Ps`: weight of the sheen of the PBR extension.
    pub sheen: Option<f32>,
    /// `Pc`: weight of the clear coat of the PBR extension.
    pub clearcoat: Option<f32>,
    /// `Pcr`: roughness of the clear coat of the PBR extension.
    pub clearcoat_roughness: Option<f32>,
    /// `aniso`: anisotropy of the PBR extension.
    pub anisotropy: Option<f32>,
    /// `map_Kd`
    pub diffuse_map: Option<MtlMap>,
    /// `map_Ks`
    pub specular_map: Option<MtlMap>,
    /// `map_Ke`
    pub emission_map: Option<MtlMap>,
    /// `map_d`
    pub opacity_map: Option<MtlMap>,
    /// `map_Pr`
    pub roughness_map: Option<MtlMap>,
    /// `map_Pm`
    pub metallic_map: Option<MtlMap>,
    /// `norm`: texture of normals in the tangent frame.
    pub normal_map: Option<MtlMap>,
    /// `bump` or `map_bump`: texture of heights.
    pub bump_map: Option<MtlMap>,
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
        b"Kd" | b"Ks" | b"Ke" | b"Tf" => {
            let Some(value) = color(rest).map_err(|m| format!("{}: {m}", name()))? else {
                return Ok(Some(format!("'{} spectral' and '{0} xyz'", name())));
            };
            match keyword {
                b"Kd" => material.diffuse = Some(value),
                b"Ks" => material.specular = Some(value),
                b"Ke" => material.emission = Some(value),
                _ => material.transmission = Some(value),
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
        b"Ps" => material.sheen = Some(number()?),
        b"Pc" => material.clearcoat = Some(number()?),
        b"Pcr" => material.clearcoat_roughness = Some(number()?),
        b"aniso" => material.anisotropy = Some(number()?),
        b"Ka" | b"map_Ka" => {} // ambient light has no place in a path tracer
        _ => {
            let Some(slot) = map(material, keyword) else { return Ok(Some(quote(keyword))) };
            let (texture, ignored) = texture(rest, path);
            if texture.path.file_name().is_none() || texture.path.as_os_str().is_empty() {
                return Err(format!("{} needs a file name", name()));
            }
            *slot = Some(texture);
            return Ok(ignored.then(|| format!("options of '{}'", name())));
        }
    }
    Ok(None)
}

/// Where the texture of a statement belongs; `None` for a statement that is none, or of no known kind.
fn map<'m>(material: &'m mut MtlMaterial, keyword: &[u8]) -> Option<&'m mut Option<MtlMap>> {
    Some(match keyword {
        b"map_Kd" => &mut material.diffuse_map,
        b"map_Ks" => &mut material.specular_map,
        b"map_Ke" => &mut material.emission_map,
        b"map_d" => &mut material.opacity_map,
        b"map_Pr" => &mut material.roughness_map,
        b"map_Pm" => &mut material.metallic_map,
        b"norm" => &mut material.normal_map,
        b"bump" | b"map_bump" | b"map_Bump" => &mut material.bump_map,
        _ => return None,
    })
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

/// The texture of a statement, whose file name may hold spaces, and whether an option is ignored. The path is empty where the
/// statement names no file.
fn texture(rest: &[u8], mtl: &Path) -> (MtlMap, bool) {
    let mut map = MtlMap::new(PathBuf::new());
    let mut file = rest;
    let mut ignored = false;
    while let (option @ [b'-', ..], tail) = statement(file) {
        // Most to fewest arguments: of -o, -s and -t the second and third number may be missing.
        let (required, optional) = match option {
            b"-o" | b"-s" | b"-t" => (1, 2),
            b"-mm" => (2, 0),
            b"-blendu" | b"-blendv" | b"-boost" | b"-bm" | b"-cc" | b"-clamp" | b"-imfchan"
            | b"-texres" | b"-type" => (1, 0),
            _ => break,
        };
        file = tail;
        let mut numbers = [None; 3];
        let mut word: &[u8] = b"";
        for (argument, slot) in numbers.iter_mut().enumerate().take(required + optional) {
            let (value, after) = statement(file);
            let number = real(value);
            if argument >= required && number.is_err() {
                break;
            }
            *slot = number.ok();
            word = value;
            file = after;
        }
        match (option, numbers) {
            (b"-s", [Some(u), v, _]) => map.scale = [u, v.unwrap_or(1.0)],
            (b"-o", [Some(u), v, _]) => map.offset = [u, v.unwrap_or(0.0)],
            (b"-bm", [Some(factor), ..]) => map.bump = factor,
            (b"-clamp", _) => map.clamp = word == b"on",
            _ => ignored = true,
        }
    }
    if !file.is_empty() {
        map.path = relative(mtl, file);
    }
    (map, ignored)
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
             map_d -s 3 2 -clamp on -o 0.5 leaf.png\nmap_Bump -bm 0.1 -mm 0 1 bumps.png\nPc 1\nTf 1 0 0",
        );
        assert_eq!(m.name, "a b");
        assert_eq!((m.shininess, m.ior, m.opacity), (Some(10.0), Some(1.5), Some(0.75)));
        assert_eq!((m.illumination, m.roughness, m.metallic), (Some(2.0), Some(0.3), Some(1.0)));
        assert_eq!((m.clearcoat, m.transmission), (Some(1.0), Some(Color::new(1.0, 0.0, 0.0))));
        assert_eq!(m.diffuse_map, Some(MtlMap::new("dir/tex/my wood.png".into())));
        let leaf = MtlMap::new("dir/leaf.png".into());
        let leaf = MtlMap { scale: [3.0, 2.0], offset: [0.5, 0.0], clamp: true, ..leaf };
        assert_eq!(m.opacity_map, Some(leaf));
        let bumps = MtlMap { bump: 0.1, ..MtlMap::new("dir/bumps.png".into()) };
        assert_eq!(m.bump_map, Some(bumps));
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
