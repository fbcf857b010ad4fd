//! Calls one operation of one model many times: what instructions are counted and time is taken of.
//!
//! usage: calls MODEL nothing|eval|pdf|eval_pdf|sample f32|f64|rgb COUNT
//!
//! Prints the nanoseconds per call. `nothing` prepares the model and reads the inputs, as all do, and calls
//! nothing; `rgb` is `f32` in three channels.

use core::hint::black_box;
use std::env;
use std::process::ExitCode;
use std::time::Instant;

use etendue_brdf::Bsdf;
use etendue_math::{Real, Rgb, Spectrum};
use etendue_specimens::models::NAMES;
use etendue_specimens::{Each, Inputs, Specimen, Typical, Visitor, for_each};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let parsed = if let [model, operation, precision, count] = arguments.as_slice()
        && NAMES.contains(&model.as_str())
        && let Ok(count) = count.parse()
    {
        let calls = Calls { operation: operation.clone(), count };
        let mut request = Request { model, precision, calls, answer: None };
        for_each(&mut request);
        request.answer
    } else {
        None
    };
    let Some(nanoseconds) = parsed else {
        eprintln!("usage: calls MODEL nothing|eval|pdf|eval_pdf|sample f32|f64|rgb COUNT");
        eprintln!("models: {}", NAMES.join(" "));
        return ExitCode::from(2);
    };
    println!("{nanoseconds:.2}");
    ExitCode::SUCCESS
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
            "nothing" => self.time(|i: &Inputs<C::Real>| _ = black_box((i.wo, i.wi, i.u))),
            "eval" => self.time(|i: &Inputs<C::Real>| _ = black_box(model.eval(i.wo, i.wi))),
            "pdf" => self.time(|i: &Inputs<C::Real>| _ = black_box(model.pdf(i.wo, i.wi))),
            "eval_pdf" => {
                self.time(|i: &Inputs<C::Real>| _ = black_box(model.eval_pdf(i.wo, i.wi)))
            }
            "sample" => self.time(|i: &Inputs<C::Real>| {
                _ = black_box(model.sample(i.wo, i.u[2], [i.u[0], i.u[1]]));
            }),
            _ => return None,
        })
    }
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
