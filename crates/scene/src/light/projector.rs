//! Projectors.

use etendue_math::glam::Vec3;
use etendue_math::{Real, Vector3};

use super::point::from_point;
use super::{LightError, LightSample};
use crate::Color;
use crate::camera::FieldOfView;
use crate::geometry::Transform;
use crate::texture::{TextureId, Textures};

/// Throws a picture from one point along the +z axis of its own frame, as a camera there would take it.
///
/// With p the point that is lit, in that frame:
///
/// ```text
/// E = π s T(uv) / (z² cos θ)     z > 0 and uv in [0, 1]²; otherwise 0
/// uv = ½ − ½ (x / w, y / h) / z
/// ```
///
/// on a surface that faces it. T is the picture, s its scale, w and h half the extents of the plane at z = 1, and θ is
/// the angle to the axis: on a plane across the axis the picture is as bright everywhere. A transform that scales evenly
/// scales E.
///
/// # Source
/// Mitsuba 3's `projector`.
#[derive(Clone, Copy, Debug)]
pub struct ProjectorLight {
    transform: Transform,
    irradiance: TextureId,
    scale: f32,
    field_of_view: FieldOfView,
    half_extent: [f32; 2],
}

impl ProjectorLight {
    /// A projector.
    ///
    /// * `transform`: from its frame to the world's.
    /// * `irradiance`: E/π on the plane at z = 1, in W m⁻².
    /// * `scale`: its factor.
    /// * `picture_size`: columns and rows, of whose aspect the picture is.
    ///
    /// # Errors
    /// A scale that is not finite or negative; a field of view or a size outside its domain, or so extreme that the extent
    /// of the picture is no normal number.
    pub fn new(
        transform: Transform,
        irradiance: TextureId,
        scale: f32,
        field_of_view: FieldOfView,
        picture_size: [u32; 2],
    ) -> Result<Self, LightError> {
        if !(scale >= 0.0 && scale.is_finite()) {
            return Err(LightError::Emission);
        }
        let half_width =
            field_of_view.half_width(picture_size).map_err(|_| LightError::FieldOfView)?;
        let [width, height] = picture_size.map(f64::from);
        let half_extent = [half_width as f32, (half_width * height / width) as f32];
        // Extremes of a focal length, which have no limits of their own.
        if !half_extent.iter().all(|x| x.is_normal()) {
            return Err(LightError::FieldOfView);
        }
        Ok(Self { transform, irradiance, scale, field_of_view, half_extent })
    }

    /// From its frame to the world's.
    pub fn to_world(&self) -> &Transform {
        &self.transform
    }

    /// The factor of the picture.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    /// How wide the picture is thrown.
    pub fn field_of_view(&self) -> FieldOfView {
        self.field_of_view
    }

    /// Where it stands.
    pub fn position(&self) -> Vec3 {
        self.transform.point(Vec3::ZERO)
    }

    /// The middle of the pyramid that it lights, a unit vector.
    pub fn axis(&self) -> Vec3 {
        Vector3::try_normalize(self.forward()).unwrap_or(Vec3::Z)
    }

    /// The picture.
    pub fn texture(&self) -> TextureId {
        self.irradiance
    }

    /// The z axis in the world, as long as the transform makes it.
    #[inline]
    fn forward(&self) -> Vec3 {
        self.transform.vector(Vec3::Z)
    }

    /// Cosine of the largest angle between the axis and a corner of the picture.
    pub(crate) fn cos_corner(&self) -> f32 {
        let [w, h] = self.half_extent;
        let axis = self.axis();
        let corners = [[w, h], [-w, h], [w, -h], [-w, -h]];
        let cosine = |[x, y]: [f32; 2]| {
            let corner = self.transform.vector(Vec3::new(x, y, 1.0));
            axis.dot(corner) / Vector3::length(corner)
        };
        corners.into_iter().map(cosine).fold(1.0, f32::min)
    }

    /// Intensity along the axis, were the picture there as bright as anywhere; a luminance.
    pub(crate) fn peak(&self, textures: &Textures) -> f32 {
        self.pi_scale()
            * textures.max(self.irradiance).luminance()
            * Vector3::length(self.forward())
    }

    fn pi_scale(&self) -> f32 {
        f32::PI * self.scale
    }

    /// The light at a point.
    #[inline]
    pub(crate) fn sample(&self, reference: Vec3, textures: &Textures) -> Option<LightSample> {
        from_point(self.position(), reference, |direction| self.intensity(direction, textures))
    }

