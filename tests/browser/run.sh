#!/usr/bin/env bash
# Writes the reports of `etendue accuracy` and opens them in a headless browser: every plot drawn, no error, nothing asked of a
# network, readable on a telephone, light and dark.
#
# usage: tests/browser/run.sh [FOLDER FOR SCREENSHOTS]
#
# Needs node, npm and Chromium (CHROMIUM=PATH if it is not /usr/bin/chromium).
set -euo pipefail
screenshots=${1:+$(realpath "$1")}
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

etendue() { cargo run --release --locked --quiet --bin etendue -- "$@" >/dev/null; }
etendue accuracy functions --quick --quiet --html "$folder/functions.html"
etendue accuracy samplers --quick --quiet --html "$folder/samplers.html"
etendue accuracy scene scenes/cornell-box/scene.xml --size 24x24 --spp-max 8 --replications 4 --quiet --html "$folder/scene.html"

cd tests/browser
npm ci --silent --no-audit --no-fund
REPORTS="$folder/functions.html:$folder/samplers.html:$folder/scene.html" SCREENSHOTS=$screenshots node --test
