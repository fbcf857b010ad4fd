//! Light that passes media and surfaces on the way from a light.

use etendue_brdf::Bsdf;
use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};
use etendue_sampling::{Decision, Dimension, Pcg32, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::{Side, Varying};
use etendue_scene::medium::{Density, Extinction, Medium};

use super::course::Course;
use super::tentative::tentative;
use crate::path::{PathTracer, Vertex};
use crate::statistics::RayCounts;

/// Light that a vertex would scatter towards the camera if it arrived.
pub(super) struct Shadowed<'s, C: Channels> {
    pub(super) light: C::Color,
    /// From the vertex to the light.
    pub(super) ray: Ray,
    /// Where it ends, of a light that is somewhere.
    pub(super) target: Option<Vec3>,
    /// Where it begins.
    pub(super) medium: Option<&'s Medium>,
    /// Those of the path.
    pub(super) channels: C,
}

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// By one light sample, the light that a surface scatters towards the camera if nothing is in its
    /// way.
    #[inline(always)]
    pub(super) fn light_at_surface<S: Sampler>(
        &self,
        vertex: &Vertex<'_, C>,
        course: &Course<'s>,
        points: &S,
    ) -> Option<Shadowed<'s, C>> {
        let (light, sample) = self.unoccluded_light(vertex, points, 1)?;
        let ray = match sample.target {
            Some(target) => vertex.point.spawn_to(target),
            None => vertex.point.spawn(sample.direction),
        };
        let medium = self.beyond(vertex.point, sample.direction, course.medium);
        let channels = vertex.channels;
        Some(Shadowed { light, ray, target: sample.target, medium, channels })
    }

    /// The share of light that arrives at the vertex with address `depth`, in the mean.
    ///
    /// Light passes surfaces as [`Bsdf::pass_through`] says, which is what scattered rays that keep
    /// their arrival find behind them.
    #[inline(always)]
    pub(super) fn transmittance<S: Sampler>(
        &self,
        shadowed: &Shadowed<'s, C>,
        depth: u16,
        points: &S,
        rays: &mut RayCounts,
    ) -> C::Color {
        let Shadowed { mut ray, target, mut medium, channels, .. } = *shadowed;
        let mut share = C::Color::white();
        let mut numbers = None;
        while !share.is_black() {
            rays.shadow += 1;
            let hit = self.rays.intersect(&ray);
            let surface = hit.map(|hit| {
                let point = self.scene.geometry.surface_point(&ray, &hit);
                let wo = point.shading.to_local(-ray.direction.normalize_or_zero());
                let material = self.scene.surfaces[point.shape.0 as usize].material;
                let mut varying = Varying::default();
                let bsdf =
                    self.materials.at(material, &point, Side::of(wo), channels, &mut varying);
                (point, bsdf.pass_through(wo))
            });
            if let Some((_, passes)) = surface {
                share = share * passes;
                // Before the way there is looked at: most surfaces let nothing pass.
                if share.is_black() {
                    break;
                }
            }
            if let Some(medium) = medium {
                let part = Ray { t_max: hit.map_or(ray.t_max, |hit| hit.t), ..ray };
                share = share
                    * match &medium.extinction {
                        Extinction::Homogeneous(sigma) => {
                            attenuation(medium.extinction_in(*sigma, channels), &part)
                        }
                        Extinction::Heterogeneous(density) => {
                            let numbers = numbers.get_or_insert_with(|| {
                                points.rng(Dimension::vertex(depth, Decision::ShadowTracking))
                            });
                            tracked_ratio(density, channels, &part, numbers)
                        }
                    };
            }
            let Some((point, _)) = surface else { break };
            medium = self.beyond(&point, ray.direction, medium);
            ray = match target {
                Some(target) => point.spawn_to(target),
                None => point.spawn(ray.direction),
            };
        }
        share
    }
}

/// `exp(−σ d)` over the length of a ray.
#[inline]
fn attenuation<L: Spectrum<Real = f32>>(sigma: L, ray: &Ray) -> L {
    let distance = ray.t_max * Vec3::length(ray.direction);
    // A channel without extinction passes infinite distances, too.
    sigma.map(|sigma| if sigma > 0.0 { Real::exp(-sigma * distance) } else { 1.0 })
}

/// What passes along a ray through a medium of varying density, in the mean: the product of
/// `1 − σ/μ` over tentative collisions of density μ.
///
/// Below a tenth the estimate is continued with probability a quarter: what is nearly opaque takes no
/// more steps than what is seen of it.
///
/// # Source
/// Novák, Selle, Jarosz, "Residual Ratio Tracking for Estimating Attenuation in Participating Media",
/// ACM TOG 33(6), 2014, without the residual.
#[inline]
fn tracked_ratio<C: Channels>(
    density: &Density,
    channels: C,
    ray: &Ray,
    numbers: &mut Pcg32,
) -> C::Color {
    const LOW: f32 = 0.1;
    const SURVIVAL: f32 = 0.25;
    let mut ratio = C::Color::white();
    let mut tentative = tentative(numbers, ray, density);
    while let Some((position, majorant)) = tentative.next() {
        let sigma = channels.matter(density.at(position));
        ratio = ratio * sigma.map(|sigma| 1.0 - sigma / majorant);
        if ratio.max_channel() < LOW {
            if tentative.uniform() >= SURVIVAL {
                return C::Color::black();
            }
            ratio = ratio.scale(1.0 / SURVIVAL);
        }
    }
    ratio
}
