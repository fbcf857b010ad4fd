//! Time of `eval`, `pdf`, `eval_pdf` and `sample` of every model in both precisions, over 256 pairs of
//! directions above the surface.
//!
//! `cargo bench -p etendue-brdf --bench models` measures the `std` backend, with
//! `--no-default-features --features libm` the other; a trailing `-- rough-conductor/f32` restricts the run.

use core::hint::black_box;
use core::time::Duration;

use criterion::{Criterion, Throughput};
use etendue_brdf::Bsdf;
use etendue_math::Real;
use etendue_specimens::{Each, Inputs, Scalar, Specimen, Typical, Visitor, for_each};

struct Benches<'a>(&'a mut Criterion);

impl Each for Benches<'_> {
    fn each<S: Specimen>(&mut self) {
        bench::<f32, S>(self.0);
        bench::<f64, S>(self.0);
    }
}

fn bench<T: Scalar, S: Specimen>(criterion: &mut Criterion) {
    let visitor = Bench { criterion, name: format!("{}/{}", S::NAME, T::NAME) };
    S::show::<T, _>(&mut Typical, visitor).expect("typical parameters are valid");
}

struct Bench<'a> {
    criterion: &'a mut Criterion,
    name: String,
}

impl<T: Scalar> Visitor<T> for Bench<'_> {
    type Output = ();

    fn visit(self, model: &impl Bsdf<Color = T>) {
        let inputs: Vec<_> = (0..256).map(Inputs::<T>::above).collect();
        let model = black_box(model);
        let mut group = self.criterion.benchmark_group(&self.name);
        group.throughput(Throughput::Elements(inputs.len() as u64));
        let mut over = |name: &str, call: &dyn Fn(&[Inputs<T>])| {
            group.bench_function(name, |bencher| bencher.iter(|| call(black_box(&inputs))));
        };
        over("eval", &|inputs| each(inputs, |i| model.eval(i.wo, i.wi)));
        over("pdf", &|inputs| each(inputs, |i| model.pdf(i.wo, i.wi)));
        over("eval_pdf", &|inputs| each(inputs, |i| model.eval_pdf(i.wo, i.wi)));
        over("sample", &|inputs| each(inputs, |i| model.sample(i.wo, i.u[2], [i.u[0], i.u[1]])));
        group.finish();
    }
}

fn each<T: Real, R>(inputs: &[Inputs<T>], call: impl Fn(&Inputs<T>) -> R) {
    for inputs in inputs {
        black_box(call(inputs));
    }
}

fn main() {
    // Every model in both precisions in a few minutes.
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(400))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    for_each(&mut Benches(&mut criterion));
    criterion.final_summary();
}
