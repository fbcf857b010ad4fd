//! The transparent bodies that a path is in, of those that overlap.

use etendue_math::glam::Vec3;
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Rays, ShapeId, SurfacePoint};
use etendue_scene::material::Nesting;
use etendue_scene::medium::Medium;

use crate::path::PathTracer;

/// A body that a path is in.
#[derive(Clone, Copy)]
struct Body<'s> {
    shape: ShapeId,
    nesting: Nesting,
    medium: Option<&'s Medium>,
}

/// The bodies that a path is in, in the order in which it has entered them.
pub(super) struct Bodies<'s> {
    list: Vec<Body<'s>>,
    /// What is around all of them.
    around: Option<&'s Medium>,
}

/// A surface of a body that a path meets.
pub(super) struct Crossing<'s> {
    body: Body<'s>,
    enters: bool,
    /// The medium outside, where there is no other body.
    outside: Option<&'s Medium>,
    /// Whether a body of higher priority is on both sides, so that there is no surface.
    pub(super) is_hidden: bool,
    /// Index of refraction of what is outside.
    pub(super) exterior: f32,
}

impl<'s> Bodies<'s> {
    /// None, in a medium.
    pub(super) fn none(around: Option<&'s Medium>) -> Self {
        Self { list: Vec::new(), around }
    }

    /// Where in the list a body is that is left.
    fn last(&self, shape: ShapeId) -> Option<usize> {
        self.list.iter().rposition(|body| body.shape == shape)
    }

    /// The body that is there, but for one of the list, and where in the list it is.
    fn strongest(&self, but: Option<usize>) -> Option<(usize, Body<'s>)> {
        let others = self.list.iter().copied().enumerate().filter(|(i, _)| Some(*i) != but);
        // The last of the largest.
        others.max_by_key(|(_, body)| body.nesting.priority)
    }

    /// Goes through a surface; what is there behind it.
    pub(super) fn cross(&mut self, crossing: &Crossing<'s>) -> Option<&'s Medium> {
        if crossing.enters {
            self.list.push(crossing.body);
        } else if let Some(index) = self.last(crossing.body.shape) {
            self.list.remove(index);
        }
        self.strongest(None).map_or(crossing.outside, |(_, body)| body.medium)
    }
}

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// What a surface is to a path that meets it in a direction; `None` if it is none of a body among others.
    pub(super) fn crossing(
        &self,
        bodies: &Bodies<'s>,
        point: &SurfacePoint,
        direction: Vec3,
    ) -> Option<Crossing<'s>> {
        let nesting = self.scene.nesting(point.shape)?;
        let around = bodies.around;
        let [inside, outside] =
            [-point.normal, point.normal].map(|side| self.beyond(point, side, around));
        let body = Body { shape: point.shape, nesting, medium: inside };
        let enters = direction.dot(point.normal) < 0.0;
        let own = if enters { None } else { bodies.last(point.shape) };
        let other = bodies.strongest(own);
        let is_hidden = other.is_some_and(|(place, other)| {
            // Of equal ones the one entered later is there.
            let later = own.is_some_and(|own| place > own);
            other.nesting.priority > nesting.priority
                || later && other.nesting.priority == nesting.priority
        });
        let exterior = other.map_or(nesting.exterior, |(_, other)| other.nesting.interior);
        Some(Crossing { body, enters, outside, is_hidden, exterior })
    }
}
