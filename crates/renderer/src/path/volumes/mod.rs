//! Paths through surfaces and participating media.

mod airlight;
mod bodies;
mod collision;
mod course;
mod shadow;
mod tentative;
mod travel;

use etendue_brdf::Bsdf;
use etendue_math::Spectrum;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::Color;
use etendue_scene::color::{Channels, Primaries, Wavelengths};
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::{PreparedMaterials, Varying};

use super::transport::{Prepared, Spectral, Transport, Volumes};
use super::{Arrival, Fate, PathTracer, Walk};
use crate::statistics::RayCounts;
use bodies::{Bodies, Crossing};
use course::Course;
use travel::Event;

impl Transport for Volumes {
    const VOLUMES: bool = true;

    type Channels = Primaries;

    fn materials<'r, 'a>(prepared: &'r Prepared<'a>) -> &'r PreparedMaterials<'a> {
        &prepared.rgb
    }

    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        tracer.through_volumes::<Self, S>(camera_ray, points, rays)
    }
}

impl Transport for Spectral {
    const VOLUMES: bool = true;

    type Channels = Wavelengths;

    fn materials<'r, 'a>(prepared: &'r Prepared<'a>) -> &'r PreparedMaterials<'a, Wavelengths> {
        &prepared.spectral
    }

    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R, Wavelengths>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        tracer.through_volumes::<Self, S>(camera_ray, points, rays)
    }
}

impl<R: Rays, C: Channels> PathTracer<'_, '_, R, C> {
    /// An estimate of the radiance that arrives along a ray of the camera.
    ///
    /// ```text
    /// L(x, −ω) = ∫₀^d T(s) σs ∫ p(ω·ω') L(x + sω, −ω') dω' ds + T(d) L(surface at d)
    /// T(s) = exp(−∫₀^s σt)
    /// ```
    ///
    /// The distance to the next collision is drawn in proportion to T σt of one channel; where
    /// channels differ, as if from the mixture of all three; light of single points is looked for near to them as well, by a
    /// [`Beam`](airlight::Beam). Edges count as in Mitsuba 3's `volpath`:
    /// a collision is a vertex, a surface that light passes straight on is none, though it has
    /// random numbers of its own.
    ///
    /// # Source
    /// Chandrasekhar, "Radiative Transfer", 1950; Wilkie et al., "Hero Wavelength Spectral Sampling",
    /// CGF 33(4), 2014, for the mixture over channels.
    #[inline(always)]
    fn through_volumes<T: Transport<Channels = C>, S: Sampler>(
        &self,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let longest = self.longest();
        let channels = C::of_path(|| points.sample_1d(Dimension::camera(Decision::Wavelength)));
        let mut radiance = C::Color::black();
        let mut walk = Walk::from_camera(camera_ray, channels);
        let mut course = Course::in_medium(self.around_camera());
        let mut bodies = Bodies::none(course.medium);
        let mut edges = 1;
        rays.camera += 1;
        // The address of a vertex, which is `edges` where nothing was passed.
        for depth in 1..=u16::MAX {
            if edges > longest {
                break;
            }
            let mut beam = None;
            let event = self.travel(&mut walk, &mut course, &mut beam, depth, points, rays);
            let on_beam = beam
                .as_ref()
                .filter(|_| edges < longest)
                .and_then(|beam| self.light_on_beam(beam, depth, channels, points));
            let throughput;
            let (shadowed, fate) = match event {
                Event::Escape => {
                    radiance += walk.throughput * self.escaped(&walk);
                    throughput = walk.throughput;
                    (None, Fate::Ends)
                }
                Event::Collision(collision) => {
                    throughput = walk.throughput;
                    if edges == longest {
                        break;
                    }
                    let shadowed =
                        self.light_in_medium(&collision, beam.as_ref(), channels, points);
                    (shadowed, self.scatter_in_medium(&collision, edges, &mut walk, points))
                }
                Event::Surface(point) => {
                    let direction = walk.ray.direction;
                    let crossing =
                        if self.nests { self.crossing(&bodies, &point, direction) } else { None };
                    throughput = walk.throughput;
                    if let Some(hidden) = crossing.as_ref().filter(|crossing| crossing.is_hidden) {
                        // Goes on as if there were no surface. Shadow rays end there.
                        course.medium = bodies.cross(hidden);
                        walk.ray = point.spawn(direction);
                        walk.arrival = Arrival::Certain;
                        (None, Fate::Passes)
                    } else {
                        radiance += walk.throughput * self.emitted(&walk, &point);
                        let mut varying = Varying::default();
                        let vertex = match &crossing {
                            Some(Crossing { exterior, .. }) => {
                                self.vertex_within(depth, &point, &walk, *exterior, &mut varying)
                            }
                            None => self.vertex(depth, &point, &walk, &mut varying),
                        };
                        let is_last = edges == longest;
                        // Of the last surface matters only what passes it.
                        if is_last && !vertex.bsdf.lobes().delta
                            || self.is_inconsistent(&vertex, -direction, vertex.wo)
                        {
                            (None, Fate::Ends)
                        } else {
                            let shadowed = if is_last {
                                None
                            } else {
                                self.light_at_surface(&vertex, &course, points)
                            };
                            let fate = self.scatter::<T, S>(&vertex, edges, &mut walk, points);
                            let onwards = walk.ray.direction;
                            course.medium = match crossing {
                                Some(crossing)
                                    if onwards.dot(point.normal) * direction.dot(point.normal)
                                        > 0.0 =>
                                {
                                    bodies.cross(&crossing)
                                }
                                Some(_) => course.medium,
                                None => self.beyond(&point, onwards, course.medium),
                            };
                            (shadowed, fate)
                        }
                    }
                }
            };
            // In one place for all vertices, so that what traces rays is compiled once.
            let shadowed = shadowed.map(|shadowed| (throughput, shadowed));
            for (throughput, shadowed) in [on_beam, shadowed].into_iter().flatten() {
                let share = self.transmittance(&shadowed, depth, points, rays);
                radiance += throughput * (shadowed.light * share);
            }
            match fate {
                Fate::Continues => edges += 1,
                Fate::Passes => {}
                Fate::Ends => break,
            }
            rays.indirect += 1;
        }
        channels.seen(radiance)
    }
}
