//! Spot lights.

use etendue_math::glam::Vec3;
use etendue_math::{Real, Vector3};

use super::point::from_point;
use super::{LightError, LightSample, is_emission};
use crate::Color;
use crate::geometry::Transform;
use crate::texture::{TextureId, Textures};

/// Emits from one point into a cone around the +z axis of its own frame.
///
/// ```text
/// I(θ) = I₀ T(uv)                        θ ≤ beam width b
///      = I₀ T(uv) (c − θ) / (c − b)      b < θ < cutoff c
///      = 0                               beyond
/// uv = ½ + ½ (x, y) / (z tan c)
/// ```
///
/// # Source
/// Mitsuba 3's `spot`.
#[derive(Clone, Copy, Debug)]
pub struct SpotLight {
    transform: Transform,
    intensity: Color,
    texture: Option<TextureId>,
    /// Cutoff angle and beam width as they were given.
    degrees: [f64; 2],
    cutoff: f32,
    beam_width: f32,
    cos_cutoff: f32,
    cos_beam_width: f32,
    tan_cutoff: f32,
}

impl SpotLight {
    /// A spot light.
    ///
    /// * `transform`: from its frame to the world's; only directions are scaled by it.
    /// * `intensity`: along the axis, in W sr⁻¹.
    /// * `texture`: projected along the axis, a factor.
    /// * `cutoff`, `beam_width`: in degrees from the axis.
    ///
    /// # Errors
    /// Intensity that is not finite or negative; angles other than `0 ≤ beam width ≤ cutoff ≤ 180`,
    /// `0 < cutoff`.
    pub fn new(
        transform: Transform,
        intensity: Color,
        texture: Option<TextureId>,
        cutoff: f64,
        beam_width: f64,
    ) -> Result<Self, LightError> {
        if !is_emission(intensity) {
            return Err(LightError::Emission);
        }
        if !(0.0 <= beam_width && beam_width <= cutoff && 0.0 < cutoff && cutoff <= 180.0) {
            return Err(LightError::Cone);
        }
        let degrees = [cutoff, beam_width];
        let [cutoff, beam_width] = degrees.map(f64::to_radians);
        Ok(Self {
            transform,
            intensity,
            texture,
            degrees,
            cutoff: cutoff as f32,
            beam_width: beam_width as f32,
            cos_cutoff: Real::cos(cutoff) as f32,
            cos_beam_width: Real::cos(beam_width) as f32,
            tan_cutoff: Real::tan(cutoff) as f32,
        })
    }

    /// From its frame to the world's.
    pub fn to_world(&self) -> &Transform {
        &self.transform
    }

    /// Intensity along the axis, in W sr⁻¹.
    pub fn axial_intensity(&self) -> Color {
        self.intensity
    }

    /// Cutoff angle and beam width in degrees from the axis.
    pub fn degrees(&self) -> [f64; 2] {
        self.degrees
    }

    /// Where it stands.
    pub fn position(&self) -> Vec3 {
        self.transform.point(Vec3::ZERO)
    }

    /// The middle of the cone, a unit vector.
    pub fn axis(&self) -> Vec3 {
        Vector3::try_normalize(self.transform.vector(Vec3::Z)).unwrap_or(Vec3::Z)
    }

    /// The texture that is projected, if any.
    pub fn texture(&self) -> Option<TextureId> {
        self.texture
    }

    /// Cutoff angle and beam width in radians.
    pub(crate) fn angles(&self) -> [f32; 2] {
        [self.cutoff, self.beam_width]
    }

    /// Largest intensity, as a luminance.
    pub(crate) fn peak(&self, textures: &Textures) -> f32 {
        let texture = self.texture.map_or(1.0, |texture| textures.max(texture).luminance());
        self.intensity.luminance() * texture
    }

    /// The light at a point: `E = I(θ) / d²`.
    #[inline]
    pub(crate) fn sample(&self, reference: Vec3, textures: &Textures) -> Option<LightSample> {
        from_point(self.position(), reference, |direction| self.intensity(direction, textures))
    }

    /// Intensity towards a unit direction.
    #[inline]
    fn intensity(&self, direction: Vec3, textures: &Textures) -> Color {
        let local = self.transform.inverse_vector(direction);
        let length = Vector3::length(local);
        let cos = local.z / length;
        // False for NaN too.
        let within = cos > self.cos_cutoff;
        if !within {
            return Color::default();
        }
        let falloff = if cos >= self.cos_beam_width {
            1.0
        } else {
            (self.cutoff - Real::acos(cos)) / (self.cutoff - self.beam_width)
        };
        let intensity = self.intensity * Real::clamp_to(falloff, 0.0, 1.0);
        let Some(texture) = self.texture else { return intensity };
        let scale = 0.5 / (local.z * self.tan_cutoff);
        intensity * textures.color(texture, [0.5 + local.x * scale, 0.5 + local.y * scale])
    }

    /// From where to where a line lies within the cone: the roots of a quadratic form that vanishes on it; the whole line
    /// where the cone is wider than a half space.
    pub(crate) fn lit_line(&self, origin: Vec3, along: Vec3) -> Option<[f32; 2]> {
        let whole = [f32::NEG_INFINITY, f32::INFINITY];
        if self.cos_cutoff <= 0.0 {
            return Some(whole);
        }
        let (o, d) = (self.transform.inverse_point(origin), self.transform.inverse_vector(along));
        let square = self.cos_cutoff * self.cos_cutoff;
        let form = |p: Vec3, q: Vec3| p.z * q.z - square * Vector3::dot(p, q);
        let (a, b, c) = (form(d, d), form(o, d), form(o, o));
        let discriminant = b * b - a * c;
        // False for NaN, too.
        let crosses = discriminant > 0.0;
        if !crosses {
            return None;
        }
        let sum = -(b + Real::copysign(Real::sqrt(discriminant), b));
        let (one, other) = (sum / a, c / sum);
        let (first, last) = (one.min(other), one.max(other));
        // Of a line that is flatter than the cone both ends lie on the same half of it, of a steeper one on either.
        let in_front = o.z + d.z * 0.5 * (first + last) > 0.0;
        match (a < 0.0, d.z > 0.0) {
            (true, _) => in_front.then_some([first, last]),
            (false, true) => Some([last, f32::INFINITY]),
            (false, false) => Some([f32::NEG_INFINITY, first]),
        }
    }

