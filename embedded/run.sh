#!/usr/bin/env bash
# Proves that the core crates compute the same on other processors as here.
#
# usage: embedded/run.sh [--long]
#
# On a Cortex-M4F (Arm MPS2 AN386) and a Cortex-M0 (BBC micro:bit), both simulated by QEMU, the firmware compares rows
# of exact values with what it computes. There, and in WebAssembly under Node, hashes of the results of every function
# and model must be those of crates/brdf/tests/bits.txt, which a test of that crate holds this machine to.
# --long hashes 500 000 inputs per function in f32 on the Cortex-M4F too, instead of 4096 (some minutes).
#
# Needs qemu-system-arm and the targets of the first command; without node WebAssembly is built only.
set -euo pipefail
cd "$(dirname "$0")"
features=()
[ "${1:-}" = --long ] && features=(--features long)

rustup -q target add thumbv7em-none-eabihf thumbv6m-none-eabi wasm32-unknown-unknown
command -v qemu-system-arm >/dev/null || { echo "qemu-system-arm is missing (Debian: apt-get install qemu-system-arm)" >&2; exit 1; }

pinned=../crates/brdf/tests/bits.txt
failures=0

verdict() { # NAME PASSED|FAILED DETAIL
  printf '%-34s %s  %s\n' "$1" "$2" "$3"
  [ "$2" = passed ] || failures=$((failures + 1))
}

simulate() { # PROGRAM
  timeout 1200 qemu-system-arm -machine "$machine" -cpu "$cpu" -nographic -monitor none -serial none \
    -semihosting-config enable=on,target=native -kernel "firmware/target/$target/release/$1"
}

compare() { # NAME OUTPUT
  local lines different
  lines=$(grep -c . <<<"$2" || true)
  different=$(grep . <<<"$2" | grep -vxFf "$pinned" || true)
  if [ "$lines" -gt 50 ] && [ -z "$different" ]; then
    verdict "$1" passed "$lines hashes"
  else
    verdict "$1" FAILED "$lines hashes; not in bits.txt:"
    echo "$different"
  fi
}

for board in "Cortex-M4F thumbv7em-none-eabihf mps2-an386 cortex-m4" "Cortex-M0 thumbv6m-none-eabi microbit cortex-m0"; do
  read -r name target machine cpu <<<"$board"
  # Hashing for minutes is for the processor with a floating-point unit.
  [ "$name" = Cortex-M4F ] || features=()
  (cd firmware && cargo build --quiet --release --locked --target "$target" --bin golden)
  if output=$(simulate golden); then verdict "$name exact values" passed "$output"; else verdict "$name exact values" FAILED "$output"; fi
  # What does not fit into its flash at once is hashed in parts.
  parts=("")
  [ "$name" = Cortex-M4F ] || parts=(functions a-k l-p q-z)
  hashes_f32= hashes_f64=
  for part in "${parts[@]}"; do
    (cd firmware && PART=$part cargo build --quiet --release --locked --target "$target" --bin bits_f32 --bin bits_f64 ${features[@]+"${features[@]}"})
    hashes_f32+=$(simulate bits_f32 || true)$'\n'
    hashes_f64+=$(simulate bits_f64 || true)$'\n'
  done
  compare "$name bits f32" "$hashes_f32"
  compare "$name bits f64" "$hashes_f64"
done

(cd wasm && cargo build --quiet --release --locked --target wasm32-unknown-unknown)
if command -v node >/dev/null; then
  compare "WebAssembly bits" "$(node wasm/run.mjs wasm/target/wasm32-unknown-unknown/release/etendue_wasm.wasm || true)"
else
  echo "WebAssembly: built, not run: there is no node"
fi
[ "$failures" = 0 ] && echo "all passed" || { echo "$failures failed"; exit 1; }
