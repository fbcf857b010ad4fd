#!/usr/bin/env bash
# Attacks every model, and the functions below them, for some seconds each.
#
# usage: fuzz/run.sh [SECONDS [MODEL…]]
#
# Needs `cargo install cargo-fuzz`, a nightly compiler and a C++ compiler. A finding is printed and written to
# fuzz/artifacts; the other models are attacked all the same, and the exit code is 1.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-20}
shift || true
models=("$@")
if [ ${#models[@]} = 0 ]; then
  mapfile -t models < <(sed -n 's/^    [A-Za-z]* "\([^"]*\)" |.*/\1/p' crates/specimens/src/models.rs)
fi

failures=0
attack() { # TARGET MAX_LEN
  nice cargo +nightly fuzz run "$1" -- -max_total_time="$seconds" -max_len="$2" -len_control=0 \
    -timeout=20 -print_final_stats=1 2>&1 | tee fuzz/artifacts/log |
    sed -n 's/stat::number_of_executed_units: */executions /p; /panicked/,/stack backtrace/p; /ERROR: libFuzzer/p' || failures=$((failures + 1))
}

mkdir -p fuzz/artifacts
cargo +nightly fuzz build
for model in "${models[@]}"; do
  echo "== $model"
  MODEL=$model attack models 256
done
echo "== functions"
attack functions 64
[ "$failures" = 0 ] || { echo "$failures with findings, see fuzz/artifacts"; exit 1; }
