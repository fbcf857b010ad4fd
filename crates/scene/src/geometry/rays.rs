//! Tracing many rays without deciding each time how.

use super::bvh::simd::{Backend, Kernel, Simd};
use super::{Geometry, Hit, Ray};

/// What traces rays through a geometry at one moment: a [`Moment`], which finds out for every ray what the processor
/// offers, or what the geometry hands to a [`Task`], which knows.
///
/// Not rays have a time, but what traces them: all rays of a path belong to one moment.
///
/// All implementations give the same bits.
pub trait Rays: Copy {
    /// The same at another moment: a share of the exposure, 0 where the shutter opens, 1 where it closes.
    fn at(self, time: f32) -> Self;
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

/// A geometry at a moment, made by [`Geometry::at`].
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    geometry: &'a Geometry,
    time: f32,
}

impl<'a> Moment<'a> {
    pub(super) fn new(geometry: &'a Geometry, time: f32) -> Self {
        Self { geometry, time }
    }
}

impl Rays for Moment<'_> {
    #[inline]
    fn at(self, time: f32) -> Self {
        Self { time, ..self }
    }

    #[inline]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.geometry.backend.run(Closest { at: *self, ray })
    }

    #[inline]
    fn occluded(&self, ray: &Ray) -> bool {
        self.geometry.backend.run(Occluded { at: *self, ray })
    }
}

/// The closest hit as a kernel.
struct Closest<'a> {
    at: Moment<'a>,
    ray: &'a Ray,
}

impl Kernel for Closest<'_> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Option<Hit> {
        self.at.geometry.intersect_with(simd, self.ray, self.at.time)
    }
}

/// Any hit as a kernel.
struct Occluded<'a> {
    at: Moment<'a>,
    ray: &'a Ray,
}

impl Kernel for Occluded<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        self.at.geometry.occluded_with(simd, self.ray, self.at.time)
    }
}

/// A geometry at a moment and the instructions to trace rays with.
#[derive(Clone, Copy)]
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(dead_code, reason = "elsewhere everything is compiled for the same instructions")
)]
struct Compiled<'a, S> {
    geometry: &'a Geometry,
    simd: S,
    time: f32,
}

impl<S: Simd> Rays for Compiled<'_, S> {
    #[inline(always)]
    fn at(self, time: f32) -> Self {
        Self { time, ..self }
    }

    #[inline(always)]
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.geometry.intersect_with(self.simd, ray, self.time)
    }

    #[inline(always)]
    fn occluded(&self, ray: &Ray) -> bool {
        self.geometry.occluded_with(self.simd, ray, self.time)
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
        self.task.run(Compiled { geometry: self.geometry, simd, time: 0.0 })
    }
}

impl Geometry {
    /// Runs a task that traces rays through this geometry, at first where the shutter opens, compiled for the
    /// processor's best instructions.
    #[inline]
    pub fn run<T: Task>(&self, task: T) -> T::Output {
        match self.backend {
            // Nothing to gain: this is what everything is compiled for.
            Backend::Portable => task.run(self.at(0.0)),
            #[cfg(target_arch = "x86_64")]
            Backend::Sse2(_) => task.run(self.at(0.0)),
            #[cfg(target_arch = "x86_64")]
            Backend::Avx2(_) | Backend::Avx512(_) => {
                self.backend.run(TaskKernel { geometry: self, task })
            }
        }
    }
}
