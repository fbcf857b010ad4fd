//! On to the next surface or collision.

use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};
use etendue_sampling::{Decision, Dimension, Pcg32, Sampler};
use etendue_scene::Color;
use etendue_scene::geometry::{Hit, Ray, Rays, SurfacePoint};
use etendue_scene::medium::{Density, Extinction, Medium};

use super::course::Course;
use super::tentative::{optical_thickness, tentative};
use crate::path::{PathTracer, Walk};
use crate::statistics::RayCounts;

/// What a path meets next.
pub(super) enum Event<'s> {
    /// A surface.
    Surface(SurfacePoint),
    /// A particle of a medium.
    Collision(Collision<'s>),
    /// Nothing: it leaves the scene.
    Escape,
}

/// A point where a medium scatters.
pub(super) struct Collision<'s> {
    pub(super) medium: &'s Medium,
    pub(super) position: Vec3,
    /// Unit direction of travel.
    pub(super) along: Vec3,
    /// Address of the vertex.
    pub(super) depth: u16,
}

/// How far a path gets in one medium.
enum Reach {
    /// To the surface, or to the end of the ray.
    Through(Option<Hit>),
    /// To a particle.
    Collision(Vec3),
}

impl<'s, R: Rays> PathTracer<'_, 's, R> {
    /// Goes to the next vertex, whose address is `depth`, and weighs how it got there.
    #[inline(always)]
    pub(super) fn travel<S: Sampler>(
        &self,
        walk: &mut Walk,
        course: &mut Course<'s>,
        depth: u16,
        points: &S,
        rays: &mut RayCounts,
    ) -> Event<'s> {
        // Left over from one medium to the next where an emitter is looked through.
        let mut thickness = None;
        let mut numbers = None;
        loop {
            let reach = match course.medium {
                None => Reach::Through(self.rays.intersect(&walk.ray)),
                Some(medium) => match &medium.extinction {
                    Extinction::Homogeneous(sigma) => {
                        let thickness = thickness.get_or_insert_with(|| {
                            let decision = Dimension::vertex(depth, Decision::Distance);
                            optical_thickness(points.sample_1d(decision))
                        });
                        self.fly(walk, course, points, *sigma, thickness)
                    }
                    Extinction::Heterogeneous(density) => {
                        let numbers = numbers.get_or_insert_with(|| {
                            points.rng(Dimension::vertex(depth, Decision::Tracking))
                        });
                        self.track(walk, course, points, density, numbers)
                    }
                },
            };
            let hit = match (reach, course.medium) {
                (Reach::Collision(position), Some(medium)) => {
                    walk.throughput = walk.throughput * medium.albedo_at(position);
                    let along = walk.ray.direction.normalize_or_zero();
                    return Event::Collision(Collision { medium, position, along, depth });
                }
                (Reach::Through(Some(hit)), _) => hit,
                _ => return Event::Escape,
            };
            let point = self.scene.geometry.surface_point(&walk.ray, &hit);
            if !(self.hides_emitters(walk) && self.is_emitter(&point)) {
                return Event::Surface(point);
            }
            self.look_through(walk, &hit, &point, rays);
            course.cross(self.scene, &point, walk.ray.direction);
        }
    }

    /// Through a homogeneous medium until its optical thickness, by the channel of the path, is used
    /// up.
    ///
    /// ```text
    /// s = −ln(1 − u) / σ of that channel
    /// density of a collision σ exp(−σ s), of passing exp(−σ d)
    /// ```
    ///
    /// The extinction of that channel is taken off all exponents, so that none overflows and not all
    /// vanish.
    #[inline]
    fn fly<S: Sampler>(
        &self,
        walk: &mut Walk,
        course: &mut Course<'s>,
        points: &S,
        sigma: Color,
        thickness: &mut f32,
    ) -> Reach {
        let is_grey = is_grey(sigma);
        let own = if is_grey { sigma.r } else { sigma.channel(course.channel(points)) };
        let speed = walk.ray.direction.length();
        // Infinite in a channel without extinction, also for a thickness of 0.
        let t = if own > 0.0 { *thickness / (own * speed) } else { f32::INFINITY };
        let hit = self.rays.intersect(&Ray { t_max: t.min(walk.ray.t_max), ..walk.ray });
        let relative = |distance: f32| {
            sigma.map(|sigma| if sigma == own { 1.0 } else { Real::exp((own - sigma) * distance) })
        };
        if hit.is_none() && t < walk.ray.t_max {
            if !is_grey {
                let densities = sigma * relative(t * speed);
                walk.throughput = walk.throughput * course.reweigh(densities);
            }
            return Reach::Collision(walk.ray.at(t));
        }
        let distance = hit.map_or(walk.ray.t_max, |hit| hit.t) * speed;
        if own > 0.0 {
            *thickness = (*thickness - own * distance).max(0.0);
        }
        if !is_grey {
            walk.throughput = walk.throughput * course.reweigh(relative(distance));
        }
        Reach::Through(hit)
    }

    /// Through a medium of varying density: tentative collisions as dense as a bound, each of which
    /// is one with the share that the density has of it.
    ///
    /// # Source
    /// Woodcock et al., "Techniques Used in the GEM Code for Monte Carlo Neutronics Calculations in
    /// Reactors and Other Systems of Complex Geometry", ANL-7050, 1965.
    #[inline]
    fn track<S: Sampler>(
        &self,
        walk: &mut Walk,
        course: &mut Course<'s>,
        points: &S,
        density: &Density,
        numbers: &mut Pcg32,
    ) -> Reach {
        let hit = self.rays.intersect(&walk.ray);
        let ray = Ray { t_max: hit.map_or(walk.ray.t_max, |hit| hit.t), ..walk.ray };
        let channel = if density.is_coloured() { course.channel(points) } else { 0 };
        let mut tentative = tentative(numbers, &ray, density);
        while let Some((position, majorant)) = tentative.next() {
            let sigma = density.at(position);
            let is_real = tentative.uniform() * majorant < sigma.channel(channel);
            if !is_grey(sigma) {
                let densities = if is_real { sigma } else { Color::splat(majorant) - sigma };
                walk.throughput = walk.throughput * course.reweigh(densities);
            }
            if is_real {
                return Reach::Collision(position);
            }
        }
        Reach::Through(hit)
    }
}

/// Whether a medium takes the same of every channel.
#[inline]
pub(super) fn is_grey(sigma: Color) -> bool {
    sigma.r == sigma.g && sigma.g == sigma.b
}
