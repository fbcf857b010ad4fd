//! Addressed random numbers, low-discrepancy sequences, warps and tabulated distributions.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(feature = "std", test))]
extern crate std;
