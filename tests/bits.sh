#!/usr/bin/env bash
# The same picture on every processor: builds étendue on the `libm` backend for three levels of x86-64, renders shipped scenes with each, with
# and without the instructions that glibc chooses at run time, and compares the pictures byte by byte. Takes 10 to 20 minutes, most of
# it compiling. With --std it shows that the `std` backend does not promise that.
set -euo pipefail
cd "$(dirname "$0")/.."

backend=libm features=(--no-default-features --features libm)
if [ "${1:-}" = --std ]; then backend=std features=(); fi
levels=(x86-64 x86-64-v3 x86-64-v4)
scenes=(cornell-box/scene.xml glass-and-metal.xml materials.xml effects/dispersion.xml effects/heterogeneous-medium.xml effects/environment-map.xml effects/motion-blur.xml)
# What glibc would use of the processor for its own functions.
without=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL,-AVX2_Usable,-FMA_Usable
target=${CARGO_TARGET_DIR:-target}/bits-$backend
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

has() { # LEVEL: whether this processor runs programs of that level
  case $1 in
    x86-64) true ;;
    x86-64-v3) grep -qm1 '\bavx2\b.*\bbmi2\b\|\bbmi2\b.*\bavx2\b' /proc/cpuinfo ;;
    x86-64-v4) grep -qm1 avx512vl /proc/cpuinfo ;;
  esac
}

failed=0
for level in "${levels[@]}"; do
  has "$level" || { echo "$level: left out, this processor does not have it"; continue; }
  # Optimised as a release, without the link-time optimisation that takes minutes and changes no bit. Names of symbols say whose they are.
  RUSTFLAGS="-C target-cpu=$level -C symbol-mangling-version=v0" CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 \
    cargo build --quiet --release --locked -p etendue-cli "${features[@]}" --target-dir "$target/$level"
  for tunables in "" "$without"; do
    for scene in "${scenes[@]}"; do
      for sampler in independent sobol; do
        picture=$work/${scene//\//-}-$sampler.pfm
        GLIBC_TUNABLES=$tunables "$target/$level/release/etendue" render "scenes/$scene" --size 96x72 --spp 8 \
          --sampler "$sampler" -q -o "$work/now.pfm"
        if [ ! -e "$picture" ]; then
          cp "$work/now.pfm" "$picture"
        elif ! cmp -s "$work/now.pfm" "$picture"; then
          echo "$scene, $sampler, $level${tunables:+, without what glibc chooses}: other bits"
          failed=$((failed + 1))
        fi
      done
    done
  done
  echo "$level: compared"
done

# Functions of the platform that are not exactly rounded: in our libraries none, in the program only where no bit of a picture that is
# rendered depends on them; DWA textures are the exception that docs/reliability.md states.
if [ "$backend" = libm ]; then
  release=$target/${levels[0]}/release
  inexact='(sin|cos|tan|asin|acos|atan|atan2|sincos|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|hypot|sinh|cosh|tanh|asinh|acosh|atanh)f?'
  undefined=$(find "$release/deps" -name 'libetendue_*.rlib' -exec nm --undefined-only {} + 2>/dev/null |
    grep -ohE "U $inexact(@.*)?$" | sort | uniq -c || true)
  # The platform's functions as what is measured, the progress bar's time left, lossy DWA compression of EXR files, HDR files that are written.
  harmless='etendue_accuracy9functions8families10elementary8backends|9indicatif5state|3exr11compression3dwa|5image6codecs3hdr7encoder'
  # The function that each mention of one stands in.
  callers=$(objdump -d --no-show-raw-insn "$release/etendue" |
    sed -nE "/^[0-9a-f]+ <(.*)>:$/{s//\1/;h;b}; /.*<$inexact@.*/{s/.*<([a-z0-9]+)@.*/\1/;G;s/(.*)\n(.*)/\2 calls \1/p}" |
    sort -u)
  [ -n "$callers" ] || { echo "no caller of the platform's functions is found, not even those that measure them"; failed=$((failed + 1)); }
  other=$(grep -vE "$harmless" <<<"$callers" || true)
  if [ -n "$undefined$other" ]; then
    echo "functions of the platform's library are called:"
    printf '%s\n' "$undefined" "$other" | sed '/^$/d'
    failed=$((failed + 1))
  else
    echo "no function of the platform's library whose bits depend on the processor is called where it could change a picture"
  fi
fi
[ "$failed" = 0 ] && echo "the same bits everywhere" || { echo "$failed differences"; exit 1; }
