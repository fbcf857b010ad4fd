//! Elementary functions of the two float backends.

use std::rc::Rc;

use crate::functions::domain::{Domain, linear, logarithmic, narrow};
use crate::functions::family::{ErrorKind, FamilyInfo, Setup};
use crate::functions::reference::DoubleDouble;
use crate::functions::variant::Variant;

pub(super) const SIN: FamilyInfo = FamilyInfo {
    name: "float-sin",
    title: "Float backends: sine",
    build: |effort| {
        let points = linear([0.01, 6.25], effort.choose(1000, 50)).map(|x| [x, 0.0]);
        let words = "x from 0.01 to 6.25";
        setup(words, points.collect(), backends::SIN, |[x, _]| x.sin())
    },
};

pub(super) const EXP: FamilyInfo = FamilyInfo {
    name: "float-exp",
    title: "Float backends: exponential",
    build: |effort| {
        let points = linear([-40.0, 10.0], effort.choose(1000, 50)).map(|x| [x, 0.0]);
        let words = "x from −40 to 10";
        setup(words, points.collect(), backends::EXP, |[x, _]| x.exp())
    },
};

pub(super) const LN: FamilyInfo = FamilyInfo {
    name: "float-ln",
    title: "Float backends: logarithm",
    build: |effort| {
        let points = logarithmic([1e-6, 100.0], effort.choose(1000, 50)).map(|x| [x, 0.0]);
        let words = "x from 1e-6 to 100, by its logarithm";
        setup(words, points.collect(), backends::LN, |[x, _]| x.ln())
    },
};

pub(super) const POWF: FamilyInfo = FamilyInfo {
    name: "float-powf",
    title: "Float backends: power",
    build: |effort| {
        let count = effort.choose(32, 6);
        let exponents = linear([0.3, 20.0], count);
        let points =
            linear([0.05, 0.99], count).flat_map(|x| exponents.clone().map(move |y| [x, y]));
        let words = "bases x from 0.05 to 0.99, exponents y from 0.3 to 20";
        setup(words, points.collect(), backends::POWF, |[x, y]| x.powf(y))
    },
};

/// A function of each backend in either precision; those of one argument ignore the second.
#[derive(Clone, Copy)]
struct Function {
    quantity: &'static str,
    std_f64: fn([f64; 2]) -> f64,
    libm_f64: fn([f64; 2]) -> f64,
    std_f32: fn([f32; 2]) -> f32,
    libm_f32: fn([f32; 2]) -> f32,
}

/// Both at once, which `Real` does not offer: it has the one that was chosen when the program was compiled.
#[allow(clippy::disallowed_methods, reason = "the platform's functions are what is measured")]
mod backends {
    use super::Function;

    pub(super) const SIN: Function = Function {
        quantity: "sin x",
        std_f64: |[x, _]| x.sin(),
        libm_f64: |[x, _]| libm_crate::sin(x),
        std_f32: |[x, _]| x.sin(),
        libm_f32: |[x, _]| libm_crate::sinf(x),
    };
    pub(super) const EXP: Function = Function {
        quantity: "eˣ",
        std_f64: |[x, _]| x.exp(),
        libm_f64: |[x, _]| libm_crate::exp(x),
        std_f32: |[x, _]| x.exp(),
        libm_f32: |[x, _]| libm_crate::expf(x),
    };
    pub(super) const LN: Function = Function {
        quantity: "ln x",
        std_f64: |[x, _]| x.ln(),
        libm_f64: |[x, _]| libm_crate::log(x),
        std_f32: |[x, _]| x.ln(),
        libm_f32: |[x, _]| libm_crate::logf(x),
    };
    pub(super) const POWF: Function = Function {
        quantity: "xʸ",
        std_f64: |[x, y]| x.powf(y),
        libm_f64: |[x, y]| libm_crate::pow(x, y),
        std_f32: |[x, y]| x.powf(y),
        libm_f32: |[x, y]| libm_crate::powf(x, y),
    };
}

fn setup(
    words: &str,
    points: Vec<[f64; 2]>,
    function: Function,
    exact: fn([DoubleDouble; 2]) -> DoubleDouble,
) -> Setup {
    let domain = Rc::new(Domain {
        words: words.to_owned(),
        points: points.into_iter().map(|point| point.map(narrow)).collect(),
        place: |&[x, y]: &[f64; 2]| {
            if y == 0.0 { format!("x {x:.4}") } else { format!("x {x:.4}, y {y:.3}") }
        },
        probes: Vec::new(),
    });
    let wide = |name, f: fn([f64; 2]) -> f64| {
        Variant::new(name, &domain, |&p: &[f64; 2]| p, move |&p| f(p))
    };
    let single = |name, f: fn([f32; 2]) -> f32| {
        Variant::new(name, &domain, |p: &[f64; 2]| p.map(|x| x as f32), move |&p| f(p))
    };
    Setup {
        quantity: function.quantity,
        judged_by: ErrorKind::RmsRelative,
        variants: vec![
            wide("std", function.std_f64),
            wide("libm", function.libm_f64),
            single("std", function.std_f32),
            single("libm", function.libm_f32),
        ],
        // An ulp.
        bound: 2.3e-16,
        ground: Box::new(Rc::clone(&domain)),
        reference: "series in arithmetic of 106 bits",
        compute: domain.reference(move |point| exact(point.map(DoubleDouble::from)).to_f64()),
        prose: vec!["Each is called through a pointer, which costs all of them the same."],
        advice: "Both backends are within an ulp; they differ in what they promise, and in speed, for the most part in \
                 favour of `std`. `std`, the platform's, where time counts. `libm` where the bits of a picture must be \
                 the same on every processor, or where there is no platform.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::functions::reference::Effort;

    #[test]
    fn every_pointer_of_a_function_is_to_the_same_one() {
        for f in [backends::SIN, backends::EXP, backends::LN, backends::POWF] {
            let want = (f.std_f64)([0.7, 1.3]);
            assert!(((f.libm_f64)([0.7, 1.3]) / want - 1.0).abs() < 1e-15, "{}", f.quantity);
            for single in [f.std_f32, f.libm_f32] {
                // Arguments rounded to f32.
                assert!(
                    (f64::from(single([0.7, 1.3])) / want - 1.0).abs() < 1e-6,
                    "{}",
                    f.quantity
                );
            }
        }
    }

    #[test]
    fn quick_and_full_runs_have_points() {
        for info in [SIN, EXP, LN, POWF] {
            let [full, quick] =
                [Effort::Full, Effort::Quick].map(|e| info.family(e).setup.ground.len());
            assert!(full > quick && quick > 0, "{}", info.name);
        }
    }
}
