//! Extinction that differs from place to place.

use etendue_math::glam::Vec3;

use super::Volume;
use super::majorants::{Majorants, Stretch};
use crate::Color;
use crate::geometry::Ray;

/// Extinction σt as a volume times a factor, within the volume's box and 0 outside, as in Mitsuba.
#[derive(Clone, Debug)]
pub struct Density {
    volume: Volume,
    scale: f32,
    majorants: Majorants,
}

impl Density {
    /// The largest optical thickness, bound of σt times diagonal of the box, that is accepted: what a
    /// path through it would take a million steps for is opaque.
    pub const THICKEST: f32 = 1e6;

    /// The density of a volume times `scale`, finite and not negative.
    ///
    /// # Errors
    /// A density above [`THICKEST`](Self::THICKEST), or a box or density that is not finite; the
    /// error is the optical thickness.
    pub fn new(volume: Volume, scale: f32) -> Result<Self, f32> {
        let majorants = Majorants::new(&volume, scale);
        let thickness = if scale.is_finite() {
            majorants.largest() * volume.bounds().extent().length()
        } else {
            scale
        };
        // Written so that NaN is refused.
        if thickness <= Self::THICKEST {
            Ok(Self { volume, scale, majorants })
        } else {
            Err(thickness)
        }
    }

    /// The same without colour: the mean of the channels. Its bounds stay: a mean exceeds none.
    pub(super) fn grey(self) -> Self {
        Self { volume: self.volume.grey(), ..self }
    }

    /// What is multiplied by the factor.
    pub fn volume(&self) -> &Volume {
        &self.volume
    }

    /// The factor.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    /// Whether channels may differ.
    pub fn is_coloured(&self) -> bool {
        self.volume.is_coloured()
    }

    /// Extinction at a point of the box.
    #[inline]
    pub fn at(&self, position: Vec3) -> Color {
        self.volume.at(position) * self.scale
    }

    /// The parts of a ray that lie in the box, in order, each with a bound of the extinction there.
    #[inline]
    pub fn along<'a>(&'a self, ray: &Ray) -> impl Iterator<Item = Stretch> + use<'a> {
        self.majorants.along(ray.origin, ray.direction, ray.t_max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Aabb, Transform};
    use crate::medium::{GridFilter, VolumeGrid};
    use crate::texture::Wrap;
    use alloc::vec::Vec;
    use etendue_math::glam::DVec3;
    use etendue_math::hash_u32;

    fn random(seed: u32) -> f32 {
        hash_u32(seed) as f32 / u32::MAX as f32
    }

    /// A turned and stretched grid of random values.
    fn cloud() -> Density {
        let values = (0..6 * 5 * 40).map(random).collect();
        let grid = VolumeGrid::new([6, 5, 40], 1, values).expect("as many as cells");
        let turn = Transform::rotate(DVec3::new(1.0, 2.0, 3.0), 40.0).expect("an axis");
        let size = Transform::scale(DVec3::new(2.0, 1.0, 5.0)).expect("a size");
        let to_world = turn.compose(&size).expect("regular");
        let volume = Volume::grid(grid, to_world, GridFilter::Trilinear, Wrap::Clamp);
        Density::new(volume, 3.0).expect("thin enough")
    }

    #[test]
    fn stretches_cover_the_box_without_gaps_and_their_bounds_hold() {
        let density = cloud();
        let Aabb { min, max } = density.volume.bounds();
        let mut covered = 0;
        for i in 0..500 {
            let point =
                |k: u32| Vec3::new(random(8 * i + k), random(8 * i + k + 1), random(8 * i + k + 2));
            let origin = min + (max - min) * (point(0) * 2.0 - 0.5);
            let mut direction = (point(3) - 0.5).normalize_or(Vec3::X);
            if i % 5 == 0 {
                direction = Vec3::Y * direction.y.signum();
            }
            let ray = Ray { t_max: 7.0, ..Ray::new(origin, direction) };
            let stretches: Vec<Stretch> = density.along(&ray).collect();
            for pair in stretches.windows(2) {
                assert_eq!(pair[0].end, pair[1].begin);
            }
            for Stretch { begin, end, majorant } in &stretches {
                assert!(begin <= end && *end <= 7.0);
                for k in 0..8 {
                    let at = density.at(ray.at(begin + (end - begin) * (k as f32 + 0.5) / 8.0));
                    assert!(at.r <= *majorant, "{at:?} {majorant}");
                }
            }
            let (first, last) = (stretches.first(), stretches.last());
            for k in 0..50 {
                let t = 7.0 * (k as f32 + 0.5) / 50.0;
                let p = ray.at(t);
                // Not closer to a wall than rounding.
                let inside = (p - min).min(max - p).min_element();
                if inside.abs() > 1e-4 {
                    let within = first.zip(last).is_some_and(|(f, l)| f.begin < t && t < l.end);
                    assert_eq!(within, inside > 0.0, "{i} {t}");
                    covered += u32::from(within);
                }
            }
        }
        assert!(covered > 1000, "{covered}");
    }

    #[test]
    fn what_is_too_dense_is_refused_with_its_thickness() {
        let thick = Density::new(Volume::constant(Color::new(1.0, 2.0, 3.0)), 1e6);
        // Three times the diagonal of the unit cube.
        assert!(thick.is_err_and(|thickness| (thickness / 5.196e6 - 1.0).abs() < 1e-3));
        assert!(Density::new(Volume::constant(Color::new(1.0, 2.0, 3.0)), f32::NAN).is_err());
    }
}
