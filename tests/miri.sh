#!/usr/bin/env bash
# Runs the core crates under Miri, which finds undefined behaviour in them and in what they call (glam uses SIMD).
#
# usage: tests/miri.sh [TARGET]
#
# * the unit tests of etendue-math;
# * the bits of every function and model over 64 inputs in f32 and f64: all code paths of the three crates, on the
#   libm backend, because Miri varies the last bits of std's functions on purpose;
# * every sixteenth row of exact values.
# The statistical tests of etendue-sampling and etendue-brdf call the same functions millions of times, which would take
# an interpreter hours: they are left out.
#
# With a target such as s390x-unknown-linux-gnu the same runs on a big-endian processor.
# Needs a nightly compiler and `rustup +nightly component add miri rust-src`.
set -euo pipefail
cd "$(dirname "$0")/.."
# The tests read files of exact values and of bits.
export MIRIFLAGS="${MIRIFLAGS:-} -Zmiri-disable-isolation"
target=(${1:+--target "$1"})
libm=(--no-default-features --features libm)

cargo +nightly miri test "${target[@]}" "${libm[@]}" -p etendue-math --lib
cargo +nightly miri test "${target[@]}" "${libm[@]}" -p etendue-brdf --test bits --test golden
