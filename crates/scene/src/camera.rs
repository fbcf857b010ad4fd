//! Cameras.

mod field_of_view;
mod meter;
mod sight;

use alloc::sync::Arc;

use etendue_math::glam::{Vec2, Vec3};
use etendue_math::{Real, Vector3};
use etendue_sampling::warp::disk;

pub use field_of_view::{FieldOfView, FovAxis};
pub use sight::Sight;

use crate::geometry::{Motion, Ray, Shape, Transform};
use meter::Meter;

/// How directions become points of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// A pinhole.
    Perspective {
        /// How much is seen.
        field_of_view: FieldOfView,
        /// Shift of the optical axis in widths and heights of the film, for lenses that are
        /// shifted sideways.
        principal_point_offset: [f32; 2],
    },
    /// A lens of negligible thickness: what lies off the focal plane is blurred.
    ThinLens {
        /// How much is seen.
        field_of_view: FieldOfView,
        /// Radius of the lens in units of the scene, not negative.
        aperture_radius: f32,
        /// Distance of the plane in focus along the optical axis, positive.
        focus_distance: f32,
    },
    /// Parallel rays; the film is 2 units wide before the camera's own scaling.
    Orthographic,
    /// A single ray, from the origin of the camera along its axis: it measures radiance. There are no clipping planes.
    RadianceMeter,
    /// Rays from a surface into the half-space before it: it measures irradiance. Made by [`Camera::irradiance_meter`].
    IrradianceMeter,
}

/// Why a camera is refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// The film has no pixel.
    #[error("the film has no pixels")]
    Film,
    /// The angle is NaN or outside its domain.
    #[error("a field of view of {0}° is not between 0° and 180°")]
    FieldOfView(f64),
    /// The focal length is NaN, infinite or not positive.
    #[error("a focal length of {0} mm is not positive and finite")]
    FocalLength(f64),
    /// The clipping distances do not enclose anything.
    #[error("clipping distances need 0 < near < far, but are {near} and {far}")]
    Clip {
        /// The near one.
        near: f32,
        /// The far one.
        far: f32,
    },
    /// A lens radius that is NaN, infinite or negative.
    #[error("an aperture radius of {0} is not a length")]
    Aperture(f32),
    /// A distance that is NaN, infinite or not positive.
    #[error("a focus distance of {0} is not positive and finite")]
    FocusDistance(f32),
    /// An offset that is NaN or infinite.
    #[error("the offset of the principal point is not finite")]
    PrincipalPoint,
    /// An irradiance meter without area, or one that is to be made without its surface.
    #[error("an irradiance meter needs a surface that has an area")]
    Surface,
    /// The transform maps the optical axis to nothing that has a direction.
    #[error("the camera's transform leaves no direction to look in")]
    Transform,
}

/// A camera: from a point of the film and a point of the lens to a ray.
///
/// In its own coordinates it looks along +z with +y up and +x to the *left* of the picture.
///
/// # Source
/// The conventions of Mitsuba 3's `perspective`, `thinlens` and `orthographic`.
///
/// # Examples
/// ```
/// use etendue_math::glam::{DVec3, Vec3};
/// use etendue_scene::camera::{Camera, FieldOfView, FovAxis, Projection};
/// use etendue_scene::geometry::Transform;
///
/// let to_world = Transform::look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y)?;
/// let field_of_view = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
/// let projection = Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
/// let camera = Camera::new(projection, to_world, 0.01, 1e4, [640, 480])?;
/// let ray = camera.ray([320.0, 240.0], [0.5, 0.5]);
/// assert_eq!(ray.direction, -Vec3::Z);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    projection: Projection,
    /// Where the shutter opens.
    to_world: Transform,
    motion: Option<Motion>,
    near: f32,
    far: f32,
    /// The point of the film, in pixels, that the optical axis goes through.
    center: Vec2,
    /// Camera x and y, at distance 1, from pixel to pixel.
    step: f32,
    optics: Optics,
}

#[derive(Clone, Debug)]
enum Optics {
    Pinhole,
    Lens { radius: f32, focus_distance: f32 },
    Parallel { direction: Vec3 },
    Single { direction: Vec3 },
    Meter(Arc<Meter>),
}

