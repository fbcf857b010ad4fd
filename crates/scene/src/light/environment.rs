//! Environment maps.

use alloc::vec;
use alloc::vec::Vec;

use etendue_brdf::Density;
use etendue_math::glam::{DMat3, Vec3};
use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::Tabulated2d;

use super::{LightError, LightSample};
use crate::Color;
use crate::geometry::Transform;
use crate::texture::{BitmapImage, Wrap};

/// A picture of all directions, infinitely far away, in latitude and longitude.
///
/// ```text
/// u = atan2(x, −z) / 2π,   v = acos(y) / π
/// ```
///
/// in the map's own frame. Column i has its centre at `u = (i + ½) / W`, and columns go round; row j
/// lies at `v = j / (H − 1)`, so that the first and the last row are the poles. In between, values
/// are interpolated linearly.
///
/// # Sampling
/// Light that is as bright as the mean of the map, or less, is found well by the directions in which surfaces scatter, and with
/// multiple importance sampling light samples are best spent on what is brighter: directions are drawn in proportion to
///
/// ```text
/// max(L − mean L, L / 256)
/// ```
///
/// # Source
/// Mitsuba 3's `envmap`. Its look-up takes the exact south pole for the north pole; this one does
/// not. Karlík, Šik, Vévoda, Skřivan, Křivánek, "MIS Compensation: Optimizing Sampling Techniques in Multiple Importance
/// Sampling", SIGGRAPH Asia 2019, section 5.1.
#[derive(Clone, Debug)]
pub struct EnvironmentLight {
    image: BitmapImage,
    to_world: Transform,
    scale: f32,
    /// Cumulative tables of a density that is constant between neighbouring texel centres; nothing
    /// for a black map.
    tables: Option<Vec<f32>>,
    /// Luminance integrated over the sphere of directions.
    total: f32,
    /// Of it the share for which directions are drawn.
    excess: f32,
}

impl EnvironmentLight {
    /// A light from a map.
    ///
    /// * `to_world`: from the map's frame to the world's.
    /// * `scale`: factor of the map's values.
    ///
    /// # Errors
    /// A scale that is not finite or negative; a transform that distorts directions.
    pub fn new(image: BitmapImage, to_world: Transform, scale: f32) -> Result<Self, LightError> {
        if !(scale >= 0.0 && scale.is_finite()) {
            return Err(LightError::Emission);
        }
        if !keeps_angles(&to_world) {
            return Err(LightError::Transform);
        }
        let [columns, rows] = cells(&image);
        let mut weights = Vec::with_capacity(columns * rows);
        let mut total = 0.0;
        for row in 0..rows {
            let solid_angle = solid_angle(row, [columns, rows]);
            for column in 0..columns {
                let luminance = mean_luminance(&image, column as u32, row as u32);
                total += f64::from(luminance) * solid_angle;
                weights.push(luminance);
            }
        }
        let mean = total / (4.0 * f64::PI);
        let mut excess = 0.0;
        for (row, weights) in weights.chunks_mut(columns).enumerate() {
            let solid_angle = solid_angle(row, [columns, rows]);
            for w in weights {
                let weight = weight(f64::from(*w), mean) * solid_angle;
                excess += weight;
                *w = weight as f32;
            }
        }
        let tables = Tabulated2d::<f32>::storage_len(columns, rows).and_then(|length| {
            let mut storage = vec![0.0; length];
            Tabulated2d::build(&weights, columns, rows, &mut storage).ok()?;
            Some(storage)
        });
        let excess = if total > 0.0 { (excess / total) as f32 } else { 0.0 };
        Ok(Self { image, to_world, scale, tables, total: total as f32 * scale, excess })
    }

    /// The map.
    pub fn image(&self) -> &BitmapImage {
        &self.image
    }

    /// From the map's frame to the world's.
    pub fn to_world(&self) -> &Transform {
        &self.to_world
    }

