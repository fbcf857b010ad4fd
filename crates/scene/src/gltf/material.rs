//! Materials: what is common to all of them, and how they are put together.

use etendue_math::Spectrum;

use super::builder::Builder;
use super::document::EXTENSIONS;
use super::glass::{self, Transmission};
use super::json::Json;
use super::mesh::{ALPHA, COLOR};
use super::principled;
use super::texture::{self, Part, constant, product};
use crate::effect::Element;
use crate::material::{Material, MaterialId, Perturbation};
use crate::medium::Boundary;
use crate::texture::{AttributeTexture, Texture, TextureId, Threshold};
use crate::{Color, SceneError};

/// A material as one primitive wears it.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a fact about the primitive, and none excludes another"
)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Look {
    /// In the document's list; none for the default one.
    pub(super) index: Option<usize>,
    /// Whether there are texture coordinates.
    pub(super) has_uv: bool,
    /// Whether vertices have colours.
    pub(super) has_colors: bool,
    /// Whether some of them are not opaque.
    pub(super) has_alpha: bool,
    /// Whether textures are mirrored on the surface.
    pub(super) is_mirrored: bool,
}

/// What a surface is made of and emits, and what it encloses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Substance {
    pub(super) material: MaterialId,
    /// Of light that it emits.
    pub(super) radiance: Option<TextureId>,
    pub(super) boundary: Option<Boundary>,
}

/// A material as it is read, one property after another.
pub(super) struct Reading<'r, 'a> {
    pub(super) builder: &'r mut Builder<'a>,
    pub(super) json: Json<'a>,
    look: Look,
    /// Which texture coordinates the primitive has.
    set: usize,
}

/// What there is of a surface with holes.
struct Coverage {
    opacity: TextureId,
    /// The same without the opacities of vertices, of which lights know nothing.
    of_texture: TextureId,
}

/// The object that describes a material.
pub(super) fn json<'a>(
    builder: &Builder<'a>,
    index: Option<usize>,
) -> Result<Json<'a>, SceneError> {
    let document = builder.document();
    let described = match (index, document.root().get("materials")?) {
        (Some(index), Some(materials)) => materials.item(index)?,
        _ => None,
    };
    Ok(described.unwrap_or_else(|| document.nothing()))
}

/// The set of texture coordinates that a material looks at: that of its first texture.
pub(super) fn set(json: &Json<'_>) -> Result<usize, SceneError> {
    let mut objects = alloc::vec![json.clone()];
    objects.extend(json.get("pbrMetallicRoughness")?);
    // Base colour and roughness come first.
    objects.reverse();
    if let Some(extensions) = json.get("extensions")? {
        let known =
            extensions.properties()?.into_iter().filter(|(name, _)| EXTENSIONS.contains(name));
        objects.extend(known.map(|(_, extension)| extension));
    }
    for object in objects {
        for (name, reference) in object.properties()? {
            if name.ends_with("Texture") {
                return texture::set(&reference);
            }
        }
    }
    Ok(0)
}

/// The substance of a primitive.
///
/// # Errors
/// Properties of the wrong type or outside their domain, textures that cannot be read.
pub(super) fn of(builder: &mut Builder<'_>, look: Look) -> Result<Substance, SceneError> {
    if let Some(substance) = builder.substances_made.get(&look) {
        return Ok(*substance);
    }
    let json = json(builder, look.index)?;
    let set = set(&json)?;
    let mut reading = Reading { builder, json, look, set };
    let substance = reading.substance()?;
    builder.substances_made.insert(look, substance);
    Ok(substance)
}

