//! Hashes of the results of every function and model, in WebAssembly.
#![no_std]

use core::fmt::{self, Write};
use core::panic::PanicInfo;

use etendue_specimens::bits::{LONG, all};

unsafe extern "C" {
    /// Takes one character of the output.
    safe fn print(character: u32);
}

struct Host;

impl Write for Host {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        text.chars().for_each(|c| print(c.into()));
        Ok(())
    }
}

/// Prints all hashes.
#[unsafe(no_mangle)]
pub extern "C" fn bits() {
    // Writing to the host cannot fail.
    all::<f32>(LONG, &mut |hash| _ = writeln!(Host, "{hash}"));
    all::<f64>(LONG, &mut |hash| _ = writeln!(Host, "{hash}"));
}

#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    core::arch::wasm32::unreachable()
}
