#!/usr/bin/env bash
# The largest relMSE and difference of the means of eight pictures of a scene from its golden picture.
#
# usage: tests/golden/bounds.sh SCENE GOLDEN SIZE, as in
#        tests/golden/bounds.sh scenes/materials.xml tests/golden/materials.exr 64x32
set -euo pipefail
picture=$(mktemp --suffix .pfm)
trap 'rm "$picture"' EXIT
for seed in 0 1 2 3 4 5 6 7; do
  target/release/etendue render "$1" --size "$3" --spp 64 --seed $seed -q -o "$picture"
  target/release/etendue compare "$picture" "$2"
done | awk '/^relMSE/ && $2 > mse { mse = $2 }
  /^mean/ { d = $3 < 0 ? -$3 : $3; if (d > mean) mean = d }
  END { printf "%.3g %.3g %%\n", mse, mean }'
