//! From one keyframe to the next.

use etendue_math::Real;
use etendue_math::glam::{DAffine3, DMat3, DQuat, DVec3, DVec4, Vec3};

use super::pose::Pose;
use crate::geometry::{Aabb, Transform};

/// The way from one keyframe to the next, over a parameter from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    /// When it starts, and how long it takes.
    time: [f64; 2],
    /// At the start, and the change.
    translation: [DVec3; 2],
    /// At the start, and the unit quaternion a right angle further on.
    rotation: [DVec4; 2],
    /// Between the quaternions at start and end, in `[0, π/2]`: half the angle turned by.
    angle: f64,
    /// At the start, and the change.
    stretch: [DMat3; 2],
}

/// Within this of a right angle between two quaternions, the rotation is a half turn: both ways are as short, up to the
/// rounding of decimal matrices.
const HALF_TURN: f64 = 1e-6;

impl Segment {
    /// By the shorter way; of a half turn, anticlockwise about the axis whose largest component is positive.
    pub(super) fn between([start, end]: [&(f64, Transform); 2]) -> Self {
        let time = [start.0, end.0 - start.0];
        let [start, end] = [start, end].map(|(_, map)| Pose::of(map));
        let (from, mut to) = (start.rotation, end.rotation);
        if is_other_way(from, to) {
            to = -to;
        }
        let cos = from.dot(to);
        let across = to - from * cos;
        let sin = Real::sqrt(across.dot(across));
        // What two equal rotations differ by is rounding.
        let turns = sin > 1e-15;
        Self {
            time,
            translation: [start.translation, end.translation - start.translation],
            rotation: [from, if turns { across / sin } else { DVec4::ZERO }],
            angle: if turns { Real::atan2(sin, cos) } else { 0.0 },
            stretch: [start.stretch, end.stretch - start.stretch],
        }
    }

    /// Whether it turns by 180°, so that the shorter way is not known.
    pub(super) fn is_half_turn(&self) -> bool {
        Real::abs(self.angle - 0.5 * <f64 as Real>::PI) < HALF_TURN
    }

    /// Of what was reflected in the origin before: a stretch is definite with the other sign.
    pub(super) fn reflect(&mut self) {
        self.stretch = self.stretch.map(|stretch| -stretch);
    }

    /// When it starts.
    pub(super) fn start(&self) -> f64 {
        self.time[0]
    }

    /// The parameter at a time: 0 before it starts, 1 after its end.
    pub(super) fn parameter(&self, time: f64) -> f64 {
        let [start, length] = self.time;
        ((time - start) / length).clamp_to(0.0, 1.0)
    }

    /// ```text
    /// x ↦ T₀ + u ΔT + R(u) (S₀ + u ΔS) x,  q(u) = q₀ cos uθ + q⊥ sin uθ
    /// ```
    pub(super) fn at(&self, u: f64) -> DAffine3 {
        let [start, change] = self.translation;
        let [from, across] = self.rotation;
        let rotation = if self.angle == 0.0 {
            from
        } else {
            let (sin, cos) = Real::sin_cos(u * self.angle);
            from * cos + across * sin
        };
        DAffine3 {
            matrix3: DMat3::from_quat(DQuat::from_vec4(rotation)) * self.stretch_at(u),
            translation: start + change * u,
        }
    }

    fn stretch_at(&self, u: f64) -> DMat3 {
        let [start, change] = self.stretch;
        start + change * u
    }

    /// A box that holds a box on its way from one parameter to another.
    ///
    /// A point of it moves on `x(u)`, and between `u` and `u + h` leaves the segment from `x(u)` to `x(u + h)` by no more
    /// than
    ///
    /// ```text
    /// h²/8 max |x″| ≤ h²/8 (ω² max |S p| + 2 ω max |ΔS p|),   ω = 2 θ
    /// ```
    ///
    /// which vanishes for what does not turn. Both maxima are at corners, the first one at an end of the way.
    pub(super) fn bounds(&self, of: &Aabb, [from, to]: [f64; 2]) -> Aabb {
        /// A piece turns by no more than an eleventh of a right angle: its arc rises by 1/400 of its radius.
        const LARGEST_TURN: f64 = 1.0 / 7.0;
        if of.is_empty() {
            return Aabb::EMPTY;
        }
        let corners = of.corners().map(Vec3::as_dvec3);
        let farthest = |m: DMat3| {
            let squares = corners.map(|p| {
                let image = m * p;
                image.dot(image)
            });
            Real::sqrt(squares.into_iter().fold(0.0, f64::max))
        };
        let reach = farthest(self.stretch_at(from)).max(farthest(self.stretch_at(to)));
        let omega = 2.0 * self.angle;
        let pieces = Real::floor(omega * (to - from) / LARGEST_TURN) + 1.0;
        let step = (to - from) / pieces;
        let rise = step * step / 8.0 * omega * (omega * reach + 2.0 * farthest(self.stretch[1]));
        // Between the ends, products round by as much as there.
        let [start, change] = self.translation;
        let size = reach + start.abs().max((start + change).abs()).max_element();
        let margin = Vec3::splat((rise + 4.0 * f64::from(f32::EPSILON) * size) as f32);
        let moved = (0..=pieces as u32).fold(Aabb::EMPTY, |all, i| {
            let u = from + step * f64::from(i);
            all.union(Transform::of_pose(self.at(u)).aabb(of))
        });
        Aabb { min: moved.min - margin, max: moved.max + margin }
    }
}

/// Whether the way between two rotations leads to the opposite quaternion, which is the same rotation.
fn is_other_way(from: DVec4, to: DVec4) -> bool {
    let cos = from.dot(to);
    if Real::abs(cos) > HALF_TURN {
        return cos < 0.0;
    }
    // The vector of to · from⁻¹: the axis of a half turn.
    let (v, w) = (to.truncate(), from.truncate());
    let axis = v * from.w - w * to.w - v.cross(w);
    let largest = axis.abs().max_element();
    let components = axis.to_array().into_iter();
    // Axes along a diagonal: the first of components that are equal up to rounding.
    components.into_iter().find(|c| Real::abs(*c) > 0.999 * largest).is_some_and(|c| c < 0.0)
}
