//! Radiometric quantities of simple lights, and the measures their samples come in.
//!
//! | quantity | symbol | unit |
//! | --- | --- | --- |
//! | radiant flux | Φ | W |
//! | radiant intensity | I | W sr⁻¹ |
//! | irradiance, radiant exitance | E, M | W m⁻² |
//! | radiance | L | W m⁻² sr⁻¹ |
//!
//! Colours are [`Spectrum`]s, finite and not negative. Functions are total: where a geometric argument lies
//! outside its domain they give 0, and what would overflow is the largest number.
//!
//! # Real-time light colours
//! Shading languages often give a light the "colour" c that a white Lambertian surface facing it shows. That
//! colour is a radiance, `c = E/π`: their diffuse term lacks the π of `ρ/π`, and their specular term must
//! then be multiplied by it. [`irradiance_of_light_color`] and [`light_color_of_irradiance`] convert; a point light of
//! colour c at distance 1 has the intensity `π c`.
//!
//! # Source
//! R. McCluney, Introduction to Radiometry and Photometry, 2nd ed. 2014, chapters 1 and 4; PBRT, 4th
//! ed., sections 4.1 and 12.1 to 12.4. Light colours: N. Hoffman, "Physics and Math of Shading", SIGGRAPH 2013 course.

use etendue_math::{Real, Spectrum};

/// `x` if it is a number at least 0, else 0: what lies on the far side of a surface is not lit.
#[inline(always)]
fn positive<T: Real>(x: T) -> T {
    x.clamp_to(T::ZERO, T::MAX)
}

/// `x / d²` in two steps, so that `d²` neither over- nor underflows. 0 unless d is positive and finite.
#[inline(always)]
fn over_square<T: Real>(x: T, distance: T) -> T {
    if distance > T::ZERO && distance < T::INFINITY {
        ((x / distance) / distance).min(T::MAX)
    } else {
        T::ZERO
    }
}

/// Every channel times `factor`, at most the largest number.
#[inline(always)]
fn scaled<C: Spectrum>(color: C, factor: C::Real) -> C {
    color.map(|c| if c > C::Real::ZERO { (c * factor).min(C::Real::MAX) } else { C::Real::ZERO })
}

/// Irradiance of a surface lit by a point light.
///
/// ```text
/// E = I cos θ / d²
/// ```
///
/// * `intensity`: I towards the surface, W sr⁻¹.
/// * `cos`: cosine between the surface's normal and the direction to the light; 0 below.
/// * `distance`: d, positive and finite.
///
/// # Precision
/// 2 ulp, also where d² itself is outside the range of `f32`.
///
/// # Examples
/// ```
/// use etendue_brdf::radiometry::irradiance_of_point;
/// assert_eq!(irradiance_of_point(8.0_f32, 0.5, 2.0), 1.0);
/// ```
#[inline]
pub fn irradiance_of_point<C: Spectrum>(intensity: C, cos: C::Real, distance: C::Real) -> C {
    let cos = positive(cos);
    intensity.map(|i| over_square(positive(i) * cos, distance))
}

/// Irradiance of the surface that faces a light of real-time colour c: `E = π c`.
#[inline]
pub fn irradiance_of_light_color<C: Spectrum>(color: C) -> C {
    scaled(color, C::Real::PI)
}

/// Real-time colour of a light: the radiance `c = E/π` of a white Lambertian surface facing it.
#[inline]
pub fn light_color_of_irradiance<C: Spectrum>(irradiance: C) -> C {
    scaled(irradiance, C::Real::FRAC_1_PI)
}

/// Solid angle per area of a surface element, and so the factor from a density per solid angle to one per
/// area.
///
/// ```text
/// dω/dA = |cos θ'| / d²
/// ```
///
/// * `cos_light`: cosine between the element's normal and the line of sight; its sign does not matter.
/// * `distance`: d, positive and finite.
///
/// # Examples
/// ```
/// use etendue_brdf::radiometry::{area_pdf, solid_angle_pdf, solid_angle_per_area};
/// let (cos, d) = (0.5_f64, 3.0);
/// // Uniform over 2 m² of light: estimator L cos θ (cos θ'/d²) / (1/2) = L cos θ / p(ω).
/// let p = solid_angle_pdf(0.5, cos, d);
/// assert!((p * solid_angle_per_area(cos, d) - 0.5).abs() < 1e-15);
/// assert!((area_pdf(p, cos, d) - 0.5).abs() < 1e-15);
/// ```
#[inline]
pub fn solid_angle_per_area<T: Real>(cos_light: T, distance: T) -> T {
    over_square(positive(cos_light.abs()), distance)
}

