#!/usr/bin/env bash
# Compiles etendue-brdf with every combination of its families of models, without warnings.
#
# usage: tests/families.sh [DEPTH]
#
# DEPTH limits how many families are combined; without it all 512 combinations are compiled, which takes minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
command -v cargo-hack >/dev/null || cargo install cargo-hack --locked --quiet
RUSTFLAGS="-D warnings" cargo hack check --package etendue-brdf --feature-powerset ${1:+--depth "$1"} \
  --features libm --exclude-features default,std,arch,alloc,serde,models
