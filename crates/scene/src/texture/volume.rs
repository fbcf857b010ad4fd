//! Colours that fill space.

use etendue_math::Spectrum;

use super::TexturePoint;
use crate::Color;
use crate::medium::Volume;

/// A volume, looked up where the surface is in the world.
///
/// # Source
/// Mitsuba 3's `volume`.
#[derive(Clone, Debug)]
pub struct VolumeTexture {
    /// What is looked up.
    pub volume: Volume,
}

impl VolumeTexture {
    /// The colour there; black without a surface.
    pub fn color(&self, at: TexturePoint<'_>) -> Color {
        let surface = at.surface.map(|surface| self.volume.at(surface.point().position));
        surface.unwrap_or(Color::black())
    }

    /// The number there, as [`Volume::value_at`] has it; 0 without a surface.
    pub fn value(&self, at: TexturePoint<'_>) -> f32 {
        at.surface.map_or(0.0, |surface| self.volume.value_at(surface.point().position))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{GeometryBuilder, Located, Ray, Rectangle, Shape, Transform};
    use crate::medium::{GridFilter, VolumeGrid};
    use crate::texture::{Texture, Textures, Wrap};
    use alloc::vec;
    use etendue_math::glam::{DVec3, Vec3};

    /// Two cells along x of the world, from −1 to 1: red and blue.
    fn halves() -> Volume {
        let grid = VolumeGrid::new([2, 1, 1], 3, [1.0, 0.0, 0.0, 0.0, 0.0, 1.0].into());
        let size = Transform::scale(DVec3::splat(2.0)).expect("a size");
        let to_world = Transform::translate(DVec3::NEG_ONE).and_then(|t| t.compose(&size));
        let (grid, to_world) = (grid.expect("two cells"), to_world.expect("regular"));
        Volume::grid(grid, to_world, GridFilter::Nearest, Wrap::Clamp)
    }

    #[test]
    fn it_is_looked_up_in_the_world_whatever_the_coordinates_and_through_instances() {
        let mut textures = Textures::default();
        let id = textures.add(Texture::Volume(VolumeTexture { volume: halves() }));
        let mut builder = GeometryBuilder::new();
        let turned = Transform::rotate(DVec3::Z, 180.0).expect("a turn");
        let square = Shape::Rectangle(Rectangle::new(&turned).expect("a square"));
        builder.add_shape(square.clone());
        let (group, _) = builder.add_group(vec![square]);
        let away = Transform::translate(DVec3::new(1.5, 0.0, -1.0)).expect("a shift");
        builder.add_instance(group, away);
        let geometry = builder.build();
        for (x, from, color) in [
            (-0.5, 1.0, Color::new(1.0, 0.0, 0.0)),
            (0.5, 1.0, Color::new(0.0, 0.0, 1.0)),
            (0.7, -2.0, Color::new(0.0, 0.0, 1.0)),
        ] {
            let ray = Ray::new(Vec3::new(x, 0.1, from), Vec3::Z * -from.signum());
            let hit = geometry.intersect(&ray).expect("a square");
            let located = Located::new(&geometry, geometry.surface_point(&ray, &hit));
            assert_eq!(textures.color(id, &located), color, "{x} {from}");
            let value = textures.value(id, &located);
            assert_eq!(value, color.luminance());
        }
        assert_eq!(textures.mean(id), Color::new(0.5, 0.0, 0.5));
        assert_eq!(textures.max(id), Color::new(1.0, 0.0, 1.0));
        // Coordinates alone are no place.
        assert_eq!((textures.color(id, [0.5, 0.5]).r, textures.value(id, [0.5, 0.5])), (0.0, 0.0));
    }
}
