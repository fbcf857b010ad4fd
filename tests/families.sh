#!/usr/bin/env bash
# Compiles etendue-brdf, etendue-scene and etendue-renderer with combinations of their families, without warnings.
#
# usage: tests/families.sh [DEPTH]
#
# DEPTH limits how many families of models are combined; without it all 512 combinations are compiled, which takes minutes.
# Of scene and renderer each family is compiled by itself.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v cargo-hack >/dev/null || cargo install cargo-hack --locked --quiet
export RUSTFLAGS="-D warnings"
cargo hack check --package etendue-brdf --feature-powerset ${1:+--depth "$1"} \
  --features libm --exclude-features default,std,arch,alloc,serde,models
cargo hack check --package etendue-scene --package etendue-renderer --each-feature \
  --features libm --exclude-features default,std,arch
