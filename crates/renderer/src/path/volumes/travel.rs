//! On to the next surface or collision.

use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};
use etendue_sampling::{Decision, Dimension, Pcg32, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Ray, Rays, SurfacePoint};
use etendue_scene::medium::{Density, Extinction, Medium};

use super::airlight::Beam;
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

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// Goes to the next vertex, whose address is `depth`, and weighs how it got there.
    ///
    /// `beam` becomes what is passed on the way, if there is to be looked for light of single points on it.
    ///
    /// Rays are traced in one place: this is compiled into the loop over vertices, unlike what is done
    /// beside.
    #[inline(always)]
    pub(super) fn travel<S: Sampler>(
        &self,
        walk: &mut Walk<C>,
        course: &mut Course<'s>,
        beam: &mut Option<Beam<'s, C>>,
        depth: u16,
        points: &S,
        rays: &mut RayCounts,
    ) -> Event<'s> {
        // Left over from one medium to the next where an emitter is looked through.
        let mut thickness = None;
        let mut numbers = None;
        loop {
            let extinction = course.medium.map(|medium| (medium, &medium.extinction));
            let flight = match extinction {
                Some((medium, &Extinction::Homogeneous(sigma))) => {
                    let thickness = *thickness.get_or_insert_with(|| {
                        let decision = Dimension::vertex(depth, Decision::Distance);
                        optical_thickness(points.sample_1d(decision))
                    });
                    let sigma = medium.extinction_in(sigma, walk.channels);
                    let leading = || course.leading::<C, S>(points);
                    Some(Flight::new(sigma, thickness, &walk.ray, leading))
                }
                Some((_, Extinction::Heterogeneous(_))) | None => None,
            };
            let t = flight.as_ref().map_or(f32::INFINITY, |flight| flight.t);
            let lit =
                course.medium.filter(|medium| flight.is_some() && self.has_beams(medium, walk));
            let reach = if lit.is_some() { f32::INFINITY } else { t };
            let hit = self.rays.intersect(&Ray { t_max: reach.min(walk.ray.t_max), ..walk.ray });
            let end = hit.map_or(walk.ray.t_max, |hit| hit.t);
            if let (Some(medium), Some(flight)) = (lit, &flight) {
                *beam = Beam::new(medium, flight.sigma, walk, end);
            }
            let collision = match (flight, extinction) {
                (Some(flight), _) => {
                    let collides = t < end;
                    let factor = flight.factor(collides, end, walk);
                    walk.throughput = walk.throughput * factor;
                    thickness = Some(flight.left(end));
                    collides.then(|| walk.ray.at(t))
                }
                (None, Some((_, Extinction::Heterogeneous(density)))) => {
                    let numbers = numbers.get_or_insert_with(|| {
                        points.rng(Dimension::vertex(depth, Decision::Tracking))
                    });
                    let part = Ray { t_max: end, ..walk.ray };
                    let leading = || course.leading::<C, S>(points);
                    let (position, factor) = track(density, &part, numbers, walk, leading);
                    walk.throughput = walk.throughput * factor;
                    position
                }
                (None, _) => None,
            };
            if let (Some(position), Some(medium)) = (collision, course.medium) {
                walk.throughput = walk.throughput * medium.albedo_at(position, walk.channels);
                let along = walk.ray.direction.normalize_or_zero();
                return Event::Collision(Collision { medium, position, along, depth });
            }
            let Some(hit) = hit else { return Event::Escape };
            let point = self.scene.geometry.surface_point(&walk.ray, &hit);
            if !(self.hides_emitters(walk) && self.is_emitter(&point)) {
                return Event::Surface(point);
            }
            walk.look_through(&hit, &point, rays);
            course.medium = self.beyond(&point, walk.ray.direction, course.medium);
        }
    }
}

/// A way through a homogeneous medium, until its optical thickness by one channel is used up.
///
/// ```text
/// s = −ln(1 − u) / σ of that channel
/// density of a collision σ exp(−σ s), of passing exp(−σ d)
/// ```
struct Flight<L> {
    sigma: L,
    /// That of the channel.
    own: f32,
    thickness: f32,
    /// Length of the ray's direction.
    speed: f32,
    /// Where the collision is, as a parameter of the ray.
    t: f32,
}

impl<L: Spectrum<Real = f32>> Flight<L> {
    #[inline(always)]
    fn new(sigma: L, thickness: f32, ray: &Ray, leading: impl FnOnce() -> usize) -> Self {
        let own = sigma.channel(if is_grey(sigma) { 0 } else { leading() });
        let speed = ray.direction.length();
        // Infinite in a channel without extinction, also for a thickness of 0.
        let t = if own > 0.0 { thickness / (own * speed) } else { f32::INFINITY };
        Self { sigma, own, thickness, speed, t }
    }

    /// The factor of the throughput for a collision, or for passing as far as `end`.
    ///
    /// The extinction of the channel is taken off all exponents, so that none overflows and not all
    /// vanish.
    #[inline]
    fn factor<C: Channels<Color = L>>(&self, collides: bool, end: f32, walk: &mut Walk<C>) -> L {
        if is_grey(self.sigma) {
            return L::white();
        }
        let distance = self.speed * if collides { self.t } else { end };
        let own = self.own;
        let passing = self.sigma.map(|sigma| {
            // Equal ones differ by 0, also over an infinite distance.
            if sigma == own { 1.0 } else { Real::exp((own - sigma) * distance) }
        });
        let densities = if collides { self.sigma * passing } else { passing };
        densities.scale(walk.weigh(densities))
    }

    /// The optical thickness that is left at `end`.
    #[inline]
    fn left(&self, end: f32) -> f32 {
        if self.own > 0.0 {
            (self.thickness - self.own * self.speed * end).max(0.0)
        } else {
            self.thickness
        }
    }
}

/// Through a medium of varying density to the end of a ray: tentative collisions as dense as a bound,
/// each of which is one with the share that the density has of it. The place of the collision, and
/// the factor of the throughput.
///
/// # Source
/// Woodcock et al., "Techniques Used in the GEM Code for Monte Carlo Neutronics Calculations in
/// Reactors and Other Systems of Complex Geometry", ANL-7050, 1965.
#[inline]
fn track<C: Channels>(
    density: &Density,
    ray: &Ray,
    numbers: &mut Pcg32,
    walk: &mut Walk<C>,
    leading: impl FnOnce() -> usize,
) -> (Option<Vec3>, C::Color) {
    let leading = if density.is_coloured() { leading() } else { 0 };
    let mut factor = C::Color::white();
    let mut tentative = tentative(numbers, ray, density);
    while let Some((position, majorant)) = tentative.next() {
        let sigma = walk.channels.matter(density.at(position));
        let is_real = tentative.uniform() * majorant < sigma.channel(leading);
        if !is_grey(sigma) {
            let densities = if is_real { sigma } else { C::Color::splat(majorant) - sigma };
            factor = factor * densities.scale(walk.weigh(densities));
        }
        if is_real {
            return (Some(position), factor);
        }
    }
    (None, factor)
}

/// Whether a medium takes the same of every channel.
#[inline]
fn is_grey<L: Spectrum<Real = f32>>(sigma: L) -> bool {
    (1..L::CHANNELS).all(|i| sigma.channel(i) == sigma.channel(0))
}
