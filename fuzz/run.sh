#!/usr/bin/env bash
# Attacks every model, the functions below them and every loader, for some seconds each, and prints what came of it.
#
# usage: fuzz/run.sh [SECONDS [NAME…]]
#
# A NAME is a model, `functions`, a loader, or `loaders` for all of these; without any all are attacked. With the variable TOTAL set,
# that many seconds are divided among them. One process at a time, which may take 1 GiB and 10 s for an input of at most 1 MiB.
#
# Needs `cargo install cargo-fuzz`, a nightly compiler and a C++ compiler. Seeds are small valid files that the project makes
# (crates/scene/tests/samples). A finding is printed and written to fuzz/artifacts; the others are attacked all the same, and the exit
# code is 1.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-20}
shift || true
images=(png jpg bmp tga hdr exr pfm)
loaders=(xml scene gltf obj mtl ply serialized curves vol "${images[@]}")
names=()
for name in "$@"; do
  if [ "$name" = loaders ]; then names+=("${loaders[@]}"); else names+=("$name"); fi
done
if [ ${#names[@]} = 0 ]; then
  mapfile -t names < <(sed -n 's/^    [A-Za-z]* "\([^"]*\)" |.*/\1/p' crates/specimens/src/models.rs)
  names+=(functions "${loaders[@]}")
fi
seconds=$((${TOTAL:-$((seconds * ${#names[@]}))} / ${#names[@]}))

mkdir -p fuzz/artifacts fuzz/corpus
cargo run -q --release -p etendue-scene --example fuzz_seeds -- fuzz/corpus
cp tests/scenes/plugins/*.xml fuzz/corpus/xml
cp scenes/gltf/*.gltf fuzz/corpus/gltf
for scene in tests/scenes/*.xml tests/scenes/plugins/*.xml; do
  # Their assets are beside the scenes that are attacked.
  sed 's#"[./]*assets/#"#' "$scene" >"fuzz/corpus/scene/$(basename "$scene")"
done
cargo +nightly fuzz build

failures=0
table="| target | seconds | executions | edges | features | corpus | peak MiB | findings |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"

attack() { # NAME TARGET MAX_LEN [DICTIONARY]
  local log=fuzz/artifacts/log corpus=fuzz/corpus/$1 findings=fuzz/artifacts/$1/
  local dictionary=fuzz/dictionaries/${4:-}.dict
  mkdir -p "$corpus" "$findings"
  local options=(-max_total_time="$seconds" -max_len="$3" -timeout=10 -rss_limit_mb=1024 -print_final_stats=1
    -artifact_prefix="$findings")
  [ "$3" -gt 256 ] || options+=(-len_control=0)
  [ ! -f "$dictionary" ] || options+=(-dict="$dictionary")
  nice cargo +nightly fuzz run "$2" "$corpus" -- "${options[@]}" >"$log" 2>&1 || {
    failures=$((failures + 1))
    sed -n '/panicked/,/stack backtrace/p; /ERROR: libFuzzer/p; /SUMMARY/p' "$log"
  }
  local statistic='s/^stat::number_of_executed_units: *//p'
  local last
  last=$(grep -a 'cov: ' "$log" | tail -1)
  field() { sed -n "s/.*$1: \([0-9]*\).*/\1/p" <<<"$last"; }
  table+="
| $1 | $seconds | $(sed -n "$statistic" "$log") | $(field cov) | $(field ft) | $(find "$corpus" -type f | wc -l) \
| $(sed -n 's/^stat::peak_rss_mb: *//p' "$log") | $(find "$findings" -type f | wc -l) |"
}

for name in "${names[@]}"; do
  echo "== $name"
  case $name in
    functions) attack functions functions 64 ;;
    xml | scene) attack "$name" "$name" 1048576 xml ;;
    obj | mtl | ply) attack "$name" "$name" 1048576 "$name" ;;
    gltf) attack gltf gltf 1048576 json ;;
    serialized | curves | vol) attack "$name" "$name" 1048576 ;;
    png | jpg | bmp | tga | hdr | exr | pfm) KIND=$name attack "$name" image 1048576 ;;
    *) MODEL=$name attack "$name" models 256 ;;
  esac
done
echo "$table"
[ "$failures" = 0 ] || { echo "$failures with findings, see fuzz/artifacts"; exit 1; }
