#!/usr/bin/env bash
# Bytes of the smallest renderer and of the command, in release and without symbols.
set -euo pipefail
cd "$(dirname "$0")/../.."
cargo build --quiet --release -p etendue-renderer --example minimal
cargo build --quiet --release -p etendue-cli
for program in target/release/examples/minimal target/release/etendue; do
  stripped=$(mktemp)
  strip -o "$stripped" "$program"
  echo "$(basename "$program") $(stat -c %s "$stripped")"
  rm "$stripped"
done