/// Density per area of a point drawn with density `pdf` per solid angle: `p(A) = p(ω) |cos θ'| / d²`.
///
/// Arguments as for [`solid_angle_per_area`].
#[inline]
pub fn area_pdf<T: Real>(pdf: T, cos_light: T, distance: T) -> T {
    over_square(positive(pdf) * positive(cos_light.abs()), distance)
}

/// Density per solid angle of the direction to a point drawn with density `pdf` per area:
/// `p(ω) = p(A) d² / |cos θ'|`.
///
/// Arguments as for [`solid_angle_per_area`]; 0 for an element seen edge on, to which no direction leads.
#[inline]
pub fn solid_angle_pdf<T: Real>(pdf: T, cos_light: T, distance: T) -> T {
    let cos = positive(cos_light.abs());
    if cos > T::ZERO && distance > T::ZERO && distance < T::INFINITY {
        // The quotient in between keeps d² in range where the density makes up for it.
        (distance * (positive(pdf) * distance / cos)).min(T::MAX)
    } else {
        T::ZERO
    }
}

/// Geometry term between two surface elements, symmetric in them.
///
/// ```text
/// G = cos θ cos θ' / d²
/// ```
///
/// 0 where either cosine is not positive: the elements do not face each other.
#[inline]
pub fn geometry_term<T: Real>(cos: T, cos_light: T, distance: T) -> T {
    over_square(positive(cos) * positive(cos_light), distance)
}

/// Flux of an isotropic point light: `Φ = 4π I`.
#[inline]
pub fn flux_of_point<C: Spectrum>(intensity: C) -> C {
    scaled(intensity, C::Real::lit(4.0) * C::Real::PI)
}

/// Intensity of an isotropic point light: `I = Φ / 4π`.
#[inline]
pub fn intensity_of_point<C: Spectrum>(flux: C) -> C {
    scaled(flux, C::Real::lit(0.25) * C::Real::FRAC_1_PI)
}

/// A spot light's cone: full intensity up to the beam's half-angle b, falling to 0 at the cutoff c.
///
/// ```text
/// I(θ)/I₀ = 1 for θ ≤ b,  t² (3 − 2t) with t = (cos θ − cos c)/(cos b − cos c) up to c,  0 beyond
/// Ω = ∫ I/I₀ dω = 2π (½ (1 − cos b) + ½ (1 − cos c))
/// ```
///
/// Cosines are kept as `1 − cos = 2 sin²(θ/2)`, so that narrow beams have all their digits.
///
/// # Source
/// PBRT, 4th ed., section 12.2.1: the smooth step averages ½ over the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotCone<T> {
    beam: T,
    cutoff: T,
}

impl<T: Real> SpotCone<T> {
    /// The cone with half-angles `beam ≤ cutoff` in radians, in `[0, π]`; `None` outside.
    #[inline]
    pub fn new(beam: T, cutoff: T) -> Option<Self> {
        let valid = beam >= T::ZERO && beam <= cutoff && cutoff <= T::PI;
        let versine = |angle: T| T::TWO * (T::HALF * angle).sin().sqr();
        valid.then(|| Self { beam: versine(beam), cutoff: versine(cutoff) })
    }

    /// `I(θ)/I₀` for `1 − cos θ`, in `[0, 1]`; see [`one_minus_cos`] for that number.
    #[inline]
    pub fn falloff(&self, one_minus_cos: T) -> T {
        if one_minus_cos <= self.beam {
            T::ONE
        } else if one_minus_cos < self.cutoff {
            let t = (self.cutoff - one_minus_cos) / (self.cutoff - self.beam);
            t * t * (T::lit(3.0) - T::TWO * t)
        } else {
            T::ZERO
        }
    }

    /// The solid angle Ω that full intensity would fill with the same flux, in sr.
    #[inline]
    pub fn solid_angle(&self) -> T {
        T::PI * (self.beam + self.cutoff)
    }

    /// Flux of the spot light with intensity I₀ on its axis: `Φ = I₀ Ω`.
    #[inline]
    pub fn flux<C: Spectrum<Real = T>>(&self, intensity: C) -> C {
        scaled(intensity, self.solid_angle())
    }

