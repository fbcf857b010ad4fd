//! A mesh without a scene.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use super::image::texels;
use super::shape::{Surface, add_surface, shaded};
use super::{Context, LoadOptions, LoadedScene, bsdf, scene};
use crate::geometry::Shape;
use crate::light::{ConstantLight, Light};
use crate::load::{Encoding, MeshFile, MtlMaterial, ObjMesh, ObjScene};
use crate::load::{TexCoords, load_image, load_obj, load_ply};
use crate::material::{Material, MaterialId};
use crate::scene::PathSettings;
use crate::texture::{Bitmap, Filter, Texture, TextureId, UvTransform, Wrap};
use crate::xml::{Description, Leniency, parse_float, parse_list, parse_text};
use crate::{Color, Location, SceneError};

/// What a mesh without material reflects.
const DEFAULT_ALBEDO: Color = Color::new(0.5, 0.5, 0.5);

/// Where there is no light.
pub(super) const WHITE_SKY: Light =
    Light::Constant(ConstantLight { radiance: Color::new(1.0, 1.0, 1.0) });

/// The mesh of a file, in white light from everywhere.
///
/// # Errors
/// A file that is no mesh, a bsdf that is none.
pub(super) fn mesh(path: &Path, options: &LoadOptions) -> Result<LoadedScene, SceneError> {
    let description = described(path, options)?;
    let mut context = Context::new(&description, options);
    let given = given(&mut context)?;
    let ObjScene { meshes, materials, warnings } = read(path)?;
    context.warnings.extend(warnings);
    let own: Vec<_> = if given.is_none() {
        materials.iter().map(|m| mtl(&mut context, m, path)).collect::<Result<_, _>>()?
    } else {
        Vec::new()
    };
    let other = match given {
        Some(material) => material,
        None => {
            let reflectance = context.textures.constant(DEFAULT_ALBEDO);
            diffuse(&mut context, reflectance, path)?
        }
    };
    for ObjMesh { name, material, mesh } in meshes {
        let is_flat = false;
        let mesh = shaded(mesh, is_flat)
            .map_err(|e| SceneError::scene(Location::file(path), format!("{e}")))?;
        let material = material.and_then(|index| own.get(index)).copied().unwrap_or(other);
        let surface = Surface {
            shape: Shape::Mesh(mesh),
            motion: None,
            material,
            radiance: None,
            boundary: None,
            name,
        };
        add_surface(&mut context, surface);
    }
    context.lights.push(WHITE_SKY);
    scene::assemble(context, None, PathSettings::default())
}

/// A scene file with nothing but the bsdf that the options ask for, which is read as any other.
pub(super) fn described(path: &Path, options: &LoadOptions) -> Result<Description, SceneError> {
    let element = options.bsdf.as_deref().map(bsdf_element).unwrap_or_default();
    let text = format!("<scene version=\"3.0.0\">{element}</scene>");
    let mut description = parse_text(&text, Path::new("--bsdf"), &[], Leniency::Strict)?;
    description.files = Vec::from([path.to_path_buf()]);
    Ok(description)
}

/// The material that the options ask for, if they do.
pub(super) fn given(context: &mut Context<'_>) -> Result<Option<MaterialId>, SceneError> {
    let Some(child) = context.description.root().children.first() else { return Ok(None) };
    let material = bsdf::translate(context, child.node)?;
    Ok(Some(on_both_sides(context, material)))
}

/// The parts of a mesh file; a PLY file has one.
fn read(path: &Path) -> Result<ObjScene, SceneError> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
        return load_obj(path, TexCoords::Flipped);
    }
    let MeshFile { name, mesh, warnings, .. } = load_ply(path, TexCoords::AsWritten)?;
    // The options know no textures.
    let mesh = mesh.keep_attributes(|_| false);
    let mesh = ObjMesh { name, material: None, mesh };
    Ok(ObjScene { meshes: Vec::from([mesh]), materials: Vec::new(), warnings })
}

