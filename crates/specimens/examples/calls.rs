//! Calls one operation of one model many times: what instructions are counted and time is taken of.
//!
//! usage: calls MODEL nothing|eval|pdf|eval_pdf|sample|results f32|f64|rgb COUNT
//!
//! Prints the nanoseconds per call. `nothing` prepares the model and goes through the inputs, as all do, and
//! calls nothing; `rgb` is `f32` in three channels. `results` takes no time: it prints a line for each of
//! COUNT inputs: `wo`, `wi`, two uniforms, value, density, and direction, weight and density of the sample (zeros
//! where there is none). The models are the specimens, and `rough-conductor/separable` besides.

use core::hint::black_box;
use std::env;
use std::process::ExitCode;
use std::time::Instant;

use etendue_brdf::{
    Alpha, Bsdf, ComplexIor, Density, Distribution, Masking, Microfacets, ParameterError,
    RoughConductor,
};
use etendue_math::{Real, Rgb, Spectrum, Vector3};
use etendue_specimens::models::NAMES;
use etendue_specimens::{Each, Inputs, Parameters, Specimen, Typical, Visitor, for_each};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let parsed = if let [model, operation, precision, count] = arguments.as_slice()
        && let Ok(count) = count.parse()
    {
        let calls = Calls { operation: operation.clone(), count };
        let mut request = Request { model, precision, calls, answer: None };
        for_each(&mut request);
        request.each::<Separable>();
        request.answer
    } else {
        None
    };
    let Some(nanoseconds) = parsed else {
        eprintln!("usage: calls MODEL nothing|eval|pdf|eval_pdf|sample|results f32|f64|rgb COUNT");
        eprintln!("models: {} {}", NAMES.join(" "), Separable::NAME);
        return ExitCode::from(2);
    };
    if nanoseconds > 0.0 {
        println!("{nanoseconds:.2}");
    }
    ExitCode::SUCCESS
}

/// The specimen of a rough conductor with the masking that other renderers have: what they are compared with.
struct Separable;

impl Specimen for Separable {
    const NAME: &'static str = "rough-conductor/separable";

    #[inline]
    fn show<C: Spectrum, V: Visitor<C>>(
        p: &mut impl Parameters,
        visitor: V,
    ) -> Result<V::Output, ParameterError> {
        let metal = ComplexIor::new(C::splat(p.number(0.24)), C::splat(p.number(3.34)))?;
        let [x, y] = [Alpha::new(p.number(0.3))?, Alpha::new(p.number(0.2))?];
        let facets = Microfacets::new(Distribution::Ggx, x, y, Masking::Separable);
        Ok(visitor.visit(&RoughConductor::new(metal, facets)))
    }
}

struct Request<'a> {
    model: &'a str,
    precision: &'a str,
    calls: Calls,
    answer: Option<f64>,
}

impl Each for Request<'_> {
    fn each<S: Specimen>(&mut self) {
        if S::NAME == self.model {
            let calls = self.calls.clone();
            self.answer = match self.precision {
                "f32" => S::show::<f32, _>(&mut Typical, calls).ok().flatten(),
                "f64" => S::show::<f64, _>(&mut Typical, calls).ok().flatten(),
                "rgb" => S::show::<Rgb<f32>, _>(&mut Typical, calls).ok().flatten(),
                _ => None,
            };
        }
    }
}

#[derive(Clone)]
struct Calls {
    operation: String,
    count: usize,
}

impl<C: Spectrum> Visitor<C> for Calls {
    /// Nanoseconds per call, or nothing where the operation is unknown.
    type Output = Option<f64>;

    fn visit(self, model: &impl Bsdf<Color = C>) -> Option<f64> {
        let model = black_box(model);
        Some(match self.operation.as_str() {
            "nothing" => self.time(|i: &Inputs<C::Real>| _ = black_box(i)),
            "eval" => self.time(|i: &Inputs<C::Real>| _ = black_box(model.eval(i.wo, i.wi))),
            "pdf" => self.time(|i: &Inputs<C::Real>| _ = black_box(model.pdf(i.wo, i.wi))),
            "eval_pdf" => {
                self.time(|i: &Inputs<C::Real>| _ = black_box(model.eval_pdf(i.wo, i.wi)))
            }
            "sample" => self.time(|i: &Inputs<C::Real>| {
                _ = black_box(model.sample(i.wo, i.u[2], [i.u[0], i.u[1]]));
            }),
            "results" => {
                (0..self.count as u64).for_each(|i| print(model, &Inputs::above(i)));
                0.0
            }
            _ => return None,
        })
    }
}

/// One line of `results`.
fn print<C: Spectrum>(model: &impl Bsdf<Color = C>, inputs: &Inputs<C::Real>) {
    let &Inputs { wo, wi, u, .. } = inputs;
    let mut numbers = vec![wo.x(), wo.y(), wo.z(), wi.x(), wi.y(), wi.z(), u[0], u[1]];
    let (value, pdf) = model.eval_pdf(wo, wi);
    numbers.extend([value.channel(0), pdf]);
    let sampled = model.sample(wo, u[2], [u[0], u[1]]).map(|sample| {
        let (Density::Continuous(pdf) | Density::Delta(pdf)) = sample.density;
        [sample.wi.x(), sample.wi.y(), sample.wi.z(), sample.weight.channel(0), pdf]
    });
    numbers.extend(sampled.unwrap_or([Real::ZERO; 5]));
    let words: Vec<_> = numbers.into_iter().map(|x| format!("{:e}", x.to_f64())).collect();
    println!("{}", words.join(" "));
}

impl Calls {
    fn time<T: Real>(&self, call: impl Fn(&Inputs<T>)) -> f64 {
        let inputs: Vec<_> = (0..256).map(Inputs::<T>::above).collect();
        let start = Instant::now();
        for _ in 0..self.count.div_ceil(inputs.len()) {
            for inputs in black_box(inputs.as_slice()) {
                call(inputs);
            }
        }
        start.elapsed().as_secs_f64() * 1e9 / self.count.next_multiple_of(inputs.len()) as f64
    }
}