    /// Intensity `I = E d²` towards a unit direction.
    #[inline]
    fn intensity(&self, direction: Vec3, textures: &Textures) -> Color {
        let local = self.transform.inverse_vector(direction);
        let facing = self.forward().dot(direction);
        let [w, h] = self.half_extent;
        let (u, v) = (0.5 - 0.5 * local.x / (w * local.z), 0.5 - 0.5 * local.y / (h * local.z));
        // False for NaN too.
        let within =
            local.z > 0.0 && facing > 0.0 && (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        if !within {
            return Color::default();
        }
        textures.color(self.irradiance, [u, v]) * (self.pi_scale() / (local.z * local.z * facing))
    }

    /// From where to where a line lies within the four planes through the edges of the picture; the end is before the
    /// start where it does not.
    pub(crate) fn lit_line(&self, origin: Vec3, along: Vec3) -> [f32; 2] {
        let (o, d) = (self.transform.inverse_point(origin), self.transform.inverse_vector(along));
        let [w, h] = self.half_extent;
        let inwards = |v: Vec3| [w * v.z - v.x, w * v.z + v.x, h * v.z - v.y, h * v.z + v.y];
        let mut line = [f32::NEG_INFINITY, f32::INFINITY];
        for (height, slope) in inwards(o).into_iter().zip(inwards(d)) {
            let at = -height / slope;
            if slope > 0.0 {
                line[0] = line[0].max(at);
            } else if slope < 0.0 {
                line[1] = line[1].min(at);
            } else if height < 0.0 {
                line[1] = f32::NEG_INFINITY;
            }
        }
        line
    }

    /// Power in W, with the mean of the picture in place of the picture.
    ///
    /// ```text
    /// Φ = 4π s w h T |det M| / |M ẑ|²
    /// ```
    ///
    /// for a linear part M of the transform that leaves the axis at right angles to the picture.
    ///
    /// # Source
    /// Integral of the intensity over the sphere.
    pub(crate) fn power(&self, textures: &Textures) -> f32 {
        let linear = self.transform.affine().matrix3;
        let scaling = Real::abs(linear.determinant()) / linear.z_axis.length_squared();
        let [w, h] = self.half_extent;
        let mean = textures.mean(self.irradiance).luminance();
        4.0 * self.pi_scale() * w * h * mean * scaling as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::FovAxis;
    use crate::texture::{Bitmap, BitmapImage, Filter, Texture, UvTransform, Wrap};
    use etendue_math::Spectrum;
    use etendue_math::glam::DVec3;

    /// Two columns and three rows, linear in between.
    fn picture(textures: &mut Textures) -> TextureId {
        let image = BitmapImage::from_f32(2, 3, 1, &[0.1, 0.5, 0.9, 0.3, 0.7, 0.2]);
        let image = image.expect("six texels");
        let bitmap = Bitmap::new(image, Filter::Bilinear, Wrap::Repeat, UvTransform::IDENTITY);
        textures.add(Texture::Bitmap(bitmap))
    }

    fn across(degrees: f64, axis: FovAxis) -> FieldOfView {
        FieldOfView::Angle { degrees, axis }
    }

    /// Irradiance at a point that faces the light; 0 where none arrives.
    fn irradiance(light: &ProjectorLight, textures: &Textures, point: [f32; 3]) -> f32 {
        light.sample(Vec3::from_array(point), textures).map_or(0.0, |sample| sample.radiance.r)
    }

    #[test]
    fn the_picture_is_projected_as_in_mitsuba() {
        // Values by Mitsuba 3.9.1.
        let points = [[0.1, 0.3, 2.0], [-0.3, 0.2, 2.0], [0.0, 0.0, 1.0], [0.4, 0.5, 2.0]];
        let dark = [[2.0, 0.0, 2.0], [0.0, 0.0, -1.0]];
        let cases = [
            (across(40.0, FovAxis::X), [0.399_305_6, 0.306_081_3, 1.884_956, 0.292_595_7]),
            (across(40.0, FovAxis::Y), [0.326_648_6, 0.322_917_2, 1.884_956, 0.197_125_7]),
            (across(40.0, FovAxis::Diagonal), [0.271_709_1, 0.338_774_3, 1.884_956, 0.275_438_8]),
            (across(40.0, FovAxis::Smaller), [0.399_305_6, 0.306_081_3, 1.884_956, 0.292_595_7]),
            (across(40.0, FovAxis::Larger), [0.326_648_6, 0.322_917_2, 1.884_956, 0.197_125_7]),
            (
                FieldOfView::FocalLength { millimetres: 50.0 },
                [0.323_86, 0.324_211_4, 1.884_956, 0.202_731],
            ),
        ];
        let mut textures = Textures::default();
        let picture = picture(&mut textures);
        for (view, expected) in cases {
            let light = ProjectorLight::new(Transform::IDENTITY, picture, 1.0, view, [2, 3]);
            let light = light.expect("a projector");
            for (point, expected) in points.into_iter().zip(expected) {
                let found = irradiance(&light, &textures, point);
                // Seven printed digits; Mitsuba's matrix and its inverse have single precision.
                assert!((found / expected - 1.0).abs() < 3e-6, "{view:?} {point:?}: {found}");
            }
            assert_eq!(dark.map(|point| irradiance(&light, &textures, point)), [0.0; 2]);
        }
    }

    #[test]
    fn transforms_have_mitsubas_effect() {
        // Values by Mitsuba 3.9.1: 60° across, scale 3.
        let (eye, target) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.5, -1.0));
        let view = Transform::look_at(eye, target, DVec3::Y).expect("a regular view");
        let mut textures = Textures::default();
        let picture = picture(&mut textures);
        for (scale, expected) in [
            ([1.0, 1.0, 1.0], [0.293_759_3, 0.275_675_8, 0.222_522_4]),
            ([2.0, 2.0, 2.0], [0.587_518_6, 0.551_351_5, 0.445_044_9]),
            ([1.0, 2.0, 3.0], [0.881_278, 0.792_998_3, 0.0]),
            ([-1.0, 1.0, 1.0], [0.293_759_3, 0.330_669_9, 0.442_587_6]),
            ([1.0, 1.0, -1.0], [0.0; 3]),
        ] {
            let scaled = Transform::scale(DVec3::from_array(scale)).expect("not 0");
            let to_world = view.compose(&scaled).expect("regular");
            let across = across(60.0, FovAxis::X);
            let light = ProjectorLight::new(to_world, picture, 3.0, across, [2, 3]);
            let light = light.expect("a projector");
            let points = [[0.0, 0.5, -1.0], [0.5, 1.5, -1.0], [0.9, 0.8, -1.0]];
            for (point, expected) in points.into_iter().zip(expected) {
                let found = irradiance(&light, &textures, point);
                // As above.
                assert!(
                    (found - expected).abs() <= 3e-6 * expected,
                    "{scale:?} {point:?}: {found}"
                );
            }
        }
    }

