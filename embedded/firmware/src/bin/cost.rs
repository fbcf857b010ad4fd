//! Prints how many instructions the model `MODEL` takes per call, and contains no other one.
//!
//! Without a model it is the program that sizes are compared with: it calls one that scatters nothing.
//! With `CALLS=eval` it only evaluates. Under `qemu -icount shift=10` an
//! instruction lasts 1024 ns and SysTick advances with the board's clock, which makes ticks a count of
//! instructions: not cycles, but the same in every run.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::peripheral::{Peripherals, SYST};
use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use etendue_brdf::{Bsdf, Lobes, Sample};
use etendue_firmware::exit;
use etendue_math::glam::Vec3;
use etendue_specimens::{Each, Inputs, Specimen, Typical, Visitor, for_each};

/// How many calls are averaged.
const CALLS: usize = 32;

#[entry]
fn main() -> ! {
    let timer = Peripherals::take().map(|p| Timer::new(p.SYST));
    if let Some(timer) = &timer {
        if const { env!("MODEL").is_empty() } {
            Calls { timer }.visit(&Nothing);
        }
        for_each(&mut Chosen { timer });
    }
    exit(timer.is_some())
}

struct Timer {
    /// Ticks of taking the time and of nothing in between.
    nothing: u32,
    /// Ticks of a thousand instructions.
    thousand: u32,
}

impl Timer {
    fn new(mut counter: SYST) -> Self {
        counter.set_clock_source(SystClkSource::Core);
        counter.set_reload(0x00ff_ffff);
        counter.clear_current();
        counter.enable_counter();
        let nothing = Self { nothing: 0, thousand: 0 }.ticks(|| ());
        let timer = Self { nothing, thousand: 0 };
        Self { thousand: timer.ticks(thousand_instructions), ..timer }
    }

    #[inline(always)]
    fn ticks<R>(&self, work: impl FnOnce() -> R) -> u32 {
        let start = SYST::get_current();
        black_box(work());
        let end = SYST::get_current();
        (start.wrapping_sub(end) & 0x00ff_ffff).saturating_sub(self.nothing)
    }

    fn instructions(&self, ticks: u64) -> u64 {
        ticks * 1000 / u64::from(self.thousand.max(1))
    }
}

fn thousand_instructions() {
    // Two instructions per turn (subtract and branch), and nothing else that counts.
    cortex_m::asm::delay(1000);
}

struct Chosen<'a> {
    timer: &'a Timer,
}

impl Each for Chosen<'_> {
    #[inline(always)]
    fn each<S: Specimen>(&mut self) {
        if const { same(S::NAME, env!("MODEL")) } {
            let calls = Calls { timer: self.timer };
            let _ = S::show::<f32, _>(&mut Typical, calls);
        }
    }
}

/// What is there when no model is.
struct Nothing;

impl Bsdf for Nothing {
    type Color = f32;

    fn lobes(&self) -> Lobes {
        Lobes::default()
    }

    fn sample(&self, _: Vec3, _: f32, _: [f32; 2]) -> Option<Sample<f32>> {
        None
    }
}

struct Calls<'a> {
    timer: &'a Timer,
}

impl Visitor<f32> for Calls<'_> {
    type Output = ();

    #[inline(always)]
    fn visit(self, model: &impl Bsdf<Color = f32>) {
        let (mut evaluation, mut sampling) = (0, 0);
        for i in 0..CALLS {
            let inputs = Inputs::<f32>::above(i as u64);
            // Opaque between the two readings of the time, so that no work moves out of there.
            let opaque = || black_box(inputs);
            evaluation += u64::from(self.timer.ticks(|| {
                let i = opaque();
                model.eval_pdf(i.wo, i.wi)
            }));
            if const { same(env!("CALLS"), "eval") } {
                continue;
            }
            sampling += u64::from(self.timer.ticks(|| {
                let i = opaque();
                model.sample(i.wo, i.u[2], [i.u[0], i.u[1]])
            }));
        }
        let mean = |ticks| self.timer.instructions(ticks) / CALLS as u64;
        hprintln!("eval_pdf {} sample {}", mean(evaluation), mean(sampling));
    }
}

const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}