    /// Intensity on the axis of the spot light with flux Φ: `I₀ = Φ / Ω`; 0 for a cone without extent.
    #[inline]
    pub fn intensity<C: Spectrum<Real = T>>(&self, flux: C) -> C {
        let solid_angle = self.solid_angle();
        if solid_angle > T::ZERO {
            flux.map(|f| (positive(f) / solid_angle).min(T::MAX))
        } else {
            C::black()
        }
    }
}

/// `1 − cos θ` between two unit vectors, from their difference: `½ |a − b|²`.
///
/// # Precision
/// Relative to the rounding of the vectors; `1 − a·b` of nearly equal ones is rounding alone.
#[inline]
pub fn one_minus_cos<V: etendue_math::Vector3>(a: V, b: V) -> V::Scalar {
    (V::Scalar::HALF * (a - b).length_squared()).clamp_to(V::Scalar::ZERO, V::Scalar::TWO)
}

/// Radiant exitance of a Lambertian emitter, or irradiance under a uniform sky: `M = π L`.
#[inline]
pub fn exitance_of_radiance<C: Spectrum>(radiance: C) -> C {
    scaled(radiance, C::Real::PI)
}

/// Radiance of a Lambertian emitter with exitance M: `L = M/π`.
#[inline]
pub fn radiance_of_exitance<C: Spectrum>(exitance: C) -> C {
    scaled(exitance, C::Real::FRAC_1_PI)
}

/// Flux of a Lambertian emitter of radiance L on one side of the given area: `Φ = π A L`.
///
/// The area counts as 0 where it is negative or NaN.
#[inline]
pub fn flux_of_area<C: Spectrum>(radiance: C, area: C::Real) -> C {
    scaled(exitance_of_radiance(radiance), positive(area))
}

/// Radiance of a Lambertian emitter of flux Φ on one side of the given area: `L = Φ / (π A)`.
///
/// 0 for an area that is not positive.
#[inline]
pub fn radiance_of_area<C: Spectrum>(flux: C, area: C::Real) -> C {
    if area > C::Real::ZERO {
        flux.map(|f| (positive(f) * C::Real::FRAC_1_PI / area).min(C::Real::MAX))
    } else {
        C::black()
    }
}

