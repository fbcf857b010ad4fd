//! Surfaces that are shaded as if their normal were another.

use etendue_brdf::{Bsdf, Density, Sample};
use etendue_math::glam::Vec3;
use etendue_math::{Frame, Real, Spectrum, Vector3};

/// A normal in the local shading frame in place of `+z`, and how the light that disagrees is treated.
///
/// ```text
/// f'(wo, wi) |cos wi| = f(wo', wi') |cos wi'| G(wi)   where wi and wi' lie on the same side, else 0
/// wo', wi': the directions in the frame around the normal whose first axis lies along x
/// ```
///
/// * Energy: what leaves to the wrong side of the surface is lost; G ≤ 1 takes away more.
/// * Reciprocal only where the surface is not perturbed.
///
/// # Source
/// Mitsuba 3 (3.9.1), `normalmap` and `bumpmap`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Perturbed {
    /// Of any length; a normal that is zero or not finite is `+z`.
    pub(super) normal: Vec3,
    pub(super) options: Perturbation,
}

/// What is done where the perturbed normal and the surface disagree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Perturbation {
    /// Whether a normal that faces away from the viewer is turned about the surface's own until it does not.
    ///
    /// # Source
    /// V. Schüssler, E. Heitz, J. Hanika, C. Dachsbacher, "Microfacet-based Normal Mapping for Robust Monte Carlo Path
    /// Tracing", SIGGRAPH Asia 2017.
    pub flip_invalid_normals: bool,
    /// Whether light fades out towards the horizon of the surface as behind bumps of the same slope.
    ///
    /// # Source
    /// A. Conty Estevez, P. Lecocq, C. Stein, "A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem",
    /// Ray Tracing Gems, 2019.
    pub use_shadowing_function: bool,
}

impl Default for Perturbation {
    fn default() -> Self {
        Self { flip_invalid_normals: true, use_shadowing_function: true }
    }
}

impl Perturbed {
    /// Whether the normal, turned where that is asked for, lies on the viewer's side whatever the viewer.
    pub(super) fn faces_every_viewer(&self) -> bool {
        self.options.flip_invalid_normals && self.normal.z > 0.0
    }

    /// The frame that a viewer sees.
    pub(super) fn seen(&self, wo: Vec3) -> Seen {
        let Self { normal: n, options } = *self;
        let n = if options.flip_invalid_normals && wo.z * wo.dot(n) <= 0.0 {
            Vec3::new(-n.x, -n.y, n.z)
        } else {
            n
        };
        let n = Vector3::try_normalize(n).unwrap_or(Vec3::Z);
        // α² = min(tan² θ / 8, 1) of the angle between the normals.
        let squared = n.x * n.x + n.y * n.y;
        let alpha2 = if options.use_shadowing_function {
            (squared / (8.0 * n.z * n.z).max(f32::MIN_POSITIVE)).min(1.0)
        } else {
            0.0
        };
        let frame = Frame::from_normal_and_tangent(n, Vec3::X);
        Seen { frame, wo, alpha2 }
    }
}

/// A perturbed frame as one viewer sees it.
pub(super) struct Seen {
    /// In the surface's own.
    frame: Frame<f32>,
    wo: Vec3,
    /// Of the bumps that cast shadows.
    alpha2: f32,
}

impl Seen {
    /// The direction of the viewer in the perturbed frame.
    pub(super) fn wo(&self) -> Vec3 {
        self.frame.to_local(self.wo)
    }

    /// What remains of light from `wi`, over `|cos wi|`.
    ///
    /// ```text
    /// G = 2 / (1 + √(1 + α² tan²))     G / |cos| = 2 / (|cos| + √(cos² + α² sin²))
    /// ```
    ///
    /// The right one has no quotient that grows without bound but for α = 0.
    fn shadowing_over_cosine(&self, wi: Vec3) -> f32 {
        let (cos2, sin2) = (wi.z * wi.z, wi.x * wi.x + wi.y * wi.y);
        2.0 / (wi.z.abs() + Real::sqrt(cos2 + self.alpha2 * sin2))
    }

    /// Value and density of the nested model, `part`, seen from here.
    pub(super) fn eval_pdf<S: Spectrum<Real = f32>>(
        &self,
        part: &impl Bsdf<Color = S>,
        wi: Vec3,
    ) -> (S, f32) {
        let inner = self.frame.to_local(wi);
        if !same_side(wi, inner) {
            return (S::black(), 0.0);
        }
        let (f, pdf) = part.eval_pdf(self.wo(), inner);
        let scale = inner.z.abs() * self.shadowing_over_cosine(wi);
        (f.map(|x| (x * scale).min(f32::MAX)), pdf)
    }

    /// A direction of the nested model, `part`, in the frame of the surface; `None` where it leaves to the wrong side.
    pub(super) fn sample<S: Spectrum<Real = f32>>(
        &self,
        part: &impl Bsdf<Color = S>,
        u_lobe: f32,
        u: [f32; 2],
    ) -> Option<Sample<S>> {
        let wo = self.wo();
        let sample = part.sample(wo, u_lobe, u)?;
        // What passes straight goes on exactly, not to a rounding of two frames.
        let is_straight = matches!(sample.density, Density::Delta(_)) && sample.wi == -wo;
        let wi = if is_straight { -self.wo } else { self.frame.to_world(sample.wi) };
        if !same_side(wi, sample.wi) {
            return None;
        }
        let shadowing = self.shadowing_over_cosine(wi) * wi.z.abs();
        Some(Sample { wi, weight: sample.weight.scale(shadowing), ..sample })
    }
}

