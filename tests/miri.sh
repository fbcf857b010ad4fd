#!/usr/bin/env bash
# Runs the core crates under Miri, which finds undefined behaviour in them and in what they call (glam uses SIMD).
#
# usage: tests/miri.sh [TARGET]
#
# * the unit tests of etendue-math and etendue-sampling but for statistics, with fewer arguments where cfg(miri); on the libm
#   backend, and on std, whose sines, powers and exponentials Miri varies in their last bits on purpose: a test whose
#   tolerance holds for one library only fails there;
# * the bits of every function and model over 64 inputs in f32 and f64: all code paths of the three crates, on libm. Each is
#   printed as it is done; tables that are integrated (rough plastic) take half an hour;
# * every sixteenth row of exact values but for albedos, which are integrals, on libm.
# The statistical tests, and the laws that etendue-brdf integrates, call the same functions millions of times, which would
# take an interpreter hours: they are left out.
#
# With a target such as s390x-unknown-linux-gnu the same runs on a big-endian processor.
# Needs a nightly compiler and `rustup +nightly component add miri rust-src`.
set -euo pipefail
cd "$(dirname "$0")/.."
# The tests read files of exact values and of bits.
export MIRIFLAGS="${MIRIFLAGS:-} -Zmiri-disable-isolation"
target=(${1:+--target "$1"})
libm=(--no-default-features --features libm)
# Names of statistical tests: counts, correlations and convergence.
statistics=()
for name in evenly uncorrelated as_often_as flip a_digit_depends direction_numbers independent_points elementary_interval; do statistics+=(--skip "$name"); done

cargo +nightly miri test "${target[@]}" "${libm[@]}" -p etendue-math -p etendue-sampling --lib -- "${statistics[@]}"
# An exponent of 70 makes 150 ε of the 3 ε that Miri adds to a logarithm.
cargo +nightly miri test "${target[@]}" -p etendue-math -p etendue-sampling --lib -- "${statistics[@]}" --skip incomplete_beta
cargo +nightly miri test "${target[@]}" "${libm[@]}" -p etendue-brdf --test bits --test golden -- --nocapture
