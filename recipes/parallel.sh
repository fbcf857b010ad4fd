#!/usr/bin/env bash
# Renders a scene in parts with GNU parallel, on this machine or, with --sshlogin, on several that share a folder.
#
#     recipes/parallel.sh SCENE PARTS PICTURE [options of etendue render]
#
# A part that failed is tried three times. Started again, it draws only what is missing. JOBS is how many parts are drawn at a time (1,
# because one render uses all cores), PARALLEL further options of parallel, such as "--sshlogin a,b".
set -euo pipefail

scene=$1 parts=$2 picture=$3
shift 3
etendue=${ETENDUE:-etendue}
folder=$picture.parts
mkdir -p "$folder"

# shellcheck disable=SC2086 # several options in one variable
parallel --jobs "${JOBS:-1}" --retries 3 --halt now,fail=1 --joblog "$folder/log" ${PARALLEL:-} \
  "$etendue" render "$scene" --shard "{}/$parts" -o "$folder/{}.exr" -q "$@" ::: $(seq "$parts")
"$etendue" merge "$folder"/*.exr -o "$picture" -q
