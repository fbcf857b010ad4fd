//! A mesh without a scene.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use super::emitter::Emission;
use super::mtl::Look;
use super::shape::{Surface, add_surface, shaded};
use super::{Context, LoadOptions, LoadedScene, bsdf, mtl, scene};
use crate::geometry::Shape;
use crate::light::{ConstantLight, Light};
use crate::load::{
    MeshFile, MtlMaterial, ObjMesh, ObjScene, Sandbox, TexCoords, load_obj, load_ply,
};
use crate::material::MaterialId;
use crate::scene::PathSettings;
use crate::xml::{Description, Leniency, parse_float, parse_list, parse_text};
use crate::{Color, Location, SceneError};

/// Where there is no light.
pub(super) const WHITE_SKY: Light =
    Light::Constant(ConstantLight { radiance: Color::new(1.0, 1.0, 1.0) });

/// The mesh of a file, in white light from everywhere unless it emits light itself.
///
/// # Errors
/// A file that is no mesh, a bsdf that is none.
pub(super) fn mesh(
    path: &Path,
    options: &LoadOptions,
    sandbox: Sandbox,
) -> Result<LoadedScene, SceneError> {
    let description = described(path, options)?;
    let mut context = Context::new(&description, options, sandbox);
    let given = given(&mut context)?;
    let ObjScene { meshes, materials, warnings } = read(path, &context.sandbox)?;
    context.warnings.extend(warnings);
    let own: Vec<Look> = if given.is_none() {
        materials.iter().map(|m| mtl::look(&mut context, m, path)).collect::<Result<_, _>>()?
    } else {
        Vec::new()
    };
    let other = match given {
        Some(material) => Look { material, radiance: None },
        None => mtl::look(&mut context, &MtlMaterial::default(), path)?,
    };
    for ObjMesh { name, material, mesh } in meshes {
        let is_flat = false;
        let mesh = shaded(mesh, is_flat)
            .map_err(|e| SceneError::scene(Location::file(path), format!("{e}")))?;
        let Look { material, radiance } =
            material.and_then(|index| own.get(index)).copied().unwrap_or(other);
        let shape = Shape::Mesh(mesh);
        let emission = radiance.filter(|_| shape.area_total() > 0.0).map(Emission::Everywhere);
        let surface = Surface { shape, motion: None, material, emission, boundary: None, name };
        add_surface(&mut context, surface);
    }
    if context.lights.is_empty() {
        context.lights.push(WHITE_SKY);
    }
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
    Ok(Some(mtl::on_both_sides(context, material)))
}

/// The parts of a mesh file; a PLY file has one.
fn read(path: &Path, sandbox: &Sandbox) -> Result<ObjScene, SceneError> {
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj")) {
        return load_obj(path, TexCoords::Flipped, sandbox);
    }
    let MeshFile { name, mesh, warnings, .. } = load_ply(path, TexCoords::AsWritten)?;
    // The options know no textures.
    let mesh = mesh.keep_attributes(|_| false);
    let mesh = ObjMesh { name, material: None, mesh };
    Ok(ObjScene { meshes: Vec::from([mesh]), materials: Vec::new(), warnings })
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
