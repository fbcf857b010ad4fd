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
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::Varying;

use super::scatter::Departure;
use super::transport::{Carried, Transport, Volumes};
use super::{Arrival, Fate, PathTracer, Walk};
use crate::statistics::RayCounts;
use bodies::Bodies;
use course::Course;
use travel::Event;

impl<C: Carried> Transport for Volumes<C> {
    const VOLUMES: bool = true;

    type Channels = C;

    /// ```text
    /// L(x, −ω) = ∫₀^d T(s) σs ∫ p(ω·ω') L(x + sω, −ω') dω' ds + T(d) L(surface at d)
    /// T(s) = exp(−∫₀^s σt)
    /// ```
    ///
    /// The distance to the next collision is drawn in proportion to T σt of one channel; where
    /// channels differ, as if from the mixture of all; light of single points is looked for near to them as well, by a
    /// [`Beam`](airlight::Beam). Edges count as in Mitsuba 3's `volpath`:
    /// a collision is a vertex, a surface that light passes straight on is none, though it has
    /// random numbers of its own.
    ///
    /// # Source
    /// Chandrasekhar, "Radiative Transfer", 1950; Wilkie et al., "Hero Wavelength Spectral Sampling",
    /// CGF 33(4), 2014, for the mixture over channels.
    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R, C>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let longest = tracer.longest();
        let channels = C::of_path(|| points.sample_1d(Dimension::camera(Decision::Wavelength)));
        let mut radiance = C::Color::black();
        let mut walk = Walk::from_camera(camera_ray, channels);
        let mut course = Course::in_medium(tracer.around_camera());
        let mut bodies = Bodies::none(course.medium);
        let mut edges = 1;
        rays.camera += 1;
        // The address of a vertex, which is `edges` where nothing was passed; none where paths have no edge.
        for depth in 1..=longest.min(1) * u16::MAX {
            if edges > longest {
                rays.cut(walk.throughput.max_channel());
                break;
            }
            let mut beam = None;
            let event = tracer.travel(&mut walk, &mut course, &mut beam, depth, points, rays);
            let on_beam = beam
                .as_ref()
                .filter(|_| edges < longest)
                .and_then(|beam| tracer.light_on_beam(beam, depth, channels, points));
            let throughput;
            let (shadowed, fate) = match event {
                Event::Escape => {
                    radiance += walk.throughput * tracer.escaped(&walk);
                    throughput = walk.throughput;
                    (None, Fate::Ends)
                }
                Event::Collision(collision) => {
                    throughput = walk.throughput;
                    if edges == longest {
                        rays.cut(throughput.max_channel());
                        break;
                    }
                    let shadowed =
                        tracer.light_in_medium(&collision, beam.as_ref(), channels, points);
                    (shadowed, tracer.scatter_in_medium(&collision, edges, &mut walk, points))
                }
                Event::Surface(point) => {
                    let direction = walk.ray.direction;
                    let crossing = if tracer.nests {
                        tracer.crossing(&bodies, &point, direction)
                    } else {
                        None
                    };
                    throughput = walk.throughput;
                    if let Some(hidden) = crossing.as_ref().filter(|crossing| crossing.is_hidden) {
                        // Goes on as if there were no surface. Shadow rays end there.
                        course.medium = bodies.cross(hidden);
                        walk.ray = point.spawn(direction);
                        walk.arrival = Arrival::Certain;
                        (None, Fate::Passes)
                    } else {
                        radiance += walk.throughput * tracer.emitted(&walk, &point);
                        let mut varying = Varying::default();
                        let exterior = crossing.as_ref().map(|crossing| crossing.exterior);
                        let vertex = tracer.vertex(depth, &point, &walk, exterior, &mut varying);
                        // Of the last surface matters only what passes it.
                        if tracer.is_inconsistent(&vertex, -direction, vertex.wo) {
                            (None, Fate::Ends)
                        } else if edges == longest && !vertex.bsdf.lobes().delta {
                            rays.cut(throughput.max_channel());
                            (None, Fate::Ends)
                        } else {
                            let shadowed = if edges == longest {
                                None
                            } else {
                                tracer.light_at_surface(&vertex, &course, points)
                            };
                            let fate = tracer.scatter::<Self, S>(
                                &vertex,
                                Departure::after(edges),
                                &mut walk,
                                points,
                            );
                            let onwards = walk.ray.direction;
                            course.medium = match crossing {
                                Some(crossing)
                                    if onwards.dot(point.normal) * direction.dot(point.normal)
                                        > 0.0 =>
                                {
                                    bodies.cross(&crossing)
                                }
                                Some(_) => course.medium,
                                None => tracer.beyond(&point, onwards, course.medium),
                            };
                            (shadowed, fate)
                        }
                    }
                }
            };
            // In one place for all vertices, so that what traces rays is compiled once.
            let shadowed = shadowed.map(|shadowed| (throughput, shadowed));
            for (throughput, shadowed) in [on_beam, shadowed].into_iter().flatten() {
                let share = tracer.transmittance(&shadowed, depth, points, rays);
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