/// Intensity of a small Lambertian emitter seen under `cos_light` from its normal: `I = L A cos θ'`.
#[inline]
pub fn intensity_of_area<C: Spectrum>(radiance: C, area: C::Real, cos_light: C::Real) -> C {
    scaled(radiance.scale(positive(area)), positive(cos_light))
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::Rgb;
    use etendue_math::glam::{DVec3, Vec3};
    use etendue_math::quadrature::gauss_legendre;

    #[test]
    fn a_point_light_lights_a_sphere_around_it_with_its_flux() {
        let (intensity, radius) = (3.0_f64, 7.0);
        let received =
            irradiance_of_point(intensity, 1.0, radius) * 4.0 * f64::PI * radius * radius;
        assert!((received / flux_of_point(intensity) - 1.0).abs() < 1e-15);
        assert!((intensity_of_point(flux_of_point(intensity)) / intensity - 1.0).abs() < 1e-15);
    }

    #[test]
    fn far_and_near_lights_stay_in_range() {
        // d² = 1e40 overflows, and 1e-44 has lost its digits, in f32.
        assert!((irradiance_of_point(1e30_f32, 1.0, 1e20) / 1e-10 - 1.0).abs() < 1e-6);
        assert!((irradiance_of_point(1e-30_f32, 1.0, 1e-22) / 1e14 - 1.0).abs() < 1e-6);
        assert!((solid_angle_pdf(1e-30_f32, 1.0, 1e20) / 1e10 - 1.0).abs() < 1e-6);
        assert_eq!(irradiance_of_point(1.0_f32, 1.0, 1e-30), f32::MAX);
    }

    #[test]
    fn a_white_surface_shows_the_colour_of_the_light() {
        let color = Rgb::new(0.5_f64, 1.0, 2.0);
        let shown = irradiance_of_light_color(color).scale(f64::FRAC_1_PI);
        let back = light_color_of_irradiance(irradiance_of_light_color(color));
        for i in 0..3 {
            assert!((shown.channel(i) / color.channel(i) - 1.0).abs() < 1e-15);
            assert!((back.channel(i) / color.channel(i) - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn a_disk_lights_alike_by_area_and_by_solid_angle() {
        // Disk of radius 1 at height h, facing down: E = π L / (1 + h²), a closed form.
        let (height, radiance) = (1.5_f64, 2.0);
        let mut by_area = 0.0;
        for (r, w) in gauss_legendre::<f64, 32>() {
            let distance = (r * r + height * height).sqrt();
            let cos = height / distance;
            by_area += w * 2.0 * f64::PI * r * radiance * geometry_term(cos, cos, distance);
        }
        let exact = exitance_of_radiance(radiance) / (1.0 + height * height);
        // Smooth integrand, 32 nodes.
        assert!((by_area / exact - 1.0).abs() < 1e-12);
        let (cos, distance) = (0.3, 2.5);
        let p = solid_angle_pdf(0.7, cos, distance);
        assert!((area_pdf(p, -cos, distance) / 0.7 - 1.0).abs() < 1e-15);
        assert!((p * solid_angle_per_area(cos, distance) / 0.7 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_spot_light_emits_the_integral_of_its_falloff() {
        for (beam, cutoff) in [(0.2_f64, 0.5), (0.0, 1.0), (0.7, 0.7), (1.0, 3.0)] {
            let cone = SpotCone::new(beam, cutoff).unwrap();
            let (b, c) = (1.0 - Real::cos(beam), 1.0 - Real::cos(cutoff));
            let ramp: f64 = gauss_legendre::<f64, 8>()
                .iter()
                .map(|&(t, w)| w * cone.falloff(b + (c - b) * t) * (c - b))
                .sum();
            let want = 2.0 * f64::PI * (b + ramp);
            // A cubic: exact but for rounding.
            assert!((cone.solid_angle() - want).abs() < 1e-13 * want, "{beam} {cutoff}");
            assert!((cone.intensity(cone.flux(5.0)) / 5.0 - 1.0).abs() < 1e-15);
        }
        let sphere = SpotCone::new(f64::PI, f64::PI).unwrap();
        assert!((sphere.flux(1.0) / flux_of_point(1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn narrow_beams_keep_their_digits() {
        let cone = SpotCone::new(1e-5_f32, 1e-4).unwrap();
        let want = 0.5 * f64::PI * (1e-10 + 1e-8);
        assert!((f64::from(cone.solid_angle()) / want - 1.0).abs() < 1e-6);
        let off = Vec3::new(5e-5, 0.0, 1.0).normalize();
        let falloff = cone.falloff(one_minus_cos(Vec3::Z, off));
        assert!(falloff > 0.5 && falloff < 0.95, "{falloff}");
        assert!((one_minus_cos(DVec3::Z, -DVec3::Z) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn a_small_panel_is_a_point_light_from_afar() {
        let (radiance, area) = (4.0_f64, 0.25);
        let flux = flux_of_area(radiance, area);
        // ∫ I cos-lobe dω over the hemisphere = π I(0).
        assert!((flux / (f64::PI * intensity_of_area(radiance, area, 1.0)) - 1.0).abs() < 1e-15);
        assert!((radiance_of_area(flux, area) / radiance - 1.0).abs() < 1e-15);
        assert!(
            (radiance_of_exitance(exitance_of_radiance(radiance)) / radiance - 1.0).abs() < 1e-15
        );
    }

    #[test]
    fn nothing_outside_the_domain_is_a_number_to_count_with() {
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            assert_eq!(irradiance_of_point(1.0, 1.0, bad), 0.0);
            assert_eq!(solid_angle_pdf(1.0, 1.0, bad), 0.0);
            assert_eq!(solid_angle_per_area(1.0, bad), 0.0);
        }
        assert_eq!(irradiance_of_point(1.0, f64::NAN, 1.0), 0.0);
        assert_eq!(irradiance_of_point(f64::NAN, 1.0, 1.0), 0.0);
        assert_eq!(geometry_term(-0.5_f32, 0.5, 1.0), 0.0);
        assert_eq!(solid_angle_pdf(1.0_f32, 0.0, 1.0), 0.0);
        assert_eq!(flux_of_area(1.0_f32, -1.0), 0.0);
        assert_eq!(radiance_of_area(1.0_f32, 0.0), 0.0);
        assert_eq!(SpotCone::new(0.6_f32, 0.5), None);
        assert_eq!(SpotCone::new(f32::NAN, 0.5), None);
        assert_eq!(SpotCone::new(0.0_f32, 0.0).unwrap().intensity(1.0_f32), 0.0);
    }
}