impl Camera {
    /// A camera.
    ///
    /// * `to_world`: from camera to world coordinates. A perspective camera is not changed by
    ///   scaling, an orthographic one sees more.
    /// * `near`, `far`: nothing nearer or farther along the optical axis is seen; `0 < near < far`.
    /// * `film_size`: of the whole film, also where only a crop is rendered.
    ///
    /// # Errors
    /// Any parameter outside its domain.
    pub fn new(
        projection: Projection,
        to_world: Transform,
        near: f32,
        far: f32,
        film_size: [u32; 2],
    ) -> Result<Self, CameraError> {
        if !(near > 0.0 && near < far && far.is_finite()) {
            return Err(CameraError::Clip { near, far });
        }
        let axis = optical_axis(&to_world).ok_or(CameraError::Transform)?;
        let (half_width, [offset_x, offset_y], optics) = match projection {
            Projection::Perspective { field_of_view, principal_point_offset } => {
                (field_of_view.half_width(film_size)?, principal_point_offset, Optics::Pinhole)
            }
            Projection::ThinLens { field_of_view, aperture_radius, focus_distance } => {
                if !(aperture_radius >= 0.0 && aperture_radius.is_finite()) {
                    return Err(CameraError::Aperture(aperture_radius));
                }
                if !(focus_distance > 0.0 && focus_distance.is_finite()) {
                    return Err(CameraError::FocusDistance(focus_distance));
                }
                let lens = Optics::Lens { radius: aperture_radius, focus_distance };
                (field_of_view.half_width(film_size)?, [0.0; 2], lens)
            }
            Projection::Orthographic => (1.0, [0.0; 2], Optics::Parallel { direction: axis }),
            Projection::RadianceMeter => (1.0, [0.0; 2], Optics::Single { direction: axis }),
            Projection::IrradianceMeter => return Err(CameraError::Surface),
        };
        if !(offset_x.is_finite() && offset_y.is_finite()) {
            return Err(CameraError::PrincipalPoint);
        }
        let [width, height] = film_size.map(f64::from);
        if width < 1.0 || height < 1.0 {
            return Err(CameraError::Film);
        }
        Ok(Self {
            projection,
            to_world,
            motion: None,
            near,
            far,
            center: Vec2::new(
                (width * (0.5 - f64::from(offset_x))) as f32,
                (height * (0.5 - f64::from(offset_y))) as f32,
            ),
            step: (-2.0 * half_width / width) as f32,
            optics,
        })
    }

    /// What measures the irradiance on the front of a shape in the world, in the mean over its area: π times the mean of
    /// the radiance along rays that leave it in proportion to their cosine. The film stands for the area.
    ///
    /// # Errors
    /// A shape without area, a film without pixels.
    pub fn irradiance_meter(shape: Shape, film_size: [u32; 2]) -> Result<Self, CameraError> {
        let meter = Meter::new(shape).ok_or(CameraError::Surface)?;
        let camera =
            Self::new(Projection::Orthographic, Transform::IDENTITY, 1e-3, 1.0, film_size)?;
        let optics = Optics::Meter(Arc::new(meter));
        Ok(Self { projection: Projection::IrradianceMeter, optics, ..camera })
    }

    /// What the radiance along rays is multiplied by: π of an irradiance meter, 1 of everything else.
    #[inline]
    pub fn weight(&self) -> f32 {
        match self.optics {
            Optics::Meter(_) => f32::PI,
            _ => 1.0,
        }
    }

    /// The same on its way while the shutter is open.
    ///
    /// # Errors
    /// A placement at the opening that leaves no direction to look in.
    pub fn moving(self, motion: Motion) -> Result<Self, CameraError> {
        let opening = *motion.opening();
        let axis = optical_axis(&opening).ok_or(CameraError::Transform)?;
        Ok(Self { motion: Some(motion), ..self.placed(&opening, axis) })
    }

    /// The same standing still at another place.
    fn placed(&self, to_world: &Transform, axis: Vec3) -> Self {
        let optics = match &self.optics {
            Optics::Parallel { .. } => Optics::Parallel { direction: axis },
            Optics::Single { .. } => Optics::Single { direction: axis },
            optics => optics.clone(),
        };
        let Self { projection, near, far, center, step, .. } = *self;
        Self { projection, to_world: *to_world, motion: None, near, far, center, step, optics }
    }

    /// The same standing still where it is at a moment, if it moves.
    fn on_the_way(&self, time: f32) -> Option<Self> {
        let to_world = self.motion.as_ref()?.at(time);
        // The optical axis never vanishes: all placements on the way have inverses.
        Some(self.placed(&to_world, optical_axis(&to_world).unwrap_or(Vec3::Z)))
    }

    /// The [`ray`](Self::ray) at a moment, a share of the exposure: 0 where the shutter opens, 1 where it closes.
    #[inline]
    pub fn ray_at(&self, film: [f32; 2], lens: [f32; 2], time: f32) -> Ray {
        if self.is_moving() { self.moving_ray(film, lens, time) } else { self.ray(film, lens) }
    }

    /// Out of line, since most cameras stand still.
    #[inline(never)]
    fn moving_ray(&self, film: [f32; 2], lens: [f32; 2], time: f32) -> Ray {
        self.on_the_way(time).as_ref().unwrap_or(self).ray(film, lens)
    }

