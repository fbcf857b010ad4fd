//! How much of the world a sample stands for.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::Camera;
use crate::film::Film;

/// The width of what one sample of a pixel stands for, by the distance from the camera.
///
/// ```text
/// w(p) = s (|o′ − o| + |d′ − d| |p − o|),   s = max(1/8, 1/√samples)
/// ```
///
/// with o, d and o′, d′ the origins and directions of the rays through the middles of two neighbouring pixels in the middle of the
/// film, where the shutter opens. A surface that is seen in a mirror counts as if it were seen without.
///
/// # Source
/// M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, section 10.1.3: the approximation by the distance
/// from the camera, and the factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    origin: Vec3,
    width: f32,
    angle: f32,
}

impl Sight {
    /// Of points without extent.
    pub const SHARP: Self = Self { origin: Vec3::ZERO, width: 0.0, angle: 0.0 };

    /// Of a camera whose pixels have some samples each.
    pub fn new(camera: &Camera, film: &Film, samples_per_pixel: u32) -> Self {
        let middle = film.size.map(|pixels| pixels as f32 * 0.5);
        let [ray, next] =
            [0.0, 1.0].map(|column| camera.ray([middle[0] + column, middle[1]], [0.5; 2]));
        let scale = (1.0 / Real::sqrt(samples_per_pixel.max(1) as f32)).max(0.125);
        Self {
            origin: ray.origin,
            width: scale * ray.origin.distance(next.origin),
            angle: scale * ray.direction.distance(next.direction),
        }
    }

    /// The width at a point of the world, across the view.
    #[inline]
    pub fn width(&self, position: Vec3) -> f32 {
        self.width + self.angle * position.distance(self.origin)
    }
}
