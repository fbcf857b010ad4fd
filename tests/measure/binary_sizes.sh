#!/usr/bin/env bash
# Bytes of the smallest renderer, of what each family adds to it, and of the command, in release and without symbols;
# with valgrind the instructions of the smallest renderer with nothing and with everything compiled in.
#
# usage: tests/measure/binary_sizes.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

build() { # FEATURES: the smallest renderer with them
  cargo build --quiet --release -p etendue-renderer --example minimal --no-default-features --features "std${1:+,$1}"
}
size() { # PROGRAM
  local stripped
  stripped=$(mktemp)
  strip -o "$stripped" "$1"
  stat -c %s "$stripped"
  rm "$stripped"
}
instructions() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null target/release/examples/minimal 2>&1 >/dev/null \
    | sed -n 's/.*Collected *: *//p'
}
count() { # FEATURES
  build "$1"
  if command -v valgrind >/dev/null; then instructions; else echo unknown; fi
}

build ""
least=$(size target/release/examples/minimal)
echo "minimal $least"
for family in smooth rough layered principled composed dispersion; do
  build "etendue-scene/$family"
  echo "with $family $(($(size target/release/examples/minimal) - least))"
done
for family in volumes spectral; do
  build "$family"
  echo "with $family $(($(size target/release/examples/minimal) - least))"
done
everything=materials,spectral,volumes
build "$everything"
echo "everything $(size target/release/examples/minimal)"
cargo build --quiet --release -p etendue-cli
echo "etendue $(size target/release/etendue)"
echo "instructions with nothing: $(count ""), with everything: $(count "$everything")"
