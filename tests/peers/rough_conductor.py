#!/usr/bin/env python3
"""Is étendue's rough GGX conductor as fast as scalar C++ with the formulas of Mitsuba 3?

usage: rough_conductor.py [--runs 120]

Compiles rough_conductor.cpp (see there) with `g++ -O3 -fno-math-errno` and étendue's example `calls` in release, both for AVX, as
the renderer's tiles are (without it a root waits for whatever was in its register before), and calls
`eval`, `pdf` and `sample` of both over the same 256 pairs of directions above the surface: α 0.3 × 0.2, separable masking,
copper, f32 in one channel and in three. First the results are compared: it fails where they differ by more than rounding.
Then two measures: instructions per call (valgrind), and nanoseconds per call, the least of many runs of a
millisecond in which the two programs take turns, which a busy machine does not disturb.
Prints a table in Markdown. Needs g++, cargo and valgrind.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
OPERATIONS = ["eval", "pdf", "sample"]
CALLS = 25_600
# Relative. Some dozen roundings of 6e-8 on either side; wo + wi and 1 − cos² cancel a little.
BOUND = 1e-5


def instructions(command):
    tool = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    output = subprocess.run(tool + command, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"refs:\s*([\d,]+)", output).group(1).replace(",", ""))


def compare(ours, theirs):
    """Fails where a value, a density or a weight differs between the two programs by more than BOUND."""
    worst = dict.fromkeys(["value", "density", "weight of étendue's sample", "its density", "weight of C++'s sample", "its density "], 0.0)
    for line, answer in zip(ours, theirs, strict=True):
        value, pdf, _, _, cos, weight, sampled_pdf = map(float, line.split()[8:])
        their = [float(word) for word in answer.split()]
        pairs = [(value, their[0]), (pdf, their[1])]
        # A direction that one map of uniforms loses below the surface is no sample there.
        pairs += [(weight, their[2]), (sampled_pdf, their[3])] if cos > 0 else [(1, 1)] * 2
        pairs += zip(their[4:6], their[6:8]) if their[5] > 0 else [(1, 1)] * 2
        for name, (a, b) in zip(worst, pairs, strict=True):
            worst[name] = max(worst[name], abs(a - b) / max(abs(a), abs(b)))
    print("Largest relative differences:", ", ".join(f"{name.strip()} {x:.1e}" for name, x in worst.items()) + ".\n")
    if not max(worst.values()) <= BOUND:
        sys.exit(f"the two programs differ by more than {BOUND}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=120)
    options = parser.parse_args()
    build = ["cargo", "build", "--quiet", "--release", "-p", "etendue-specimens", "--example", "calls"]
    build += ["--target-dir", os.path.join(ROOT, "target", "avx")]
    subprocess.run(build, cwd=ROOT, env=os.environ | {"RUSTFLAGS": "-C target-feature=+avx"}, check=True)
    ours = [os.path.join(ROOT, "target", "avx", "release", "examples", "calls"), "rough-conductor/separable"]
    with tempfile.TemporaryDirectory() as folder:
        theirs = [os.path.join(folder, "peer")]
        source = os.path.join(ROOT, "tests", "peers", "rough_conductor.cpp")
        subprocess.run(["g++", "-std=c++17", "-O3", "-mavx", "-fno-math-errno", "-o", *theirs, source], check=True)
        results = subprocess.check_output([*ours, "results", "f32", "256"], text=True)
        inputs = os.path.join(folder, "inputs")
        with open(inputs, "w", encoding="utf-8") as file:
            file.write(results)
        answers = subprocess.check_output([*theirs, "results", "f32", "1", inputs], text=True)
        compare(results.splitlines(), answers.splitlines())
        print("| | instructions, étendue | C++ | ns, étendue | C++ | ratio of times |")
        print("| --- | ---: | ---: | ---: | ---: | ---: |")
        for precision in ("f32", "rgb"):
            totals = [0.0] * 4
            for operation in OPERATIONS:
                row = []
                for program, more in ((ours, []), (theirs, [inputs])):
                    nothing = instructions([*program, "nothing", precision, str(CALLS), *more])
                    row.append((instructions([*program, operation, precision, str(CALLS), *more]) - nothing) / CALLS)
                times = ([], [])
                for _ in range(options.runs):
                    for (program, more), list_of in zip(((ours, []), (theirs, [inputs])), times):
                        command = [*program, operation, precision, str(CALLS), *more]
                        list_of.append(float(subprocess.check_output(command)))
                row += [min(list_of) for list_of in times]
                totals = [total + value for total, value in zip(totals, row)]
                show(f"{precision} {operation}", row)
            show(f"{precision} all three", totals)


def show(name, row):
    cells = [f"{row[0]:.0f}", f"{row[1]:.0f}", f"{row[2]:.1f}", f"{row[3]:.1f}", f"{row[3] / row[2]:.2f}"]
    print("|", " | ".join([name, *cells]), "|", flush=True)


if __name__ == "__main__":
    main()
