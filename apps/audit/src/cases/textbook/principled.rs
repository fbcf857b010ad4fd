//! Disney's material of one channel, as its course notes and Mitsuba's plugins write it.

use core::f64::consts::PI;

use etendue_brdf::{Distribution, Masking, PrincipledParameters, PrincipledThinParameters};
use etendue_math::Real;

use super::{Direction, Facets, both_above, dielectric, dot, normalized};

fn lerp(a: f64, b: f64, t: f64) -> f64 {
    (1.0 - t) * a + t * b
}

fn fifth(cos: f64) -> f64 {
    Real::powi(1.0 - cos, 5)
}

/// GGX of the widths that roughness and anisotropy stand for.
fn facets(roughness: f64, anisotropic: f64) -> Facets {
    let aspect = (1.0 - 0.9 * anisotropic).sqrt();
    let squared = roughness * roughness;
    let widths = [(squared / aspect).max(1e-3), (squared * aspect).max(1e-3)];
    Facets { distribution: Distribution::Ggx, widths, masking: Masking::Separable }
}

fn half(wo: Direction, wi: Direction) -> Direction {
    normalized([0, 1, 2].map(|k| wo[k] + wi[k]))
}

/// Schlick's weight, of the refracted angle where the far medium is the thinner one.
fn weight(cos: f64, eta: f64) -> f64 {
    if eta > 1.0 {
        return fifth(cos);
    }
    let sin2_t = (1.0 - cos * cos) / (eta * eta);
    fifth(if sin2_t < 1.0 { (1.0 - sin2_t).sqrt() } else { 0.0 })
}

/// Glass, tinted glass and metal; a grey tint is white.
fn fresnel(base: f64, metallic: f64, tint: f64, eta: f64, cos: f64) -> f64 {
    let f0 = Real::sqr((eta - 1.0) / (eta + 1.0));
    let schlick = |r: f64| r + (1.0 - r) * weight(cos, eta);
    let glass = lerp(dielectric(cos, eta), schlick(f0), tint);
    lerp(glass, schlick(base), metallic)
}

/// Burley 2015, section 4: diffuse, retro-reflection, flat subsurface scattering.
fn diffuse(base: f64, roughness: f64, flatness: f64, wo: Direction, wi: Direction) -> f64 {
    let cos_d = dot(wi, half(wo, wi));
    let (fo, fi) = (fifth(wo[2]), fifth(wi[2]));
    let rr = 2.0 * roughness * cos_d * cos_d;
    let lambert = (1.0 - 0.5 * fo) * (1.0 - 0.5 * fi);
    let retro = rr * (fo + fi + fo * fi * (rr - 1.0));
    let fss90 = rr / 2.0;
    let fss = lerp(1.0, fss90, fo) * lerp(1.0, fss90, fi);
    let flat = 1.25 * (fss * (1.0 / (wo[2] + wi[2]) - 0.5) + 0.5);
    base / PI * lerp(lambert + retro, flat, flatness)
}

/// Burley 2012, section 5.6: GTR with exponent 1, Schlick from 0.04, masking of α 0.25.
fn clearcoat(weight_of: f64, gloss: f64, eta: f64, wo: Direction, wi: Direction) -> f64 {
    let h = half(wo, wi);
    let a2 = Real::sqr(lerp(0.1, 0.001, gloss));
    let d = (a2 - 1.0) / (PI * Real::ln(a2) * (1.0 + (a2 - 1.0) * h[2] * h[2]));
    let f = lerp(0.04, 1.0, weight(dot(wo, h), eta));
    let g = |w: Direction| {
        let tan2 = (1.0 - w[2] * w[2]) / (w[2] * w[2]);
        2.0 / (1.0 + (1.0 + 0.25 * 0.25 * tan2).sqrt())
    };
    0.25 * weight_of * f * d * g(wo) * g(wi)
}

/// Mitsuba's `principled`.
pub(crate) fn solid(p: &PrincipledParameters<f64>, wo: Direction, wi: Direction) -> f64 {
    let (matter, through) = (1.0 - p.metallic, (1.0 - p.metallic) * p.spec_trans);
    let facets = facets(p.roughness, p.anisotropic);
    if !both_above(wo, wi) {
        let color = if wo[2] * wi[2] < 0.0 { p.base_color.sqrt() } else { 1.0 };
        let glass = if through > 0.0 { facets.dielectric(p.eta, wo, wi) } else { 0.0 };
        return through * color * glass;
    }
    let specular = |cos| fresnel(p.base_color, p.metallic, p.spec_tint, p.eta, cos);
    facets.reflection(specular, wo, wi)
        + clearcoat(p.clearcoat, p.clearcoat_gloss, p.eta, wo, wi)
        + matter * (1.0 - p.spec_trans) * diffuse(p.base_color, p.roughness, p.flatness, wo, wi)
        + matter * p.sheen * fifth(dot(wi, half(wo, wi)))
}

/// Mitsuba's `principledthin`.
pub(crate) fn thin(p: &PrincipledThinParameters<f64>, wo: Direction, wi: Direction) -> f64 {
    let flip = |w: Direction| [w[0], w[1], -w[2]];
    let (wo, wi) = if wo[2] < 0.0 { (flip(wo), flip(wi)) } else { (wo, wi) };
    let (matter, through) = (1.0 - p.spec_trans, p.diff_trans / 2.0);
    if both_above(wo, wi) {
        let specular = |cos| fresnel(p.base_color, 0.0, p.spec_tint, p.eta, cos);
        let sheen = p.sheen * fifth(dot(wi, half(wo, wi)));
        let body = diffuse(p.base_color, p.roughness, p.flatness, wo, wi) + sheen;
        return p.spec_trans * facets(p.roughness, p.anisotropic).reflection(specular, wo, wi)
            + matter * (1.0 - through) * body;
    }
    let mirrored = flip(wi);
    let blurred = facets((0.65 * p.eta - 0.35) * p.roughness, p.anisotropic);
    let seen = dot(wi, half(wo, mirrored)) < 0.0;
    let glass = blurred.reflection(|cos| 1.0 - dielectric(cos, p.eta), wo, mirrored);
    p.base_color * (p.spec_trans * if seen { glass } else { 0.0 } + matter * through / PI)
}
