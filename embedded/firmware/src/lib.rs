//! What the programs share: how they end, and what is hashed.
#![no_std]

use core::panic::PanicInfo;

use cortex_m_semihosting::{debug, hprintln};
use etendue_specimens::{Scalar, bits};

/// Ends the simulation with exit code 0 or 1.
pub fn exit(passed: bool) -> ! {
    debug::exit(if passed { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
    loop {
        cortex_m::asm::wfi();
    }
}

/// Prints hashes of the results in one precision: of everything, or of the part that the environment variable `PART`
/// named when this was compiled, because a board with 256 KiB of flash does not hold everything at once.
pub fn print_bits<T: Scalar>(inputs: u64) {
    const PART: &[u8] = env!("PART").as_bytes();
    let report = &mut |hash| hprintln!("{}", hash);
    match PART {
        b"" => bits::all::<T>(inputs, report),
        b"functions" => bits::all_functions::<T>(inputs, report),
        b"a-k" => bits::models_between::<T, b'a', b'k'>(inputs, report),
        b"l-p" => bits::models_between::<T, b'l', b'p'>(inputs, report),
        b"q-z" => bits::models_between::<T, b'q', b'z'>(inputs, report),
        _ => panic!("PART must be functions, a-k, l-p or q-z"),
    }
}

#[panic_handler]
fn panic(info: &PanicInfo) -> ! {
    hprintln!("{}", info);
    exit(false)
}