    /// Power in W, with the mean of the texture in place of the texture.
    ///
    /// ```text
    /// Φ = 2π I₀ (1 − (sin c − sin b) / (c − b))
    /// ```
    ///
    /// # Source
    /// Integral of the falloff over the sphere.
    pub(crate) fn power(&self, textures: &Textures) -> f32 {
        let (c, b) = (f64::from(self.cutoff), f64::from(self.beam_width));
        // The mean of cos over the transition, which for a narrow one cancels.
        let width = c - b;
        let mean_cos =
            if width < 1e-6 { Real::cos(c) } else { (Real::sin(c) - Real::sin(b)) / width };
        let texture = self.texture.map_or(1.0, |texture| textures.mean(texture).luminance());
        self.intensity.luminance() * texture * (2.0 * f64::PI * (1.0 - mean_cos)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Bitmap, BitmapImage, Filter, Texture, UvTransform, Wrap};
    use etendue_math::Spectrum;
    use etendue_math::glam::DVec3;

    #[test]
    fn the_falloff_is_mitsubas() {
        // Values by Mitsuba 3.9.1: 2 W/sr, cutoff 30°, beam width 15°.
        let (eye, target) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.5, -1.0));
        let view = Transform::look_at(eye, target, DVec3::Y).expect("a regular view");
        let intensity = Color::splat(2.0);
        let spot = SpotLight::new(view, intensity, None, 30.0, 15.0).expect("a spot light");
        for (point, expected) in [
            ([0.0, 0.5, -1.0], 0.103896),
            ([0.5, 1.5, -1.0], 0.121212),
            ([0.9, 0.8, -1.0], 0.114613),
            ([-0.5, 1.8, -1.0], 0.0842411),
        ] {
            let sample = spot.sample(Vec3::from_array(point), &Textures::default());
            let found = sample.map_or(f32::NAN, |s| s.radiance.r);
            // Six printed digits; the arc cosine of a cosine near 1 loses a few ε more.
            assert!((found / expected - 1.0).abs() < 1e-5, "{point:?}: {found} {expected}");
        }
    }

    #[test]
    fn the_texture_is_projected_as_in_mitsuba() {
        // Values by Mitsuba 3.9.1 for two columns and three rows, nearest texel.
        let mut textures = Textures::default();
        let image = BitmapImage::from_f32(2, 3, 1, &[0.1, 0.5, 0.9, 0.3, 0.7, 0.2]);
        let image = image.expect("six texels");
        let bitmap = Bitmap::new(image, Filter::Nearest, Wrap::Repeat, UvTransform::IDENTITY);
        let texture = Some(textures.add(Texture::Bitmap(bitmap)));
        let white = Color::splat(1.0);
        let spot = SpotLight::new(Transform::IDENTITY, white, texture, 30.0, 29.0);
        let spot = spot.expect("a spot light");
        for (point, expected) in [([0.1, 0.3, 2.0], 0.3), ([-0.1, 0.3, 2.0], 0.9)] {
            let point = Vec3::from_array(point);
            let sample = spot.sample(point, &textures);
            let found = sample.map_or(f32::NAN, |s| s.radiance.r * point.length_squared());
            // Division by the squared distance and back.
            assert!((found - expected).abs() < 1e-6, "{point}: {found}");
        }
    }

    #[test]
    fn the_power_is_the_integral_of_the_intensity() {
        for (cutoff, beam) in [(30.0, 15.0), (90.0, 0.0), (180.0, 180.0), (20.0, 20.0)] {
            let white = Color::splat(1.0);
            let spot = SpotLight::new(Transform::IDENTITY, white, None, cutoff, beam);
            let spot = spot.expect("a spot light");
            // The midpoint rule in cos θ, with an edge that may fall within one of the intervals.
            let n = 20_000;
            let cosine = |i| 1.0 - 2.0 * (i as f32 + 0.5) / n as f32;
            let at = |z: f32| Vec3::new(Real::safe_sqrt(1.0 - z * z), 0.0, z);
            let intensity =
                |i| f64::from(spot.intensity(at(cosine(i)), &Textures::default()).luminance());
            let integral = (0..n).map(intensity).sum::<f64>() * 4.0 * f64::PI / f64::from(n);
            let power = f64::from(spot.power(&Textures::default()));
            assert!((integral - power).abs() < 4.0 * f64::PI / f64::from(n), "{integral} {power}");
        }
    }

    #[test]
    fn impossible_cones_are_refused() {
        for (cutoff, beam) in [(0.0, 0.0), (20.0, 21.0), (181.0, 5.0), (f64::NAN, 1.0), (5.0, -1.0)]
        {
            let spot = SpotLight::new(Transform::IDENTITY, Color::splat(1.0), None, cutoff, beam);
            assert_eq!(spot.err(), Some(LightError::Cone));
        }
        let spot = SpotLight::new(Transform::IDENTITY, Color::splat(f32::NAN), None, 20.0, 10.0);
        assert_eq!(spot.err(), Some(LightError::Emission));
    }
}