    #[test]
    fn power_and_bounds_are_those_of_the_intensity() {
        let mut textures = Textures::default();
        let two = textures.constant(Color::splat(2.0));
        for (scale, degrees, size) in [
            ([1.0, 1.0, 1.0], 60.0, [1, 1]),
            ([0.5, 0.5, 0.5], 100.0, [3, 2]),
            ([2.0, 3.0, -0.7], 30.0, [1, 2]),
        ] {
            let to_world = Transform::scale(DVec3::from_array(scale)).expect("not 0");
            let light = ProjectorLight::new(to_world, two, 0.5, across(degrees, FovAxis::X), size);
            let light = light.expect("a projector");
            let (cos_corner, axis) = (light.cos_corner(), light.axis());
            // The midpoint rule in cos θ and φ, with edges that fall within intervals.
            let n = 700;
            let mut integral = 0.0;
            for i in 0..n {
                let z = 1.0 - 2.0 * (i as f32 + 0.5) / n as f32;
                for j in 0..n {
                    let (sin, cos) = Real::sin_cos(2.0 * f32::PI * (j as f32 + 0.5) / n as f32);
                    let r = Real::safe_sqrt(1.0 - z * z);
                    let direction = Vec3::new(r * cos, r * sin, z);
                    let intensity = light.intensity(direction, &textures);
                    integral += f64::from(intensity.luminance());
                    // A rounding of both cosines.
                    let beyond = axis.dot(direction) < cos_corner - 1e-6;
                    assert!(intensity.is_black() || !beyond, "{direction}");
                }
            }
            integral *= 4.0 * f64::PI / f64::from(n * n);
            let power = f64::from(light.power(&textures));
            // An edge is known to an interval of 1/n of the half sphere at most.
            assert!((integral / power - 1.0).abs() < 8.0 / f64::from(n), "{integral} {power}");
            let along_axis = light.intensity(axis, &textures).luminance();
            // A few roundings.
            assert!((light.peak(&textures) / along_axis - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn impossible_projectors_are_refused() {
        let new = |scale, degrees, size| {
            let view = across(degrees, FovAxis::X);
            ProjectorLight::new(Transform::IDENTITY, TextureId(0), scale, view, size).err()
        };
        assert_eq!(new(1.0, 40.0, [1, 1]), None);
        assert_eq!(new(f32::NAN, 40.0, [1, 1]), Some(LightError::Emission));
        assert_eq!(new(-1.0, 40.0, [1, 1]), Some(LightError::Emission));
        for (degrees, size) in [(180.0, [1, 1]), (f64::NAN, [1, 1]), (40.0, [0, 1])] {
            assert_eq!(new(1.0, degrees, size), Some(LightError::FieldOfView));
        }
        for millimetres in [0.0, 1e-300, 1e300] {
            let view = FieldOfView::FocalLength { millimetres };
            let light = ProjectorLight::new(Transform::IDENTITY, TextureId(0), 1.0, view, [1, 1]);
            assert_eq!(light.err(), Some(LightError::FieldOfView));
        }
    }
}
