//! Compares rows of exact values with what the crates compute here.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use etendue_brdf::{
    Alpha, BeckmannLambda, Bsdf, ComplexIor, Distribution, Ior, Lambert, Masking, Microfacets,
    OrenNayar, OrenNayarQualitative, ParameterError, Reflectance, RoughConductor, RoughDielectric,
    Sigma, fresnel,
};
use etendue_firmware::exit;
use etendue_math::Vector3;
use etendue_math::glam::Vec3;

include!(concat!(env!("OUT_DIR"), "/rows.rs"));

/// One exact value: its inputs and how far from it an answer may lie.
pub struct Row {
    file: &'static str,
    id: &'static str,
    beckmann: bool,
    parameters: &'static [(&'static str, f32)],
    wo: [f32; 3],
    /// Also `h` and `w` of functions of one direction.
    wi: [f32; 3],
    cos: f32,
    /// Value and density; 0 where there is no density.
    exact: [f64; 2],
    bound: [f64; 2],
}

#[entry]
fn main() -> ! {
    let mut misses = 0;
    for row in ROWS {
        let [f, pdf] = row.answer().unwrap_or([f32::NAN; 2]);
        let near = |got: f32, i: usize| (f64::from(got) - row.exact[i]).abs() <= row.bound[i];
        if !(near(f, 0) && near(pdf, 1)) {
            misses += 1;
            hprintln!("MISS {}: {} {}, exact {} {}", row.id, f, pdf, row.exact[0], row.exact[1]);
        }
    }
    hprintln!("rows {} misses {}", ROWS.len(), misses);
    exit(misses == 0)
}

impl Row {
    fn parameter(&self, name: &str) -> f32 {
        self.parameters.iter().find(|(n, _)| *n == name).map_or(f32::NAN, |(_, value)| *value)
    }

    fn facets(&self, masking: Masking) -> Result<Microfacets<f32>, ParameterError> {
        let distribution = if self.beckmann {
            Distribution::Beckmann { lambda: BeckmannLambda::Exact }
        } else {
            Distribution::Ggx
        };
        let alpha = self.parameter("alpha");
        let width = |name| Alpha::new(if alpha.is_nan() { self.parameter(name) } else { alpha });
        Ok(Microfacets::new(distribution, width("alpha_x")?, width("alpha_y")?, masking))
    }

    /// Value and density, or the refusal of the parameters.
    fn answer(&self) -> Result<[f32; 2], ParameterError> {
        let unit = |w: [f32; 3]| Vector3::try_normalize(Vec3::from(w)).unwrap_or_default();
        let (wo, wi) = (unit(self.wo), unit(self.wi));
        let bsdf = |(f, pdf): (f32, f32)| [f, pdf];
        let albedo = || Reflectance::new(self.parameter("albedo"));
        let sigma = || Sigma::new(self.parameter("sigma"));
        let metal = || ComplexIor::new(self.parameter("eta"), self.parameter("k"));
        let value = |x: f32| [x, 0.0];
        Ok(match self.file {
            "fresnel-conductor" => {
                let metal = metal()?;
                value(fresnel::conductor(self.cos, metal.eta(), metal.k()))
            }
            "fresnel-dielectric" => value(fresnel::dielectric(self.cos, self.parameter("eta"))),
            "fresnel-schlick" => value(fresnel::schlick(self.parameter("f0"), self.cos)),
            "lambert" => bsdf(Lambert::new(albedo()?).eval_pdf(wo, wi)),
            "ndf-beckmann" | "ndf-ggx" => value(self.facets(Masking::default())?.ndf(wi)),
            "smith-g2-beckmann" | "smith-g2-ggx" => {
                value(self.facets(Masking::HeightCorrelated)?.g2(wo, wi))
            }
            "oren-nayar" => bsdf(OrenNayar::new(albedo()?, sigma()?).eval_pdf(wo, wi)),
            "oren-nayar-qualitative" => {
                bsdf(OrenNayarQualitative::new(albedo()?, sigma()?).eval_pdf(wo, wi))
            }
            "rough-conductor" => {
                let facets = self.facets(Masking::HeightCorrelated)?;
                bsdf(RoughConductor::new(metal()?, facets).eval_pdf(wo, wi))
            }
            "rough-dielectric" => {
                let eta = Ior::from_media(self.parameter("ior_int"), self.parameter("ior_ext"))?;
                let facets = self.facets(Masking::Separable)?;
                bsdf(RoughDielectric::<f32>::new(eta, facets)?.eval_pdf(wo, wi))
            }
            _ => [f32::NAN; 2],
        })
    }
}
