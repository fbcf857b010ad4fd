//! The functions below the models: no input makes them panic.
#![no_main]

use etendue_math::{Vec3, Vector3};
use etendue_specimens::bits::Results;
use etendue_specimens::functions::functions;
use etendue_specimens::{Hostile, Inputs, Scalar};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut source = Hostile::new(data);
    let [choice] = source.bytes();
    if choice % 2 == 0 { call::<f32>(choice / 2, source) } else { call::<f64>(choice / 2, source) }
});

fn call<T: Scalar>(choice: u8, mut source: Hostile) {
    let functions = functions::<T>();
    let (_, function) = functions[choice as usize % functions.len()];
    let mut direction = || Vec3::<T>::new(source.raw(), source.raw(), source.raw());
    let (wo, wi) = (direction(), direction());
    let inputs = Inputs { index: 0, wo, wi, u: [(); 3].map(|()| source.raw()) };
    function(&inputs, &mut Results::default());
}
