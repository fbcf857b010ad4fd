#!/usr/bin/env bash
# Runs what the only `unsafe` code is for, tracing rays with every SIMD backend of the processor, under AddressSanitizer, which finds accesses outside of
# what was allocated; and what Miri knows of it (portable, SSE2 and AVX2) under Miri, which finds all undefined behaviour.
#
# Needs a nightly compiler and `rustup +nightly component add miri rust-src`. Takes about 15 minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
host=x86_64-unknown-linux-gnu
target=${CARGO_TARGET_DIR:-target}

RUSTFLAGS="-Z sanitizer=address" \
  cargo +nightly test --locked --target "$host" --target-dir "$target/address" -p etendue-scene --lib -- geometry
# Miri has the features that a program is compiled for, and no AVX-512. The queues of rayon, which builds the hierarchy, do not fit the older of its
# two models of aliasing, and its threads never end.
MIRIFLAGS="-Zmiri-disable-isolation -Zmiri-tree-borrows -Zmiri-ignore-leaks" RUSTFLAGS="-C target-cpu=x86-64-v3" \
  cargo +nightly miri test --locked --target-dir "$target/miri-simd" -p etendue-scene --lib -- geometry::bvh::simd every_backend_finds