    /// The ray through a point of the film and a point of the lens, from the near clipping plane
    /// to the far one, where the shutter opens; its direction has unit length.
    ///
    /// * `film`: column and row in pixels of the whole film; the first pixel, at the top left,
    ///   covers `[0, 1)²`.
    /// * `lens`: two uniforms in `[0, 1)`; only a thin lens and an irradiance meter use them.
    #[inline]
    pub fn ray(&self, film: [f32; 2], lens: [f32; 2]) -> Ray {
        let at = (Vec2::from_array(film) - self.center) * self.step;
        match &self.optics {
            Optics::Pinhole => self.ray_along(Vec3::ZERO, at.extend(1.0)),
            Optics::Lens { radius, focus_distance } => {
                let [x, y] = disk::from_square(lens);
                let aperture = Vec2::new(x, y) * *radius;
                let focus = at * *focus_distance;
                self.ray_along(aperture.extend(0.0), (focus - aperture).extend(*focus_distance))
            }
            Optics::Parallel { direction } => Ray {
                origin: self.to_world.point(at.extend(self.near)),
                direction: *direction,
                t_max: self.far - self.near,
            },
            Optics::Single { direction } => Ray::new(self.position(), *direction),
            Optics::Meter(meter) => self.ray_of(meter, film, lens),
        }
    }

    /// The ray of an irradiance meter; one that meets nothing where the meter has none.
    #[inline(never)]
    fn ray_of(&self, meter: &Meter, film: [f32; 2], direction: [f32; 2]) -> Ray {
        // The middle of the film is the centre: no shift of the axis is possible.
        let on = (Vec2::from_array(film) / (self.center * 2.0))
            .clamp(Vec2::ZERO, Vec2::splat(f32::ONE_MINUS_EPSILON));
        meter.ray(on.to_array(), direction).unwrap_or(Ray {
            origin: Vec3::ZERO,
            direction: Vec3::Z,
            t_max: 0.0,
        })
    }

    /// The clipped ray from a point of the plane z = 0 in a direction with positive z, both in
    /// camera coordinates.
    #[inline]
    fn ray_along(&self, from: Vec3, local: Vec3) -> Ray {
        // How far to go for every unit of depth.
        let slant = Vector3::length(local) / local.z;
        let world = self.to_world.vector(local);
        let direction = world / Vector3::length(world);
        Ray {
            origin: self.to_world.point(from) + direction * (self.near * slant),
            direction,
            t_max: (self.far - self.near) * slant,
        }
    }

    /// How far a point lies at a moment from the camera along its optical axis, in units of the scene; negative behind
    /// it.
    pub fn depth_at(&self, position: Vec3, time: f32) -> f32 {
        self.on_the_way(time).as_ref().unwrap_or(self).depth(position)
    }

    fn depth(&self, position: Vec3) -> f32 {
        let axis = self.to_world.vector(Vec3::Z);
        let from_camera = position - self.to_world.point(Vec3::ZERO);
        from_camera.dot(axis) / Vector3::length(axis)
    }

    /// Whether rays depend on the two uniforms that stand for a point of the lens.
    #[inline]
    pub fn samples_lens(&self) -> bool {
        matches!(self.optics, Optics::Lens { .. } | Optics::Meter(_))
    }

    /// Whether what is out of focus is blurred.
    #[inline]
    pub fn has_lens(&self) -> bool {
        matches!(self.optics, Optics::Lens { .. })
    }

    /// Whether rays depend on the moment.
    #[inline]
    pub fn is_moving(&self) -> bool {
        self.motion.is_some()
    }

    /// The same where the shutter opens, standing still.
    pub(crate) fn without_motion(self) -> Self {
        Self { motion: None, ..self }
    }

    /// The same with everything in focus.
    pub(crate) fn without_lens(self) -> Self {
        if self.has_lens() { Self { optics: Optics::Pinhole, ..self } } else { self }
    }

    /// What kind of camera it is, in words.
    pub fn name(&self) -> &'static str {
        match self.optics {
            Optics::Pinhole => "perspective",
            Optics::Lens { .. } => "thin lens",
            Optics::Parallel { .. } => "orthographic",
            Optics::Single { .. } => "radiance meter",
            Optics::Meter(_) => "irradiance meter",
        }
    }

    /// What the camera was made from.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// The shape whose surface an irradiance meter measures; none of other cameras.
    pub fn metered(&self) -> Option<&Shape> {
        match &self.optics {
            Optics::Meter(meter) => Some(meter.shape()),
            _ => None,
        }
    }

    /// From camera to world coordinates when the shutter opens.
    pub fn to_world(&self) -> &Transform {
        &self.to_world
    }

    /// The distances along the optical axis between which something is seen.
    pub fn clip(&self) -> [f32; 2] {
        [self.near, self.far]
    }

    /// Where the camera stands when the shutter opens, in world coordinates.
    pub fn position(&self) -> Vec3 {
        self.to_world.point(Vec3::ZERO)
    }
}

/// The unit direction in which a camera looks; `None` where there is none.
fn optical_axis(to_world: &Transform) -> Option<Vec3> {
    Vector3::try_normalize(to_world.vector(Vec3::Z))
}

#[cfg(test)]
mod tests;