impl<'a> Reading<'_, 'a> {
    fn substance(&mut self) -> Result<Substance, SceneError> {
        let coverage = self.coverage()?;
        let is_unlit = self.json.extension("KHR_materials_unlit")?.is_some();
        let (material, radiance, boundary) = if is_unlit {
            let (material, radiance) = self.unlit()?;
            (material, Some(radiance), None)
        } else {
            let (material, boundary) = self.lit()?;
            (material, self.emission()?, boundary)
        };
        let textures = &mut self.builder.model.textures;
        let radiance = match (&coverage, radiance) {
            (Some(coverage), Some(radiance)) => {
                Some(product(textures, radiance, coverage.of_texture))
            }
            (_, radiance) => radiance,
        };
        let radiance = radiance.filter(|&radiance| !textures.is_black(radiance));
        let material = match coverage {
            Some(Coverage { opacity, .. }) => {
                self.add(Material::Mask { opacity, nested: material })?
            }
            None => material,
        };
        Ok(Substance { material, radiance, boundary })
    }

    /// What light does at the surface, apart from holes.
    fn lit(&mut self) -> Result<(MaterialId, Option<Boundary>), SceneError> {
        let transmission = Transmission::of(self)?;
        let (material, boundary) = match &transmission {
            Some(transmission) => glass::of(self, transmission)?,
            None => (Material::Principled(principled::of(self, None)?.into()), None),
        };
        let mut id = self.add(material)?;
        if let Some(normal) = self.normal_map()? {
            let options = Perturbation::default();
            id = self.add(Material::NormalMap { normal, options, nested: id })?;
        }
        if transmission.is_none() {
            // Both sides are seen, `doubleSided` or not: what is hidden by culling has no back to be seen.
            id = self.add(Material::TwoSided { front: id, back: id })?;
        }
        Ok((id, boundary))
    }

    /// A surface that has its colour in any light: it shines and reflects nothing.
    fn unlit(&mut self) -> Result<(MaterialId, TextureId), SceneError> {
        let reflectance = self.builder.constant(0.0);
        let material = self.add(Material::Diffuse { reflectance })?;
        let material = self.add(Material::TwoSided { front: material, back: material })?;
        if self.look.has_colors {
            let message = "the colours of vertices are not seen on unlit materials";
            self.warn(message);
        }
        Ok((material, self.plain_color()?))
    }

    /// Adds a material that is a part of this one.
    pub(super) fn add(&mut self, material: Material) -> Result<MaterialId, SceneError> {
        self.builder.add(material, &self.json)
    }

    /// Notes something suspicious about this material.
    pub(super) fn warn(&mut self, message: &str) {
        self.builder.warn(&self.json.warning(message));
    }

    /// The object with the base colour, metal and roughness.
    pub(super) fn metallic_roughness(&self) -> Result<Json<'a>, SceneError> {
        let given = self.json.get("pbrMetallicRoughness")?;
        Ok(given.unwrap_or_else(|| self.builder.document().nothing()))
    }

    /// A factor times a texture, which may be missing.
    pub(super) fn textured(
        &mut self,
        object: &Json<'_>,
        name: &str,
        part: Part,
        factor: Color,
    ) -> Result<TextureId, SceneError> {
        let constant = self.builder.model.textures.constant(factor);
        if factor.is_black() {
            return Ok(constant);
        }
        match self.texture(object, name, part)? {
            Some(texture) => Ok(product(&mut self.builder.model.textures, texture, constant)),
            None => Ok(constant),
        }
    }

    /// A texture, if there is one that can be looked up.
    pub(super) fn texture(
        &mut self,
        object: &Json<'_>,
        name: &str,
        part: Part,
    ) -> Result<Option<TextureId>, SceneError> {
        let Some(reference) = object.get(name)? else { return Ok(None) };
        if !self.look.has_uv {
            let message = "a primitive without texture coordinates is rendered without the texture";
            self.builder.warn(&reference.warning(message));
            return Ok(None);
        }
        if texture::set(&reference)? != self.set {
            let message = alloc::format!(
                "only one set of texture coordinates is read for each material, here TEXCOORD_{}",
                self.set
            );
            self.builder.warn(&reference.warning(message));
        }
        texture::of(self.builder, &reference, part).map(Some)
    }

    /// A number from 0 to 1, times a channel of a texture.
    pub(super) fn share(
        &mut self,
        object: &Json<'_>,
        [factor, texture]: [&str; 2],
        channel: usize,
        default: f64,
    ) -> Result<TextureId, SceneError> {
        let factor = Color::splat(object.number_in(factor, default, 0.0..=1.0)? as f32);
        self.textured(object, texture, Part::Channel(channel), factor)
    }

    /// The number of a texture that is the same everywhere.
    pub(super) fn known(&self, texture: TextureId) -> Option<f32> {
        constant(&self.builder.model.textures, texture).map(|color| color.r)
    }

    /// The base colour without that of vertices.
    fn plain_color(&mut self) -> Result<TextureId, SceneError> {
        let object = self.metallic_roughness()?;
        let [r, g, b, _] = base_color_factor(&object)?;
        self.textured(&object, "baseColorTexture", Part::Color, Color::new(r, g, b))
    }

    /// The base colour.
    pub(super) fn base_color(&mut self) -> Result<TextureId, SceneError> {
        let color = self.plain_color()?;
        if self.look.has_colors { self.times_attribute(color, COLOR) } else { Ok(color) }
    }

    fn times_attribute(&mut self, texture: TextureId, name: &str) -> Result<TextureId, SceneError> {
        let attribute = AttributeTexture { name: name.into(), scale: 1.0 };
        let attribute = self.builder.model.textures.add(Texture::Attribute(attribute));
        self.builder.note(Element::Texture(attribute), &self.json)?;
        Ok(product(&mut self.builder.model.textures, texture, attribute))
    }

    /// What there is of the surface; none where all of it is.
    fn coverage(&mut self) -> Result<Option<Coverage>, SceneError> {
        let mode = self.json.get("alphaMode")?;
        let limit = match mode.as_ref().map(Json::as_text).transpose()?.unwrap_or("OPAQUE") {
            "OPAQUE" => return Ok(None),
            "MASK" => Some(self.json.number_in("alphaCutoff", 0.5, 0.0..=f64::MAX)? as f32),
            "BLEND" => None,
            other => {
                let error = mode.unwrap_or_else(|| self.json.clone());
                let message = alloc::format!("“{other}” is none of OPAQUE, MASK and BLEND");
                return Err(error.error(message));
            }
        };
        let object = self.metallic_roughness()?;
        let [.., alpha] = base_color_factor(&object)?;
        let part = Part::Channel(3);
        let of_texture = self.textured(&object, "baseColorTexture", part, Color::splat(alpha))?;
        let opacity =
            if self.look.has_alpha { self.times_attribute(of_texture, ALPHA)? } else { of_texture };
        let [opacity, of_texture] = [opacity, of_texture].map(|opacity| match limit {
            Some(limit) => self.threshold(opacity, limit),
            None => opacity,
        });
        let is_whole = self.known(opacity) == Some(1.0);
        Ok((!is_whole).then_some(Coverage { opacity, of_texture }))
    }

    fn threshold(&mut self, texture: TextureId, limit: f32) -> TextureId {
        match self.known(texture) {
            Some(opacity) => self.builder.constant(f32::from(opacity >= limit)),
            None => {
                let threshold = Texture::Threshold(Threshold { texture, limit });
                self.builder.model.textures.add(threshold)
            }
        }
    }

    /// Directions of the surface's normal, if they vary.
    fn normal_map(&mut self) -> Result<Option<TextureId>, SceneError> {
        let Some(reference) = self.json.get("normalTexture")? else { return Ok(None) };
        let scale = reference.number("scale")?.unwrap_or(1.0) as f32;
        let is_mirrored = self.look.is_mirrored;
        let json = self.json.clone();
        self.texture(&json, "normalTexture", Part::Normal { scale: scale.into(), is_mirrored })
    }

    /// The radiance of a material that shines by itself.
    fn emission(&mut self) -> Result<Option<TextureId>, SceneError> {
        let strength = match self.json.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.number_in("emissiveStrength", 1.0, 0.0..=f64::MAX)?,
            None => 1.0,
        };
        let factor = super::color(&self.json, "emissiveFactor", [0.0; 3])? * strength as f32;
        if !factor.to_array().iter().all(|x| x.is_finite()) {
            return Err(self.json.error("the emission is beyond single precision"));
        }
        if factor.is_black() {
            return Ok(None);
        }
        let json = self.json.clone();
        self.textured(&json, "emissiveTexture", Part::Color, factor).map(Some)
    }
}

/// `baseColorFactor`: colour and opacity.
fn base_color_factor(object: &Json<'_>) -> Result<[f32; 4], SceneError> {
    let factor = object.numbers::<4>("baseColorFactor")?.unwrap_or([1.0; 4]);
    if factor.iter().all(|x| (0.0..=1.0).contains(x)) {
        return Ok(factor.map(|x| x as f32));
    }
    Err(object.error("“baseColorFactor” must be four numbers from 0 to 1"))
}
