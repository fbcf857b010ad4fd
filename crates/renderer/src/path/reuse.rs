//! Paths of neighbouring pixels that lend each other what they have found.
//!
//! A path is cut in two where it goes from one ideal diffuse surface to another: at its *joint* x, the first diffuse
//! vertex, and its *branch*, all that begins at the next vertex y. The light L that leaves y is the same towards the joints of
//! all paths of a group, each of which could have drawn y itself. It is shared out in proportion to the densities with which they
//! would have done so:
//!
//! ```text
//! C(x, y) = max(0, n_x · ω) |ng_y · ω| / |y − x|²
//! light that x gets from y:   throughput(x) ρ(x) L · C(x, y) V(x, y) / Σ over joints x' of C(x', y) V(x', y)
//! ```
//!
//! This is the balance heuristic over the group's ways of drawing y, in which cosine and squared distance cancel but
//! for the ratio: weights lie between 0 and 1, whatever the distances. A shadow ray for each pair replaces the rest of a path.
//!
//! # Without bias
//! Which pairs may share is a matter of x and y alone, never of how y was drawn: both sides of both surfaces are seen
//! from the right side by geometric and interpolated normal, joints lie at the same depth, and what lies between
//! hides y (V) or not. All other light, emission of y included, stays with the path that found it. There is no roulette at joints.
//!
//! # Source
//! Bekaert, Sbert, Halton, "Accelerating Path Tracing by Re-Using Paths", EGWR 2002.

use core::marker::PhantomData;

use etendue_brdf::Bsdf;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::{Ray, Rays, SurfacePoint};
use etendue_scene::material::Varying;

use super::scatter::Departure;
use super::transport::Surfaces;
use super::{Fate, PathTracer, Vertex, Walk};
use crate::statistics::RayCounts;

/// What a path has found, and what of it may be shared.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SharedPath {
    /// What it keeps.
    pub(crate) own: Color,
    /// What it was lent, its own branch included.
    pub(crate) lent: Color,
    /// As it left the first vertex that scatters; nothing for a path without.
    pub(crate) first: Option<First>,
    joint: Option<Joint>,
    branch: Option<Branch>,
}

/// A path as it leaves its first vertex that scatters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct First {
    /// What it has found so far.
    pub(crate) radiance: Color,
    /// Rays counted so far.
    pub(crate) rays: u64,
}

/// The first diffuse vertex of a path.
#[derive(Clone, Copy, Debug)]
struct Joint {
    point: SurfacePoint,
    /// Shading and geometric normal on the viewer's side.
    shading: Vec3,
    normal: Vec3,
    /// From the camera, the albedo here included.
    throughput: Color,
    depth: u16,
}

/// What begins at the vertex after a joint.
#[derive(Clone, Copy, Debug)]
struct Branch {
    /// A point just off the surface.
    position: Vec3,
    /// Shading and geometric normal on the side of the light.
    shading: Vec3,
    normal: Vec3,
    /// What leaves it by reflection.
    radiance: Color,
}

impl Joint {
    /// The joint at a vertex, where there can be one.
    #[inline(always)]
    fn at(vertex: &Vertex<'_, Primaries>, walk: &Walk<Primaries>) -> Option<Self> {
        let albedo = vertex.bsdf.lambertian(vertex.wo)?;
        let throughput = walk.throughput * albedo;
        let [shading, normal] = vertex.oriented_normals();
        (throughput.max_channel() > 0.0).then_some(Self {
            point: *vertex.point,
            shading,
            normal,
            throughput,
            depth: vertex.depth,
        })
    }

    /// C(x, y): 0 where the pair may not share.
    #[inline(always)]
    fn coupling(&self, branch: &Branch) -> f32 {
        let way = branch.position - self.point.position;
        let squared = way.length_squared();
        let leaves = way.dot(self.shading);
        let arrives = -way.dot(branch.normal);
        let right_sides = leaves > 0.0
            && arrives > 0.0
            && way.dot(self.normal) > 0.0
            && way.dot(branch.shading) < 0.0;
        let coupling = leaves * arrives / (squared * squared);
        if right_sides && coupling.is_finite() { coupling } else { 0.0 }
    }
}

impl Branch {
    /// The branch that begins at a vertex, where that can be lent.
    #[inline(always)]
    fn at(vertex: &Vertex<'_, Primaries>, walk: &Walk<Primaries>) -> Option<Self> {
        vertex.bsdf.lambertian(vertex.wo)?;
        let [shading, normal] = vertex.oriented_normals();
        let position = vertex.point.spawn(-walk.ray.direction).origin;
        Some(Self { position, shading, normal, radiance: Color::black() })
    }
}

impl Vertex<'_, Primaries> {
    /// Interpolated and geometric normal on the viewer's side, each by itself.
    #[inline(always)]
    fn oriented_normals(&self) -> [Vec3; 2] {
        let shading = self.receiver.normal;
        let normal = self.point.normal;
        [shading, if normal.dot(shading) < 0.0 { -normal } else { normal }]
    }
}

