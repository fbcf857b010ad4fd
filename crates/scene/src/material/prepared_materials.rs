//! The materials of a scene, ready for look-ups.

use alloc::vec::Vec;

use super::{Material, MaterialId, Materials, PreparedBsdf, Side};
use crate::camera::Sight;
use crate::color::{Channels, Primaries};
use crate::geometry::{Geometry, Located, SurfacePoint};
use crate::texture::{Texture, Textures};

/// Materials with their textures: those that are the same everywhere are prepared once, the others
/// where they are asked for.
///
/// Gives the same reflection models as [`Materials::prepare`].
#[derive(Debug)]
pub struct PreparedMaterials<'a, C: Channels = Primaries> {
    materials: &'a Materials,
    textures: &'a Textures,
    geometry: &'a Geometry,
    sight: Sight,
    readiness: Vec<Readiness<'a, C>>,
}

/// How much of a material is known beforehand.
#[derive(Debug)]
enum Readiness<'a, C: Channels> {
    /// The same everywhere: its models seen from the front and the back.
    Uniform([PreparedBsdf<'a, C>; 2]),
    /// Depends on texture coordinates.
    Coordinates,
    /// Depends on more of the surface.
    Surface,
}

/// Where a model is put that had to be made for its place, and what it was made from.
#[derive(Debug)]
pub struct Varying<'a, C: Channels = Primaries> {
    surface: Option<Located<'a>>,
    bsdf: Option<PreparedBsdf<'a, C>>,
}

impl<C: Channels> Default for Varying<'_, C> {
    #[inline(always)]
    fn default() -> Self {
        Self { surface: None, bsdf: None }
    }
}

impl<'a, C: Channels> PreparedMaterials<'a, C> {
    /// Prepares what does not depend on the place; surfaces will be those of `geometry`, and as much of them be looked at as `sight`
    /// says.
    pub fn new(
        materials: &'a Materials,
        textures: &'a Textures,
        geometry: &'a Geometry,
        sight: Sight,
    ) -> Self {
        let anywhere = [0.0; 2].into();
        let prepare = |id, channels| {
            [Side::Front, Side::Back]
                .map(|side| materials.prepare(id, textures, anywhere, side, channels))
        };
        let readiness = (0..)
            .map(MaterialId)
            .zip(materials.iter())
            .map(|(id, material)| {
                if let Some(channels) = C::FIXED
                    && is_uniform(material, materials, textures)
                {
                    Readiness::Uniform(prepare(id, channels))
                } else if needs_surface(id, materials, textures) {
                    Readiness::Surface
                } else {
                    Readiness::Coordinates
                }
            })
            .collect();
        Self { materials, textures, geometry, sight, readiness }
    }

    /// The reflection model of a material at a point, looked at from one side.
    ///
    /// * `channels`: of the path.
    /// * `varying`: where the model is put if it had to be made for this place.
    #[inline(always)]
    pub fn at<'b>(
        &'b self,
        id: MaterialId,
        point: &SurfacePoint,
        side: Side,
        channels: C,
        varying: &'b mut Varying<'b, C>,
    ) -> &'b PreparedBsdf<'b, C> {
        match (self.readiness.get(id.0 as usize), side) {
            (Some(Readiness::Uniform([front, _])), Side::Front) => front,
            (Some(Readiness::Uniform([_, back])), Side::Back) => back,
            (Some(Readiness::Surface), _) => {
                // A copy field by field: a reference would keep the point of every path in memory.
                self.at_surface(id, SurfacePoint { ..*point }, side, channels, None, varying)
            }
            _ => {
                let bsdf =
                    self.materials.prepare(id, self.textures, point.uv.into(), side, channels);
                &*varying.bsdf.insert(bsdf)
            }
        }
    }

    /// The same for a material that depends on more than texture coordinates, or one of a
    /// [body among others](super::Nesting) that has one of index `exterior` around it there; out of line.
    #[inline(never)]
    pub fn at_surface<'b>(
        &'b self,
        id: MaterialId,
        point: SurfacePoint,
        side: Side,
        channels: C,
        exterior: Option<f32>,
        varying: &'b mut Varying<'b, C>,
    ) -> &'b PreparedBsdf<'b, C> {
        let located =
            Located::new(self.geometry, point).as_wide_as(self.sight.width(point.position));
        let at = (&*varying.surface.insert(located)).into();
        let Self { materials, textures, .. } = *self;
        varying.bsdf.insert(materials.prepare_within(id, textures, at, side, channels, exterior))
    }
}

/// Whether a material, or one that it is made of, depends on more than texture coordinates.
fn needs_surface(id: MaterialId, materials: &Materials, textures: &Textures) -> bool {
    let parts = materials.with_parts([id]);
    let parts: Vec<_> = parts.into_iter().filter_map(|part| materials.get(part)).collect();
    if parts.iter().any(|part| matches!(part, Material::BumpMap { .. })) {
        return true;
    }
    let used = textures.with_parts(parts.into_iter().flat_map(Material::textures));
    used.into_iter().any(|id| textures.get(id).is_some_and(Texture::needs_surface))
}

