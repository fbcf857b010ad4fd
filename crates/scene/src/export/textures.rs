//! Textures, and the numbers and colours that stand in their place.

use alloc::string::String;

use etendue_math::Spectrum as _;

use super::baked::baked;
use super::element::Element;
use super::exporter::Exporter;
use super::loss::Loss;
use super::values::{boolean, float, rgb, spectrum, string, transform};
use super::volumes;
use crate::Color;
use crate::color::Curve;
use crate::texture::{
    AttributeTexture, Bitmap, Checkerboard, Filter, Product, Texture, TextureId, Textures,
    UvTransform, Wrap,
};

/// What a texture stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Meaning {
    /// A share of light per colour, at most 1.
    Share,
    /// A property of matter per colour.
    Matter,
    /// Emitted light.
    Light,
    /// A number, or three that are no colour.
    Number,
}

impl Exporter<'_> {
    /// The parameter `name`: a number or colour, or a reference to the texture, which is described where that has not
    /// happened yet.
    pub(super) fn texture(&mut self, name: &str, id: TextureId, meaning: Meaning) -> Element {
        match self.scene.textures.get(id) {
            None => rgb(name, Color::default()),
            Some(&Texture::Constant(color)) => {
                self.constant(name, color, self.scene.textures.curve(id), meaning)
            }
            Some(texture) => {
                let id = self.texture_id(texture, id, meaning);
                Element::reference(&id).named(name)
            }
        }
    }

    /// The parameter `name` where a texture is the same everywhere.
    pub(super) fn constant(
        &self,
        name: &str,
        color: Color,
        curve: Option<&Curve>,
        meaning: Meaning,
    ) -> Element {
        let [r, g, b] = color.to_array();
        match (meaning, curve.filter(|_| self.spectral)) {
            (Meaning::Number, _) if r == g && g == b => float(name, r),
            // Mitsuba's white of equal energy.
            (Meaning::Light, Some(curve)) if *curve == Curve::constant(curve.at(0.0)) => {
                Element::value("spectrum", name, super::values::number(curve.at(0.0)))
            }
            (_, Some(curve)) => spectrum(name, curve),
            (Meaning::Share, None) => rgb(name, [r, g, b].map(|x| x.min(1.0)).into()),
            (Meaning::Matter | Meaning::Light | Meaning::Number, None) => rgb(name, color),
        }
    }

    fn texture_id(&mut self, texture: &Texture, id: TextureId, meaning: Meaning) -> String {
        if let Some(known) = self.texture_ids.get(&(id, meaning)) {
            return known.clone();
        }
        let (name, element) = match texture {
            // Constants stand where they are used; this one would be of a scene that was changed meanwhile.
            Texture::Constant(color) => (self.name("color"), even(*color, meaning)),
            Texture::Bitmap(bitmap) => {
                let name = self.name("bitmap");
                let element = self.bitmap(&name, bitmap, meaning);
                (name, element)
            }
            Texture::Checkerboard(board) => {
                let element = self.checkerboard(board, meaning);
                (self.name("checkerboard"), element)
            }
            Texture::Attribute(attribute) => {
                (self.name(&attribute.name), mesh_attribute(attribute, 1.0))
            }
            // Mitsuba has neither; what is no single image or attribute is the mean.
            Texture::Product(_) | Texture::Threshold(_) => {
                let name = self.name("product");
                let scene = self.scene;
                let element = if let Some(image) = baked(&scene.textures, id) {
                    if !image.is_exact {
                        self.losses.insert(Loss::Edges);
                    }
                    self.bitmap(&name, &image.bitmap, meaning)
                } else if let Some((factor, attribute)) = tinted_attribute(&scene.textures, texture)
                {
                    if factor != Color::splat(factor.r) {
                        self.losses.insert(Loss::Tint);
                    }
                    mesh_attribute(attribute, factor.luminance())
                } else {
                    self.losses.insert(Loss::Product);
                    even(scene.textures.mean(id), meaning)
                };
                (name, element)
            }
            Texture::Volume(texture) => {
                let volume = volumes::plugin(self, &texture.volume, 1.0).named("volume");
                (self.name("volume"), Element::plugin("texture", "volume").with(volume))
            }
        };
        self.textures.push(element.attribute("id", name.clone()));
        self.texture_ids.insert((id, meaning), name.clone());
        name
    }

    fn bitmap(&mut self, name: &str, bitmap: &Bitmap, meaning: Meaning) -> Element {
        let filename = self.image(name, bitmap.image());
        // Bilinear is what is left of filtering across levels of detail.
        let filter = match bitmap.filter() {
            Filter::Bilinear | Filter::Trilinear => None,
            Filter::Nearest => Some(string("filter_type", "nearest")),
        };
        let [wrap, other] = bitmap.wraps();
        if wrap != other {
            self.losses.insert(Loss::SecondWrap);
        }
        let wrap = match wrap {
            Wrap::Repeat => None,
            Wrap::Mirror => Some("mirror"),
            Wrap::Clamp => Some("clamp"),
        };
        // Which of its wavelengths' variants Mitsuba makes spectra of.
        let raw = (meaning == Meaning::Number).then(|| boolean("raw", true));
        Element::plugin("texture", "bitmap")
            .with(filename)
            .with_all(raw)
            .with_all(filter)
            .with_all(wrap.map(|wrap| string("wrap_mode", wrap)))
            .with_all(to_uv(bitmap.uv()))
    }

    fn checkerboard(&mut self, board: &Checkerboard, meaning: Meaning) -> Element {
        let colors = [("color0", board.color0), ("color1", board.color1)];
        let colors = colors.map(|(name, id)| self.texture(name, id, meaning));
        Element::plugin("texture", "checkerboard").with_all(colors).with_all(to_uv(&board.uv))
    }
}

/// A constant and the attribute that it multiplies.
fn tinted_attribute<'t>(
    textures: &'t Textures,
    texture: &Texture,
) -> Option<(Color, &'t AttributeTexture)> {
    let Texture::Product(Product { factors }) = texture else { return None };
    match factors.map(|factor| textures.get(factor)) {
        [Some(Texture::Constant(color)), Some(Texture::Attribute(attribute))]
        | [Some(Texture::Attribute(attribute)), Some(Texture::Constant(color))] => {
            Some((*color, attribute))
        }
        _ => None,
    }
}

/// An attribute of a mesh, times a factor.
fn mesh_attribute(attribute: &AttributeTexture, factor: f32) -> Element {
    let scale = attribute.scale * factor;
    Element::plugin("texture", "mesh_attribute")
        .with(string("name", &attribute.name))
        .with_all((scale != 1.0).then(|| float("scale", scale)))
}

/// A texture that is the same everywhere.
fn even(color: Color, meaning: Meaning) -> Element {
    let color = if meaning == Meaning::Share { color.map(|c| c.min(1.0)) } else { color };
    Element::plugin("texture", "srgb").with(rgb("color", color))
}

/// `to_uv`; nothing for the map that changes nothing.
fn to_uv(uv: &UvTransform) -> Option<Element> {
    if *uv == UvTransform::IDENTITY {
        return None;
    }
    let [[a, b, x], [c, d, y]] = uv.rows();
    Some(transform("to_uv", [[a, b, 0.0, x], [c, d, 0.0, y], [0.0, 0.0, 1.0, 0.0]]))
}
