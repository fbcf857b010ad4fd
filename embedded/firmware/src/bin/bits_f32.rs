//! Prints hashes of the results of functions and models in `f32`.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use etendue_firmware::{exit, print_bits};
use etendue_specimens::bits;

#[entry]
fn main() -> ! {
    print_bits::<f32>(if cfg!(feature = "long") { bits::LONG } else { bits::SHORT });
    exit(true)
}
