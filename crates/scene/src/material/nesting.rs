//! Transparent bodies that overlap.

/// A transparent body among others: where several overlap, the one of highest priority is there.
///
/// So a glass and what it is filled with can be modelled as bodies that overlap a little, with neither a gap between them nor
/// a surface that stands for both.
///
/// # Source
/// C. Schmidt, B. Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nesting {
    /// Which of two bodies is there where both are: the one of the larger number, of equal ones the one entered later.
    pub priority: i32,
    /// Index of refraction of the body itself.
    pub interior: f32,
    /// Index of what is around all bodies.
    pub exterior: f32,
}
