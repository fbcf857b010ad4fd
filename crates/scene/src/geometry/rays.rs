//! Tracing many rays without deciding each time how.

use super::bvh::simd::{Backend, Kernel, Simd};
use super::{Geometry, Hit, Ray};

/// What traces rays through a geometry: the geometry itself, which finds out for every ray what the
/// processor offers, or what it hands to a [`Task`], which knows.
///
/// All implementations give the same bits.
pub trait Rays: Copy {
    /// The closest hit at `0 < t < t_max`.
    fn intersect(&self, ray: &Ray) -> Option<Hit>;
    /// Whether anything is hit at `0 < t < t_max`.
    fn occluded(&self, ray: &Ray) -> bool;
}

/// Work that traces many rays, such as a tile of a picture.
///
/// [`Geometry::run`] compiles it for the processor's instructions. Its `run` must be
/// `#[inline(always)]`, and so should be what it spends its time in: a function that is called
/// instead is compiled for the baseline of the target.
pub trait Task {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<R: Rays>(self, rays: R) -> Self::Output;
}

impl Rays for &Geometry {
    #[inline]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        Geometry::intersect(self, ray)
    }

    #[inline]
    fn occluded(&self, ray: &Ray) -> bool {
        Geometry::occluded(self, ray)
    }
}

/// A geometry and the instructions to trace rays with.
#[derive(Clone, Copy)]
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(dead_code, reason = "elsewhere everything is compiled for the same instructions")
)]
struct Compiled<'a, S> {
    geometry: &'a Geometry,
    simd: S,
}

impl<S: Simd> Rays for Compiled<'_, S> {
    #[inline(always)]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.geometry.intersect_with(self.simd, ray)
    }

    #[inline(always)]
    fn occluded(&self, ray: &Ray) -> bool {
        self.geometry.occluded_with(self.simd, ray)
    }
}

/// A task as a kernel.
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(dead_code, reason = "elsewhere everything is compiled for the same instructions")
)]
struct TaskKernel<'a, T> {
    geometry: &'a Geometry,
    task: T,
}

impl<T: Task> Kernel for TaskKernel<'_, T> {
    type Output = T::Output;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> T::Output {
        self.task.run(Compiled { geometry: self.geometry, simd })
    }
}

impl Geometry {
    /// Runs a task that traces rays through this geometry, compiled for the processor's best
    /// instructions.
    #[inline]
    pub fn run<T: Task>(&self, task: T) -> T::Output {
        match self.backend {
            // Nothing to gain: this is what everything is compiled for.
            Backend::Portable => task.run(self),
            #[cfg(target_arch = "x86_64")]
            Backend::Sse2(_) => task.run(self),
            #[cfg(target_arch = "x86_64")]
            Backend::Avx2(_) | Backend::Avx512(_) => {
                self.backend.run(TaskKernel { geometry: self, task })
            }
        }
    }
}