/// Whether all textures of a material, and of those that it is made of, are constant.
fn is_uniform(material: &Material, materials: &Materials, textures: &Textures) -> bool {
    // A material refers to earlier ones only: this ends.
    let uniform = |id| materials.get(id).is_some_and(|part| is_uniform(part, materials, textures));
    material.textures().all(|id| textures.is_constant(id)) && material.nested().all(uniform)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;
    use crate::camera::{Camera, Projection};
    use crate::film::Film;
    use crate::geometry::{GeometryBuilder, Ray, Rectangle, Shape, Transform};
    use crate::medium::Volume;
    use crate::texture::{
        AttributeTexture, Bitmap, BitmapImage, Checkerboard, Filter, UvTransform, VolumeTexture,
        Wrap,
    };
    use etendue_brdf::Bsdf;
    use etendue_math::Spectrum;
    use etendue_math::glam::Vec3;

    /// One square, and a point of it.
    fn square() -> (Geometry, SurfacePoint) {
        let mut builder = GeometryBuilder::new();
        builder
            .add_shape(Shape::Rectangle(Rectangle::new(&Transform::IDENTITY).expect("a square")));
        let geometry = builder.build();
        let ray = Ray::new(Vec3::Z, -Vec3::Z);
        let hit = geometry.intersect(&ray).expect("the square is below");
        let point = geometry.surface_point(&ray, &hit);
        (geometry, point)
    }

    #[test]
    fn models_are_those_of_the_place_whether_prepared_before_or_not() {
        let mut textures = Textures::default();
        let color0 = textures.constant(Color::splat(0.25));
        let color1 = textures.constant(Color::splat(0.75));
        let board = Checkerboard { color0, color1, uv: UvTransform::IDENTITY };
        let board = textures.add(Texture::Checkerboard(board));
        let mut materials = Materials::default();
        let mut add = |material| materials.add(material).expect("it refers to earlier ones");
        let grey = add(Material::Diffuse { reflectance: color1 });
        let chequered = add(Material::Diffuse { reflectance: board });
        let ids = [
            grey,
            chequered,
            add(Material::TwoSided { front: grey, back: chequered }),
            add(Material::TwoSided { front: grey, back: grey }),
            add(Material::Mask { opacity: color0, nested: grey }),
            MaterialId(99),
        ];
        let (geometry, point) = square();
        let prepared = PreparedMaterials::new(&materials, &textures, &geometry, Sight::SHARP);
        let wi = Vec3::new(0.6, 0.0, 0.8);
        for id in ids {
            for (side, z) in [(Side::Front, 1.0), (Side::Back, -1.0)] {
                for uv in [[0.1, 0.1], [0.6, 0.1]] {
                    let mut varying = Varying::default();
                    let point = SurfacePoint { uv, ..point };
                    let model = prepared.at(id, &point, side, Primaries, &mut varying);
                    let want = materials.prepare(id, &textures, uv.into(), side, Primaries);
                    let (wo, wi) = (Vec3::Z * z, wi * z);
                    assert_eq!(model.eval(wo, wi), want.eval(wo, wi), "{id:?} {side:?} {uv:?}");
                    assert_eq!(model.lobes(), want.lobes());
                }
            }
        }
    }

    #[test]
    fn only_what_varies_is_made_on_the_spot_and_only_attributes_and_volumes_need_the_surface() {
        let (geometry, _) = square();
        let mut textures = Textures::default();
        let white = textures.constant(Color::splat(1.0));
        let board = Checkerboard { color0: white, color1: white, uv: UvTransform::IDENTITY };
        let board = textures.add(Texture::Checkerboard(board));
        let attribute = AttributeTexture { name: "vertex_color".into(), scale: 1.0 };
        let color1 = textures.add(Texture::Attribute(attribute));
        let mixed = Checkerboard { color0: white, color1, uv: UvTransform::IDENTITY };
        let mixed = textures.add(Texture::Checkerboard(mixed));
        let mut materials = Materials::default();
        let volume = Volume::constant(Color::splat(0.5));
        let volume = textures.add(Texture::Volume(VolumeTexture { volume }));
        for reflectance in [white, board, mixed, volume] {
            materials.add(Material::Diffuse { reflectance }).expect("it refers to none");
        }
        let prepared =
            PreparedMaterials::<Primaries>::new(&materials, &textures, &geometry, Sight::SHARP);
        assert!(matches!(
            prepared.readiness[..],
            [Readiness::Uniform(_), Readiness::Coordinates, Readiness::Surface, Readiness::Surface]
        ));
    }

    #[test]
    fn filtered_images_are_seen_as_coarsely_as_samples_are_wide() {
        let (geometry, point) = square();
        let texels: Vec<f32> = (0..256).map(|i| f32::from((i + i / 16) % 2 == 0)).collect();
        let image = BitmapImage::from_f32(16, 16, 1, &texels).expect("256 texels");
        let identity = UvTransform::IDENTITY;
        let mut materials = Materials::default();
        let mut textures = Textures::default();
        for filter in [Filter::Trilinear, Filter::Bilinear] {
            let bitmap = Bitmap::new(image.clone(), filter, Wrap::Repeat, identity);
            let reflectance = textures.add(Texture::Bitmap(bitmap));
            materials.add(Material::Diffuse { reflectance }).expect("it refers to none");
        }
        // The middle of a texel, of a square of two units a side.
        let point = SurfacePoint { uv: [0.53125, 0.53125], ..point };
        let camera = Camera::new(Projection::Orthographic, Transform::IDENTITY, 0.1, 10.0, [4, 4]);
        let camera = camera.expect("a camera");
        // A pixel is half a unit, four texels.
        for (sight, filtered) in
            [(Sight::SHARP, 1.0), (Sight::new(&camera, &Film::new([4, 4]), 1), 0.5)]
        {
            let prepared = PreparedMaterials::new(&materials, &textures, &geometry, sight);
            for (id, expected) in [(0, filtered), (1, 1.0)] {
                let mut varying = Varying::default();
                let model =
                    prepared.at(MaterialId(id), &point, Side::Front, Primaries, &mut varying);
                assert_eq!(model.albedo(Vec3::Z), Some(Color::splat(expected)), "{id}");
            }
        }
    }
}
