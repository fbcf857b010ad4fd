//! One model with one set of parameters in one precision, as checks see it.

use etendue_brdf::registry::{Albedo, Energy, ModelInfo, Reciprocity};
use etendue_brdf::{Bsdf, Density, Sample};
use etendue_math::{Vec3, Vector3};

use crate::generators::{from_angles, uniforms};
use crate::partition::{Partition, coordinates};
use crate::scalar::{Scalar, show, widen};

/// What a model promises: the laws of its entry in the registry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laws {
    /// Symmetry in the two directions.
    pub reciprocity: Reciprocity,
    /// Energy balance.
    pub energy: Energy,
    /// Where the directional albedo comes from.
    pub albedo: Albedo,
}

impl From<&ModelInfo> for Laws {
    fn from(info: &ModelInfo) -> Self {
        Self { reciprocity: info.reciprocity, energy: info.energy, albedo: info.albedo }
    }
}

/// Width of a model's narrowest lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// Every check applies.
    Wide,
    /// Some thousand ulp of a direction or less: cells cannot resolve it, and cubature would sum the
    /// rounding of directions. Checks that integrate do not apply; pointwise ones do.
    Narrow,
    /// Narrower than the rounding of a direction, which then decides by itself how high the lobe is
    /// there: of a rounded direction neither the density its sampler had in mind nor, where
    /// `wo + η wi` rounds, the value can be recovered. All other pointwise checks apply.
    Needle,
}

/// Whether light is lost in a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// Some, or as far as is known.
    Some,
    /// None: all that arrives leaves again, but for an error of the model's own tables.
    None {
        /// What that error may come to, as a part of 1.
        within: f64,
    },
}

/// A published formula for `f(wo, wi)`, read literally, in `f64`.
pub type Textbook = Box<dyn Fn([f64; 3], [f64; 3]) -> f64 + Send + Sync>;

/// Parameters and the model built with them.
pub struct Case<T: Scalar> {
    /// The parameters, as the report prints them.
    pub parameters: String,
    /// The model.
    pub bsdf: Box<dyn Bsdf<Color = T> + Send + Sync>,
    /// How its narrowest lobe compares with what can be resolved.
    pub width: Width,
    /// Whether these parameters lose light.
    pub loss: Loss,
    /// The formula as published, where the audit keeps it.
    pub textbook: Option<Textbook>,
    /// Published directional albedos, `(θ in rad, albedo)`, that must be reproduced to the three
    /// digits printed.
    pub published: &'static [(f64, f64)],
}

impl<T: Scalar> Case<T> {
    /// A case to which every check applies.
    pub fn new(
        parameters: impl Into<String>,
        bsdf: impl Bsdf<Color = T> + Send + Sync + 'static,
    ) -> Self {
        Self {
            parameters: parameters.into(),
            bsdf: Box::new(bsdf),
            width: Width::Wide,
            loss: Loss::Some,
            textbook: None,
            published: &[],
        }
    }

    /// The same case with a lobe of another width.
    pub fn of_width(self, width: Width) -> Self {
        Self { width, ..self }
    }

    /// The same case, said to lose no light.
    pub fn lossless(self) -> Self {
        self.lossless_within(0.0)
    }

    /// The same case, said to lose no light but for an error that its documentation states.
    pub fn lossless_within(self, within: f64) -> Self {
        Self { loss: Loss::None { within }, ..self }
    }

    /// The same case with its published formula.
    pub fn textbook(
        self,
        formula: impl Fn([f64; 3], [f64; 3]) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { textbook: Some(Box::new(formula)), ..self }
    }

    /// The same case with published albedos.
    pub fn published(self, published: &'static [(f64, f64)]) -> Self {
        Self { published, ..self }
    }

    /// Sample `index` of a stream.
    pub fn draw(&self, wo: Vec3<T>, stream: u64, index: u64) -> Option<Sample<T>> {
        let [lobe, a, b] = uniforms::<T>(stream, index);
        self.bsdf.sample(wo, lobe, [a, b])
    }

    /// Cells of the sphere shaped by `count` samples.
    pub fn partition(&self, wo: Vec3<T>, count: usize) -> Partition {
        const PILOT_STREAM: u64 = 101;
        let points: Vec<_> = (0..count as u64)
            .filter_map(|i| self.draw(wo, PILOT_STREAM, i))
            .filter(|s| matches!(s.density, Density::Continuous(_)))
            .map(|s| coordinates(widen::<T>(s.wi)))
            .collect();
        Partition::new(points, count / 100)
    }

    /// η of the far side relative to the side of `wo`, as samples of the continuous part along the
    /// normal, where transmission is likely, report it; 1 where it transmits nothing.
    pub fn relative_index(&self, wo: Vec3<T>) -> f64 {
        const INDEX_STREAM: u64 = 102;
        let normal = from_angles::<T>(if wo.z() < T::ZERO { -1.0 } else { 1.0 }, 0.0);
        (0..256)
            .filter_map(|i| self.draw(normal, INDEX_STREAM, i))
            .filter(|s| matches!(s.density, Density::Continuous(_)))
            .find(|s| s.wi.z() * normal.z() < T::ZERO)
            .map_or(1.0, |s| s.eta.to_f64())
    }
}

/// A case with the laws it is held to.
#[derive(Clone, Copy)]
pub struct Subject<'a, T: Scalar> {
    /// The laws.
    pub laws: &'a Laws,
    /// The case.
    pub case: &'a Case<T>,
}

impl<T: Scalar> Subject<'_, T> {
    /// A place as the report prints it.
    pub fn at(&self, wo: Vec3<T>, wi: Vec3<T>) -> String {
        format!("{}, {}, wo {}, wi {}", self.case.parameters, T::NAME, show::<T>(wo), show::<T>(wi))
    }

    /// A view direction as the report prints it.
    pub fn at_view(&self, wo: Vec3<T>) -> String {
        format!("{}, {}, wo {}", self.case.parameters, T::NAME, show::<T>(wo))
    }
}

/// Rounding and conditioning of a function of a direction, the scale on which its error is judged.
///
/// ```text
/// scale = ε |g(w)| + Σₖ max |g(w ± ε eₖ) − g(w)|
/// ```
///
/// An error of 1 on this scale is what moving each component of a unit vector by one ulp of 1
/// explains. Steps (an edge of total reflection) and underflow are covered as well as slopes.
pub fn conditioned_ulp<T: Scalar>(w: Vec3<T>, epsilon: T, g: impl Fn(Vec3<T>) -> T) -> f64 {
    let centre = g(w).to_f64();
    let mut scale = epsilon.to_f64() * centre.abs();
    let zero = T::ZERO;
    for axis in [(epsilon, zero, zero), (zero, epsilon, zero), (zero, zero, epsilon)] {
        let step = Vec3::<T>::new(axis.0, axis.1, axis.2);
        let moved = [w + step, w - step].map(|w| (g(w).to_f64() - centre).abs());
        scale += moved[0].max(moved[1]);
    }
    scale
}
