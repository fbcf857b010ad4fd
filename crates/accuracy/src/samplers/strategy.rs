//! Ways of drawing directions, side by side.

use core::marker::PhantomData;

use etendue_brdf::direction::reflect_about;
use etendue_brdf::microfacet::NormalSampling;
use etendue_brdf::{Bsdf, Density, Microfacets};
use etendue_math::{Vec3, Vector3};
use etendue_sampling::warp::{cosine_hemisphere, uniform_hemisphere, uniform_sphere};

/// The uniforms of one sample, in `[0, 1)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uniforms {
    /// Chooses among lobes or sides.
    pub lobe: f32,
    /// A direction within.
    pub direction: [f32; 2],
}

/// A direction and what it is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// The direction.
    pub wi: Vec3<f32>,
    /// `f |cos θi| / pdf` of the continuous part of the model.
    pub weight: f32,
}

/// A way of drawing directions for a model seen from `wo`.
pub trait Strategy {
    /// Draws a direction; `None` for one that is worth nothing.
    fn draw(&self, model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, u: Uniforms) -> Option<Draw>;
}

/// Where a model scatters to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// To the side of `wo`.
    Upper,
    /// To both.
    Both,
}

/// Uniform on the hemisphere of the normal, or on the sphere.
#[derive(Clone, Copy, Debug)]
pub struct Uniform(pub Sides);

/// Density `|cos θi| / π` on the hemisphere of the normal, half of that on either side where there are two.
#[derive(Clone, Copy, Debug)]
pub struct Cosine(pub Sides);

/// Facet normals drawn by `S`, about which `wo` is mirrored; density `D(h) / (4 A)`, see
/// [`microfacet::sampling`](etendue_brdf::microfacet::sampling).
#[derive(Clone, Copy, Debug)]
pub struct Normals<S> {
    facets: Microfacets<f32>,
    sampling: PhantomData<S>,
}

/// The model's own `sample`. What it draws from a delta lobe is worth nothing here.
#[derive(Clone, Copy, Debug)]
pub struct Own;

impl<S: NormalSampling<f32>> Normals<S> {
    /// The strategy for these facets; `None` where it does not exist for their distribution.
    pub fn new(facets: Microfacets<f32>) -> Option<Self> {
        S::supports(facets.distribution()).then_some(Self { facets, sampling: PhantomData })
    }
}

impl Strategy for Uniform {
    #[inline(always)]
    fn draw(&self, model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, u: Uniforms) -> Option<Draw> {
        let (wi, pdf) = match self.0 {
            Sides::Upper => {
                let wi = uniform_hemisphere::from_square(u.direction);
                (wi, uniform_hemisphere::pdf::<f32>(wi))
            }
            Sides::Both => (uniform_sphere::from_square(u.direction), uniform_sphere::pdf::<f32>()),
        };
        weigh(model, wo, wi, pdf)
    }
}

impl Strategy for Cosine {
    #[inline(always)]
    fn draw(&self, model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, u: Uniforms) -> Option<Draw> {
        let wi: Vec3<f32> = cosine_hemisphere::from_square(u.direction);
        let pdf = cosine_hemisphere::pdf::<f32>(wi);
        match self.0 {
            Sides::Upper => weigh(model, wo, wi, pdf),
            Sides::Both if u.lobe < 0.5 => weigh(model, wo, wi, 0.5 * pdf),
            Sides::Both => weigh(model, wo, wi.flip_z(), 0.5 * pdf),
        }
    }
}

impl<S: NormalSampling<f32>> Strategy for Normals<S> {
    #[inline(always)]
    fn draw(&self, model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, u: Uniforms) -> Option<Draw> {
        let h = S::sample(&self.facets, wo, u.direction)?;
        let wi = reflect_about(wo, h);
        let area = S::area(&self.facets, wo, h, wo.dot(h));
        weigh(model, wo, wi, self.facets.ndf(h) / (4.0 * area))
    }
}

impl Strategy for Own {
    #[inline(always)]
    fn draw(&self, model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, u: Uniforms) -> Option<Draw> {
        let sample = model.sample(wo, u.lobe, u.direction)?;
        match sample.density {
            Density::Continuous(_) => Some(Draw { wi: sample.wi, weight: sample.weight }),
            Density::Delta(_) => None,
        }
    }
}

#[inline(always)]
fn weigh(model: &impl Bsdf<Color = f32>, wo: Vec3<f32>, wi: Vec3<f32>, pdf: f32) -> Option<Draw> {
    // A density of 0, in the horizon, is that of directions whose cosine is 0 too.
    (pdf > 0.0).then(|| Draw { wi, weight: model.eval(wo, wi) * wi.z().abs() / pdf })
}
