//! Tentative collisions: as dense as a bound of the density.

use etendue_math::Real;
use etendue_math::glam::Vec3;
use etendue_sampling::{Pcg32, uniform};
use etendue_scene::geometry::Ray;
use etendue_scene::medium::{Density, Stretch};

/// Points along a ray with the density of the bounds of a medium.
pub(super) struct Tentative<'n, I> {
    numbers: &'n mut Pcg32,
    ray: Ray,
    speed: f32,
    stretches: I,
    end: f32,
    /// Per parameter of the ray.
    majorant: f32,
    /// Optical thickness of what is left of the present stretch. Counting it down instead of the
    /// place up makes progress also where steps are too short to be added to a place.
    left: f32,
}

/// The tentative collisions of a density with the points of a ray.
#[inline]
pub(super) fn tentative<'n, 'd>(
    numbers: &'n mut Pcg32,
    ray: &Ray,
    density: &'d Density,
) -> Tentative<'n, impl Iterator<Item = Stretch> + use<'d>> {
    Tentative {
        numbers,
        ray: *ray,
        speed: ray.direction.length(),
        stretches: density.along(ray),
        end: 0.0,
        majorant: 0.0,
        left: 0.0,
    }
}

impl<I: Iterator<Item = Stretch>> Tentative<'_, I> {
    /// The next one and the bound there; `None` beyond the last.
    #[inline]
    pub(super) fn next(&mut self) -> Option<(Vec3, f32)> {
        let mut thickness = optical_thickness(self.uniform());
        loop {
            // False for NaN, which ends with the stretches.
            if thickness < self.left {
                break;
            }
            thickness -= self.left;
            let Stretch { begin, end, majorant } = self.stretches.next()?;
            self.end = end;
            self.majorant = majorant * self.speed;
            self.left = (end - begin) * self.majorant;
        }
        self.left -= thickness;
        let t = self.end - self.left / self.majorant;
        Some((self.ray.at(t), self.majorant / self.speed))
    }

    /// A uniform number for what becomes of it.
    #[inline]
    pub(super) fn uniform(&mut self) -> f32 {
        uniform(self.numbers)
    }
}

/// The optical thickness until the next collision, of one uniform number: `−ln(1 − u)`.
#[inline]
pub(super) fn optical_thickness(u: f32) -> f32 {
    -Real::ln_1p(-u)
}
