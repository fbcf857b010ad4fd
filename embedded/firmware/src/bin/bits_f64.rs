//! Prints hashes of the results of every function and model in `f64`.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use cortex_m_semihosting::hprintln;
use etendue_firmware::exit;
use etendue_specimens::bits;

#[entry]
fn main() -> ! {
    let inputs = bits::SHORT;
    bits::all::<f64>(inputs, &mut |hash| hprintln!("{}", hash));
    exit(true)
}
