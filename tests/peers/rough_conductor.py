#!/usr/bin/env python3
"""Is étendue's rough GGX conductor as fast as scalar C++ with the formulas of Mitsuba 3?

usage: rough_conductor.py [--runs 120]

Compiles rough_conductor.cpp (see there) with `g++ -O3 -fno-math-errno` and étendue's example `calls` in release, and calls
`eval`, `pdf` and `sample` of both over pairs of directions above the surface: α 0.3 × 0.2, copper, f32 in one channel and in
three. Two measures: instructions per call (valgrind), and nanoseconds per call, the least of many runs of a
millisecond in which the two programs take turns, which a busy machine does not disturb.
Prints a table in Markdown. Needs g++, cargo and valgrind.
"""
import argparse
import os
import re
import subprocess
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
OPERATIONS = ["eval", "pdf", "sample"]
CALLS = 25_600


def instructions(command):
    tool = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    output = subprocess.run(tool + command, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"refs:\s*([\d,]+)", output).group(1).replace(",", ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=120)
    options = parser.parse_args()
    build = ["cargo", "build", "--quiet", "--release", "-p", "etendue-specimens", "--example", "calls"]
    subprocess.run(build, cwd=ROOT, check=True)
    ours = [os.path.join(ROOT, "target", "release", "examples", "calls"), "rough-conductor"]
    with tempfile.TemporaryDirectory() as folder:
        theirs = [os.path.join(folder, "peer")]
        source = os.path.join(ROOT, "tests", "peers", "rough_conductor.cpp")
        subprocess.run(["g++", "-std=c++17", "-O3", "-fno-math-errno", "-o", *theirs, source], check=True)
        print("| | instructions, étendue | C++ | ns, étendue | C++ | ratio of times |")
        print("| --- | ---: | ---: | ---: | ---: | ---: |")
        for precision in ("f32", "rgb"):
            totals = [0.0] * 4
            for operation in OPERATIONS:
                row = []
                for program in (ours, theirs):
                    nothing = instructions([*program, "nothing", precision, str(CALLS)])
                    row.append((instructions([*program, operation, precision, str(CALLS)]) - nothing) / CALLS)
                times = ([], [])
                for _ in range(options.runs):
                    for program, list_of in zip((ours, theirs), times):
                        command = [*program, operation, precision, str(CALLS)]
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