    /// The factor of the map's values.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    fn distribution(&self) -> Option<Tabulated2d<'_, f32>> {
        let [columns, rows] = cells(&self.image);
        Tabulated2d::from_storage(self.tables.as_ref()?, columns, rows)
    }

    /// Half a column: how far the first texel centre lies from the seam.
    fn half_texel(&self) -> f32 {
        0.5 / self.image.width() as f32
    }

    /// Radiance from a unit direction of the world.
    #[inline]
    pub fn radiance(&self, direction: Vec3) -> Color {
        match self.to_map(direction) {
            Some(Place { uv, .. }) => self.at(uv),
            None => Color::black(),
        }
    }

    #[inline]
    fn at(&self, [u, v]: [f32; 2]) -> Color {
        let x = u * self.image.width() as f32 - 0.5;
        let y = v * (self.image.height() - 1) as f32;
        self.image.bilinear([x, y], [Wrap::Repeat, Wrap::Clamp]) * self.scale
    }

    /// A direction by the brightness of the map.
    ///
    /// ```text
    /// p(ω) = p(u, v) / (2π² sin θ),  p(u, v) ∝ weight(mean luminance of a cell's corners) × its solid angle
    /// ```
    #[inline]
    pub(crate) fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        let ([x, v], pdf) = self.distribution()?.sample(u);
        let place_u = x + self.half_texel();
        let (sin_phi, cos_phi) = Real::sin_cos(2.0 * f32::PI * place_u);
        let (sin_theta, cos_theta) = Real::sin_cos(f32::PI * v);
        let local = Vec3::new(sin_phi * sin_theta, cos_theta, -cos_phi * sin_theta);
        let radiance = self.at([place_u, v]);
        let pdf = solid_angle_density(pdf, sin_theta);
        if radiance.is_black() || pdf == 0.0 {
            return None;
        }
        Some(LightSample {
            direction: Vector3::try_normalize(self.to_world.vector(local))?,
            target: None,
            radiance,
            density: Density::Continuous(pdf),
        })
    }

    /// Radiance from a unit direction of the world, and the density with which `sample` draws it.
    #[inline]
    pub(crate) fn radiance_and_pdf(&self, direction: Vec3) -> (Color, f32) {
        let Some(Place { uv: [u, v], sin_theta }) = self.to_map(direction) else {
            return (Color::black(), 0.0);
        };
        let Some(distribution) = self.distribution() else { return (self.at([u, v]), 0.0) };
        let x = u - self.half_texel();
        let x = Real::min(x - Real::floor(x), f32::ONE_MINUS_EPSILON);
        let pdf = distribution.pdf([x, Real::min(v, f32::ONE_MINUS_EPSILON)]);
        (self.at([u, v]), solid_angle_density(pdf, sin_theta))
    }

    #[inline]
    fn to_map(&self, direction: Vec3) -> Option<Place> {
        let d = Vector3::try_normalize(self.to_world.inverse_vector(direction))?;
        let sin_theta = Real::sqrt(d.x * d.x + d.z * d.z);
        let turn = Real::atan2(d.x, -d.z) * (0.5 * f32::FRAC_1_PI);
        let u = if turn < 0.0 { turn + 1.0 } else { turn };
        // The angle from sine and cosine: near the poles the arc cosine knows half the digits only.
        let v = Real::atan2(sin_theta, d.y) * f32::FRAC_1_PI;
        Some(Place { uv: [u, v], sin_theta })
    }

    /// Share of the light that is brighter than the mean, by as much as it is brighter, in [0, 1].
    pub(crate) fn excess(&self) -> f32 {
        self.excess
    }

    /// Power through a sphere: Φ = π R² ∫ L dω, in W.
    pub(crate) fn power(&self, radius: f32) -> f32 {
        f32::PI * radius * radius * self.total
    }
}

/// Where on the map a direction is.
#[derive(Clone, Copy)]
struct Place {
    uv: [f32; 2],
    sin_theta: f32,
}

/// Columns and rows of cells between neighbouring texel centres.
fn cells(image: &BitmapImage) -> [usize; 2] {
    [image.width() as usize, (image.height() as usize - 1).max(1)]
}

/// Mean luminance of the four texels at the corners of a cell, the integral over the cell of what
/// lies between them: it vanishes only where they all do.
fn mean_luminance(image: &BitmapImage, column: u32, row: u32) -> f32 {
    let right = (column + 1) % image.width();
    let corner = |column, row| image.texel(column, row).luminance();
    0.25 * (corner(column, row)
        + corner(right, row)
        + corner(column, row + 1)
        + corner(right, row + 1))
}

/// Solid angle of a cell of a row: `2π (cos θ₀ − cos θ₁) / columns`.
fn solid_angle(row: usize, [columns, rows]: [usize; 2]) -> f64 {
    let cosine = |row: usize| Real::cos(f64::PI * row as f64 / rows as f64);
    2.0 * f64::PI * (cosine(row) - cosine(row + 1)) / columns as f64
}

/// The share of its luminance for which a cell is drawn whatever the mean. Light samples alone thus find all light.
const FLOOR: f64 = 1.0 / 256.0;

/// What a cell is drawn for, relative to its solid angle.
///
/// ```text
/// max(luminance − mean, luminance / 256)
/// ```
fn weight(luminance: f64, mean: f64) -> f64 {
    (luminance - mean).max(FLOOR * luminance)
}

/// From a density over the unit square of the map to one over the sphere; 0 at the poles.
#[inline]
fn solid_angle_density(pdf: f32, sin_theta: f32) -> f32 {
    let density = pdf / (2.0 * f32::PI * f32::PI * sin_theta);
    if density.is_finite() { density } else { 0.0 }
}

/// Whether a map rotates, mirrors and scales evenly: MᵀM = s² I within the rounding of matrices
/// that were written with seven digits.
fn keeps_angles(transform: &Transform) -> bool {
    let m = transform.affine().matrix3;
    let product = m.transpose() * m;
    let scale = product.x_axis.x;
    let difference = product - DMat3::IDENTITY * scale;
    difference.to_cols_array().iter().all(|x| Real::abs(*x) <= 1e-5 * scale)
}

#[cfg(test)]
mod tests;
