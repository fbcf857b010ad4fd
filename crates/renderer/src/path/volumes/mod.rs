//! Paths through surfaces and participating media.

mod collision;
mod course;
mod shadow;
mod tentative;
mod travel;

use etendue_brdf::Bsdf;
use etendue_math::Spectrum;
use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::Varying;

use super::transport::{Transport, Volumes};
use super::{Fate, PathTracer, Walk};
use crate::statistics::RayCounts;
use course::Course;
use travel::Event;

impl Transport for Volumes {
    const VOLUMES: bool = true;

    /// ```text
    /// L(x, −ω) = ∫₀^d T(s) σs ∫ p(ω·ω') L(x + sω, −ω') dω' ds + T(d) L(surface at d)
    /// T(s) = exp(−∫₀^s σt)
    /// ```
    ///
    /// The distance to the next collision is drawn in proportion to T σt of one channel; where
    /// channels differ, as if from the mixture of all three. Edges count as in Mitsuba 3's `volpath`:
    /// a collision is a vertex, a surface that light passes straight on is none, though it has
    /// random numbers of its own.
    ///
    /// # Source
    /// Chandrasekhar, "Radiative Transfer", 1950; Wilkie et al., "Hero Wavelength Spectral Sampling",
    /// CGF 33(4), 2014, for the mixture over channels.
    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let longest = tracer.longest();
        let mut radiance = Color::black();
        let mut walk = Walk::from_camera(camera_ray);
        let mut course = Course::from_camera(tracer.scene);
        let mut edges = 1;
        rays.camera += 1;
        // The address of a vertex, which is `edges` where nothing was passed.
        for depth in 1..=u16::MAX {
            if edges > longest {
                break;
            }
            let throughput;
            let (shadowed, fate) = match tracer.travel(&mut walk, &mut course, depth, points, rays)
            {
                Event::Escape => {
                    radiance += walk.throughput * tracer.escaped(&walk);
                    break;
                }
                Event::Collision(collision) => {
                    if edges == longest {
                        break;
                    }
                    throughput = walk.throughput;
                    let shadowed = tracer.light_in_medium(&collision, points);
                    (shadowed, tracer.scatter_in_medium(&collision, edges, &mut walk, points))
                }
                Event::Surface(point) => {
                    radiance += walk.throughput * tracer.emitted(&walk, &point);
                    let mut varying = Varying::default();
                    let vertex = tracer.vertex(depth, &point, walk.ray.direction, &mut varying);
                    let is_last = edges == longest;
                    // Of the last surface matters only what passes it.
                    if is_last && !vertex.bsdf.lobes().delta
                        || tracer.is_inconsistent(&vertex, -walk.ray.direction, vertex.wo)
                    {
                        break;
                    }
                    throughput = walk.throughput;
                    let shadowed = if is_last {
                        None
                    } else {
                        tracer.light_at_surface(&vertex, &course, points)
                    };
                    let fate = tracer.scatter::<Self, S>(&vertex, edges, &mut walk, points);
                    course.cross(tracer.scene, &point, walk.ray.direction);
                    (shadowed, fate)
                }
            };
            // In one place for all vertices, so that what traces rays is compiled once.
            if let Some(shadowed) = shadowed {
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
        radiance
    }
}