/// Whether a direction lies on the same side of the surface and of the perturbed one.
fn same_side(wi: Vec3, inner: Vec3) -> bool {
    (wi.z > 0.0 && inner.z > 0.0) || (wi.z < 0.0 && inner.z < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;
    use etendue_brdf::{Lambert, Null, Reflectance};

    const WO: Vec3 = Vec3::new(0.6, 0.0, 0.8);

    fn perturbed(normal: Vec3, flip: bool, shadow: bool) -> Perturbed {
        let options = Perturbation { flip_invalid_normals: flip, use_shadowing_function: shadow };
        Perturbed { normal, options }
    }

    fn white() -> Lambert<Color> {
        Lambert::new(Reflectance::white())
    }

    /// Directions all over the sphere.
    fn directions() -> impl Iterator<Item = Vec3> {
        (0..400_u16).map(|i| {
            let z = 1.0 - (f32::from(i) + 0.5) / 200.0;
            let (sin, cos) = Real::sin_cos(f32::from(i) * 2.399_963);
            Vec3::new(Real::sqrt(1.0 - z * z) * cos, Real::sqrt(1.0 - z * z) * sin, z)
        })
    }

    #[test]
    fn values_are_those_of_mitsuba() {
        // mi.load_dict({'type': 'normalmap', …}).eval_pdf of a white diffuse, 3.9.1, over |cos wi|.
        let wi = Vec3::new(-0.48, 0.6, 0.64);
        let normal = Vec3::new(0.5, -0.25, 0.75);
        let grazing = Vec3::new(-0.95, 0.0, 0.312_25);
        for (wo, flip, shadow, value, pdf) in [
            (WO, true, true, 0.029_895_6, 0.030_625_9),
            (WO, false, false, 0.030_625_9, 0.030_625_9),
            // From here the normal faces away.
            (grazing, true, true, 0.288_990_8, 0.296_050_2),
            (grazing, true, false, 0.296_050_2, 0.296_050_2),
            (grazing, false, true, 0.0, 0.0),
        ] {
            let seen = perturbed(normal, flip, shadow).seen(wo);
            let (f, density) = seen.eval_pdf(&white(), wi);
            // A dozen roundings of numbers of order 1.
            assert!((f.r * wi.z - value).abs() < 1e-6, "{} {value}", f.r * wi.z);
            assert!((density - pdf).abs() < 1e-6, "{density} {pdf}");
        }
    }

    #[test]
    fn no_light_leaks_through_the_surface_whatever_the_normal() {
        let normals =
            [Vec3::new(3.0, 0.0, 1.0), Vec3::new(-2.0, 1.0, 0.3), Vec3::new(0.0, 9.0, 0.1)];
        for normal in normals {
            let seen = perturbed(normal, true, false).seen(WO);
            assert!(seen.wo().z > 0.0, "the normal faces the viewer");
            for wi in directions() {
                let (f, pdf) = seen.eval_pdf(&white(), wi);
                let lit = wi.z > 0.0 && seen.frame.to_local(wi).z > 0.0;
                assert_eq!((f.r > 0.0, pdf > 0.0), (lit, lit), "{normal} {wi}");
                // What is drawn stays above the surface, too.
                let u = [0.5 + 0.5 * wi.x, 0.5 + 0.499 * wi.y];
                assert!(seen.sample(&white(), 0.5, u).is_none_or(|s| s.wi.z > 0.0));
            }
        }
    }

    #[test]
    fn samples_have_the_weight_and_density_of_what_is_evaluated() {
        let seen = perturbed(Vec3::new(0.4, 0.3, 0.8), true, true).seen(WO);
        for i in 0..64_u16 {
            let u = [(f32::from(i) + 0.5) / 64.0, (f32::from(i) * 0.618).fract()];
            let Some(sample) = seen.sample(&white(), 0.5, u) else { continue };
            let Density::Continuous(density) = sample.density else { panic!("{sample:?}") };
            let (f, pdf) = seen.eval_pdf(&white(), sample.wi);
            let weight = f.r * sample.wi.z / pdf;
            // The rounding of a direction, some 1e-7, over a cosine that is rarely below 1e-2.
            assert!((density - pdf).abs() <= 1e-5 && (sample.weight.r - weight).abs() <= 1e-4);
        }
    }

    #[test]
    fn without_a_usable_normal_nothing_is_perturbed_and_what_passes_goes_straight_on() {
        for normal in [Vec3::ZERO, Vec3::NAN, Vec3::Z * 7.0] {
            let seen = perturbed(normal, true, true).seen(WO);
            let wi = Vec3::new(0.0, 0.6, 0.8);
            assert_eq!(seen.wo(), WO);
            let (f, pdf) = seen.eval_pdf(&white(), wi);
            let (g, density) = white().eval_pdf(WO, wi);
            // |cos|/|cos| in another order.
            assert!((f.r - g.r).abs() <= 2.0 * f32::EPSILON && pdf == density);
        }
        let seen = perturbed(Vec3::new(0.3, 0.4, 0.9), true, true).seen(WO);
        let through = seen.sample(&Null::<Color>::new(), 0.5, [0.5; 2]).expect("it passes");
        assert_eq!(through.wi, -WO);
    }
}