/// The diffuse part of an MTL material. A texture that cannot be read is a warning, since meshes
/// often travel without theirs.
fn mtl(
    context: &mut Context<'_>,
    material: &MtlMaterial,
    path: &Path,
) -> Result<MaterialId, SceneError> {
    let color = material.diffuse.unwrap_or(DEFAULT_ALBEDO);
    let mut reflectance = context.textures.constant(color.to_array().map(|c| c.min(1.0)).into());
    if let Some(map) = &material.diffuse_map {
        match bitmap(map) {
            Ok(bitmap) => {
                context.files.push(map.clone());
                reflectance = context.textures.add(Texture::Bitmap(bitmap));
            }
            Err(error) => context.warn(error.location, error.message),
        }
    }
    diffuse(context, reflectance, path)
}

fn bitmap(path: &Path) -> Result<Bitmap, SceneError> {
    let image = load_image(path, Encoding::Srgb)?;
    texels(&image)
        .map(|image| Bitmap::new(image, Filter::Bilinear, Wrap::Repeat, UvTransform::IDENTITY))
        .map_err(|error| SceneError::scene(Location::file(path), format!("{error}")))
}

fn diffuse(
    context: &mut Context<'_>,
    reflectance: TextureId,
    path: &Path,
) -> Result<MaterialId, SceneError> {
    let material = Material::Diffuse { reflectance };
    let material = context.add_material(material, &Location::file(path))?;
    Ok(on_both_sides(context, material))
}

/// The material on both sides where it has only one: which side of a bare mesh is its outside is
/// anybody's guess.
fn on_both_sides(context: &mut Context<'_>, material: MaterialId) -> MaterialId {
    let both = Material::TwoSided { front: material, back: material };
    context.materials.add(both).unwrap_or(material)
}

/// `TYPE[:key=value,…]` as an element of a scene file: numbers are floats, three numbers with blanks
/// or `#rrggbb` colours, `true` and `false` booleans, and all else strings.
fn bsdf_element(text: &str) -> String {
    let (plugin, parameters) = text.split_once(':').unwrap_or((text, ""));
    let mut element = format!("<bsdf type=\"{}\">", escape(plugin.trim()));
    for parameter in parameters.split(',').filter(|p| !p.trim().is_empty()) {
        let (name, value) = parameter.split_once('=').unwrap_or((parameter, ""));
        let value = value.trim();
        let is_color = value.starts_with('#') || parse_list(value).is_ok_and(|v| v.len() == 3);
        let tag = if is_color {
            "rgb"
        } else if parse_float(value).is_some() {
            "float"
        } else if value == "true" || value == "false" {
            "boolean"
        } else {
            "string"
        };
        let (name, value) = (escape(name.trim()), escape(value));
        element += &format!("<{tag} name=\"{name}\" value=\"{value}\"/>");
    }
    element + "</bsdf>"
}

/// Text as the value of an attribute that means nothing but itself.
fn escape(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => result.push_str("&amp;"),
            '<' => result.push_str("&lt;"),
            '"' => result.push_str("&quot;"),
            '$' => result.push_str("\\$"),
            c if c.is_control() => result.push(' '),
            c => result.push(c),
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_become_elements() {
        assert_eq!(bsdf_element("diffuse"), "<bsdf type=\"diffuse\"></bsdf>");
        assert_eq!(
            bsdf_element("x: a=1, b=0.1 0.2 0.3,c=Au,d=true,e=#ff0000"),
            "<bsdf type=\"x\"><float name=\"a\" value=\"1\"/>\
             <rgb name=\"b\" value=\"0.1 0.2 0.3\"/><string name=\"c\" value=\"Au\"/>\
             <boolean name=\"d\" value=\"true\"/><rgb name=\"e\" value=\"#ff0000\"/></bsdf>"
        );
        let hostile = "<bsdf type=\"&lt;&quot;&amp;\\$x>\"></bsdf>";
        assert_eq!(bsdf_element("<\"&$x>"), hostile);
    }
}