impl<R: Rays> PathTracer<'_, '_, R, Primaries> {
    /// A path through the empty space between surfaces, cut where it can be shared.
    ///
    /// * `patience`: how much less than 1 the path may carry before roulette ends it.
    #[inline(always)]
    pub(crate) fn path_to_share<S: Sampler>(
        &self,
        camera_ray: Ray,
        points: &S,
        lights: LightSamples<S>,
        patience: f32,
        rays: &mut RayCounts,
    ) -> SharedPath {
        let longest = self.longest();
        let mut path = SharedPath::default();
        let mut walk = Walk::from_camera(camera_ray, Primaries);
        rays.camera += 1;
        for depth in 1..=longest {
            let Some(point) = self.next_surface(&mut walk, rays) else {
                path.add(walk.throughput * self.escaped(&walk));
                break;
            };
            path.add(walk.throughput * self.emitted(&walk, &point));
            if depth == longest {
                rays.cut((path.scale() * walk.throughput).max_channel());
                break;
            }
            let mut varying = Varying::default();
            let vertex = self.vertex(depth, &point, &walk, None, &mut varying);
            if self.is_inconsistent(&vertex, -walk.ray.direction, vertex.wo) {
                break;
            }
            let mut edges = depth;
            match &path.joint {
                None => {
                    path.joint = Joint::at(&vertex, &walk);
                    if path.joint.is_some() {
                        edges = 0;
                    }
                }
                Some(joint) if joint.depth + 1 == depth => {
                    let branch = Branch::at(&vertex, &walk);
                    path.branch = branch.filter(|branch| joint.coupling(branch) > 0.0);
                    if path.branch.is_some() {
                        walk.throughput = Color::white();
                    }
                }
                Some(_) => {}
            }
            let is_first = path.first.is_none() && vertex.bsdf.lobes().continuous;
            let count = if is_first { lights.count } else { 1 };
            if is_first {
                for which in 0..count {
                    let light = self.direct_light(&vertex, &lights.points(which), count, rays);
                    path.add((walk.throughput * light).scale(1.0 / count as f32));
                }
                path.first = Some(First { radiance: path.own, rays: rays.total() });
            } else {
                path.add(walk.throughput * self.direct_light(&vertex, points, 1, rays));
            }
            let departure = Departure::after(edges).with_lights(count).with_patience(patience);
            match self.scatter::<Surfaces, S>(&vertex, departure, &mut walk, points) {
                Fate::Continues | Fate::Passes => rays.indirect += 1,
                Fate::Ends => break,
            }
        }
        path
    }

    /// Shares out the branches of a group of paths.
    #[inline(always)]
    pub(crate) fn share(&self, paths: &mut [SharedPath], rays: &mut RayCounts) {
        for owner in 0..paths.len() {
            if let Some(branch) = paths[owner].branch
                && !branch.radiance.is_black()
            {
                self.share_branch(paths, owner, &branch, rays);
            }
        }
    }

    #[inline(always)]
    fn share_branch(
        &self,
        paths: &mut [SharedPath],
        owner: usize,
        branch: &Branch,
        rays: &mut RayCounts,
    ) {
        let Some(depth) = paths[owner].joint.as_ref().map(|joint| joint.depth) else { return };
        let mut couplings = [0.0; MOST];
        let mut sum = 0.0;
        for (i, path) in paths.iter().enumerate().take(MOST) {
            let Some(joint) = &path.joint else { continue };
            if joint.depth != depth {
                continue;
            }
            let coupling = joint.coupling(branch);
            let sees = coupling > 0.0
                && (i == owner || {
                    rays.shadow += 1;
                    !self.rays.occluded(&joint.point.spawn_to(branch.position))
                });
            if sees {
                couplings[i] = coupling;
                sum += coupling;
            }
        }
        // What is no number stays with the path that made it, to be reported once.
        if !(sum.is_finite() && branch.radiance.is_finite()) {
            (couplings, sum) = ([0.0; MOST], 1.0);
            couplings[owner] = 1.0;
        }
        for (path, coupling) in paths.iter_mut().zip(couplings) {
            if let Some(joint) = &path.joint
                && coupling > 0.0
            {
                path.lent += (joint.throughput * branch.radiance).scale(coupling / sum);
            }
        }
    }
}

/// The random numbers of the light samples at the first vertex that scatters, of which a path can have several: the samples of a
/// pixel take runs of consecutive points.
#[derive(Clone, Copy)]
pub(crate) struct LightSamples<S> {
    pub(crate) seed: u64,
    pub(crate) pixel: [u32; 2],
    /// Of the path.
    pub(crate) sample: u64,
    /// How many, at least 1.
    pub(crate) count: u32,
    pub(crate) sampler: PhantomData<S>,
}

impl<S: Sampler> LightSamples<S> {
    #[inline(always)]
    fn points(&self, which: u32) -> S {
        S::at(self.seed, self.pixel, self.sample * u64::from(self.count) + u64::from(which))
    }
}

/// The largest group; of a larger one the others have nothing to do with the first.
pub(crate) const MOST: usize = 16;

impl SharedPath {
    #[inline(always)]
    fn add(&mut self, radiance: Color) {
        match &mut self.branch {
            Some(branch) => branch.radiance += radiance,
            None => self.own += radiance,
        }
    }

    /// What the throughput of its walk is relative to.
    fn scale(&self) -> Color {
        match (&self.joint, &self.branch) {
            (Some(joint), Some(_)) => joint.throughput,
            _ => Color::white(),
        }
    }

    /// What its branch would bring to a path that does not share.
    pub(crate) fn alone(&self) -> Color {
        match (&self.joint, &self.branch) {
            (Some(joint), Some(branch)) => joint.throughput * branch.radiance,
            _ => Color::black(),
        }
    }
}
