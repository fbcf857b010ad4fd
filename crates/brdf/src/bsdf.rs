//! The interface every reflection model has.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

/// How likely a sampled direction was.
///
/// Keeping the two measures apart by type means that nobody has to test whether a density is 0 to
/// find out whether a direction came from a mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density<T> {
    /// Density per steradian, the probability of having chosen the lobe included.
    Continuous(T),
    /// Probability with which this one direction of a delta lobe was chosen.
    Delta(T),
}

/// A sampled direction and what it is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<C: Spectrum> {
    /// Sampled direction, pointing away from the surface, local frame.
    pub wi: Vec3<C::Real>,
    /// `f(wo, wi) |cos θi| / pdf`, or for a delta lobe its reflectance (transmittance) divided by
    /// its probability. Dimensionless.
    pub weight: C,
    /// How likely the direction was.
    pub density: Density<C::Real>,
    /// η of the medium of `wi` relative to that of `wo`: 1 unless the direction was refracted.
    pub eta: C::Real,
}

/// Which parts a scattering function has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lobes {
    /// Scatters into a continuum of directions: `eval` and `pdf` are not identically 0.
    pub continuous: bool,
    /// Has directions of its own (mirror reflection, refraction, pass-through).
    pub delta: bool,
    /// Scatters to the other side of the surface.
    pub transmission: bool,
}

impl Lobes {
    /// A continuum of reflected directions and nothing else.
    pub const CONTINUOUS: Self = Self { continuous: true, delta: false, transmission: false };
    /// Mirror reflection and nothing else.
    pub const DELTA: Self = Self { continuous: false, delta: true, transmission: false };
    /// Delta lobes on both sides of the surface.
    pub const DELTA_THROUGH: Self = Self { continuous: false, delta: true, transmission: true };
}

/// A bidirectional scattering distribution function in the local frame, `n = +z`.
///
/// `wo` points to the viewer and `wi` to the light; both are unit vectors pointing away from the
/// surface. Radiance is transported from `wi` to `wo`: transmission includes the factor
/// `1/η²` with `η` the index of the medium of `wi` relative to that of `wo`.
///
/// Evaluation is total: outside a model's domain (a direction below the surface of a one-sided
/// model, a NaN, a zero vector, one a thousand units long) values and densities are 0 and `sample` is
/// `None`. Uniforms lie in `[0, 1)`.
pub trait Bsdf {
    /// Scalar, RGB or a set of wavelengths.
    type Color: Spectrum;

    /// The parts this scattering function has.
    fn lobes(&self) -> Lobes;

    /// Value of the continuous part `f(wo, wi)`, without the cosine, in sr⁻¹, and the density per
    /// steradian with which `sample` draws `wi` from it, the probability of choosing it included.
    ///
    /// The provided one is that of a model without a continuous part: nothing.
    #[inline]
    fn eval_pdf(&self, _wo: BsdfVec<Self>, _wi: BsdfVec<Self>) -> (Self::Color, BsdfReal<Self>) {
        (Self::Color::black(), BsdfReal::<Self>::ZERO)
    }

    /// The value of [`eval_pdf`](Self::eval_pdf) alone; what belongs to the density alone is optimised away.
    #[inline]
    fn eval(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> Self::Color {
        self.eval_pdf(wo, wi).0
    }

    /// The density of [`eval_pdf`](Self::eval_pdf) alone.
    #[inline]
    fn pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> BsdfReal<Self> {
        self.eval_pdf(wo, wi).1
    }

    /// Draws a direction. `u_lobe` chooses among lobes, `u` within the chosen one.
    ///
    /// `None` where nothing is scattered: outside the domain, where the drawn direction has weight 0, or where its density
    /// is so small that the weight is no number.
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<Self::Color>>;

    /// Directional albedo `∫ f(wo, wi) |cos θi| dωi` (delta lobes included) in closed form, or
    /// `None` where the model has none.
    #[inline]
    fn albedo(&self, _wo: BsdfVec<Self>) -> Option<Self::Color> {
        None
    }

    /// The share of light that goes straight on as if there were no surface: the mean weight of the
    /// samples of a delta lobe with `wi = −wo` and η = 1. A shadow ray carries it past the surface.
    ///
    /// The provided one is that of a model that lets nothing pass so.
    #[inline]
    fn pass_through(&self, _wo: BsdfVec<Self>) -> Self::Color {
        Self::Color::black()
    }
}

/// The component type of a model's colours.
pub type BsdfReal<B> = <<B as Bsdf>::Color as Spectrum>::Real;
/// The vector type of a model.
pub type BsdfVec<B> = Vec3<BsdfReal<B>>;

/// A direction above the surface. False for NaN, and for what is a thousand units long: unit
/// vectors are meant, and squares of such a one would overflow further on.
#[inline(always)]
pub(crate) fn above<V: Vector3>(w: V) -> bool {
    // A comparison with the squared length costs less than testing three components for NaN.
    w.z() > V::Scalar::ZERO && w.length_squared() < V::Scalar::lit(1e6)
}

/// Both directions above the surface: the domain of a one-sided reflection model.
#[inline(always)]
pub(crate) fn both_above<V: Vector3>(wo: V, wi: V) -> bool {
    above(wo) && above(wi)
}
