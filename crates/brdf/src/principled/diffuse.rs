//! Diffuse reflection with retro-reflection, blended with flat subsurface scattering.

use etendue_math::{Real, Spectrum};

use super::fresnel::fifth_power;

/// Burley's diffuse lobe of 2015.
///
/// ```text
/// f = base/π · ((1 − flatness)(f_d + f_r) + flatness f_ss)
/// f_d  = (1 − Fi/2)(1 − Fo/2),                       F = (1 − cos θ)⁵
/// f_r  = R (Fo + Fi + Fo Fi (R − 1)),                R = 2 roughness (wi·h)²
/// f_ss = 1.25 (S (1/(cos θi + cos θo) − ½) + ½),     S = (1 + (R/2 − 1) Fo)(1 + (R/2 − 1) Fi)
/// ```
///
/// # Source
/// B. Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH 2015
/// course notes, section 4; f_ss after P. Hanrahan and W. Krueger, 1993, in the 2012 notes' code.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Diffuse<C: Spectrum> {
    /// `base · weight / π`
    color: C,
    roughness: C::Real,
    flatness: C::Real,
}

impl<C: Spectrum> Diffuse<C> {
    /// `weight`, `roughness`, `flatness` in `[0, 1]`.
    pub(super) fn new(base: C, weight: C::Real, roughness: C::Real, flatness: C::Real) -> Self {
        Self { color: base.scale(weight * C::Real::FRAC_1_PI), roughness, flatness }
    }

    /// Value for cosines above 0, `cos_d = wi·h`.
    #[inline]
    pub(super) fn eval(&self, cos_o: C::Real, cos_i: C::Real, cos_d: C::Real) -> C {
        let (one, half) = (<C::Real as Real>::ONE, C::Real::HALF);
        let (fo, fi) = (fifth_power(cos_o), fifth_power(cos_i));
        let retro = C::Real::TWO * self.roughness * cos_d * cos_d;
        let diffuse = (one - half * fi) * (one - half * fo);
        let returned = retro * (fo + fi + fo * fi * (retro - one));
        let mut shape = diffuse + returned;
        if self.flatness > C::Real::ZERO {
            let bend = retro * half - one;
            let s = (one + bend * fo) * (one + bend * fi);
            let flat = C::Real::lit(1.25) * (s * (one / (cos_o + cos_i) - half) + half);
            shape += self.flatness * (flat.min(C::Real::MAX) - shape);
        }
        // Not negative for unit vectors; others may make anything of the last term.
        self.color.scale(shape.clamp_to(C::Real::ZERO, C::Real::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_incidence_returns_the_colour_over_pi() {
        for flatness in [0.0, 0.5, 1.0] {
            let f = Diffuse::new(0.7_f64, 1.0, 0.4, flatness).eval(1.0, 1.0, 1.0);
            // f_ss there: 1.25 (0 + ½) = 0.625.
            let want = 0.7 * f64::FRAC_1_PI * (1.0 + flatness * (0.625 - 1.0));
            assert!((f - want).abs() < 1e-16, "{flatness} {f}");
        }
    }
}
