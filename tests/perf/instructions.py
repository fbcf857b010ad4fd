#!/usr/bin/env python3
"""Instructions of small renders of the reference scenes: a measure that a busy machine does not disturb, so that regressions show.

usage: instructions.py [--etendue target/release/etendue] [--threshold 1.02] [--store]

Counts the instructions of a picture of 32² pixels and 4 samples, of one with a single sample of a single pixel, and compares

start    the latter: reading, building, writing
sample   the difference by the number of samples

with tests/perf/instructions.json, which --store writes. Exits with 1 if a ratio, new over stored, exceeds the threshold. Needs
valgrind, which knows no AVX-512: counted is what the program does on processors with AVX2. Meshes are small (5000 triangles), for
valgrind is slow. Counts differ between compilers, whose version is stored along; those of one binary by some 10⁻⁴.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

import documents
import program
import scenes

STORED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "instructions.json")
SIZE, SPP = 32, 4


def count(binary, scene, output, *arguments):
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    command += program.command(binary, scene, output, "--size", f"{SIZE}x{SIZE}", *arguments)
    counted = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"refs:\s*([\d,]+)", counted).group(1).replace(",", ""))


def counts(binary, options):
    """`start` and `sample` of every scene."""
    counted = {}
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "picture.pfm")
        for name in scenes.SCENES:
            scene = scenes.write(folder, name, options)
            start = count(binary, scene, output, *program.FIRST_PIXEL)
            whole = count(binary, scene, output, "--spp", SPP)
            counted[name] = {"start": start, "sample": round((whole - start) / (SIZE * SIZE * SPP - 1))}
            print(f"{name}: {counted[name]}", file=sys.stderr, flush=True)
    return counted


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--threshold", type=float, default=1.02)
    parser.add_argument("--store", action="store_true")
    scenes.add_options(parser, triangles=5000, lights=1024)
    options = parser.parse_args()
    counted = counts(options.etendue, options)
    compiler = subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    if options.store:
        with open(STORED, "w", encoding="utf-8") as file:
            json.dump({"compiler": compiler, "scenes": counted}, file, indent=2)
            file.write("\n")
        return
    with open(STORED, encoding="utf-8") as file:
        stored = json.load(file)
    if stored["compiler"] != compiler:
        print(f"stored by {stored['compiler']}, counted by {compiler}: ratios are those of the compilers as well\n")
    rows, worst = [], 0
    for name, new in counted.items():
        ratios = {what: new[what] / stored["scenes"][name][what] for what in ("sample", "start")}
        worst = max(worst, *ratios.values())
        rows.append([name, new["sample"], f"{ratios['sample']:.4f}", f"{new['start'] / 1e6:.1f}", f"{ratios['start']:.4f}"])
    head = ["scene", "instructions per sample", "new / stored", "million at the start", "new / stored"]
    documents.publish(None, "", documents.table(head, rows))
    if worst > options.threshold:
        raise SystemExit(f"{worst:.4f} exceeds {options.threshold}")


if __name__ == "__main__":
    main()
