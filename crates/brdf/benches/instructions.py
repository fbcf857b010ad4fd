#!/usr/bin/env python3
"""Instructions per call of every model: a measure of speed that a busy machine does not disturb.

usage: instructions.py [--backend std|libm] [MODEL ...]

Runs the example `calls` of etendue-specimens under valgrind, with an operation and with none, and divides the difference by the
number of calls: pairs of directions above the surface. Prints a table in Markdown. Needs cargo and valgrind.
"""
import argparse
import os
import re
import subprocess

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
CALLS = 12_800


def instructions(*arguments):
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    command += [os.path.join(ROOT, "target", "release", "examples", "calls"), *arguments, str(CALLS)]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"refs:\s*([\d,]+)", output).group(1).replace(",", ""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--backend", choices=["std", "libm"], default="std")
    parser.add_argument("models", nargs="*", metavar="MODEL")
    options = parser.parse_args()
    build = ["cargo", "build", "--quiet", "--release", "-p", "etendue-specimens", "--example", "calls"]
    build += ["--features", options.backend]
    subprocess.run(build, cwd=ROOT, check=True)
    with open(os.path.join(ROOT, "crates", "specimens", "src", "models.rs"), encoding="utf-8") as file:
        names = re.findall(r'^ {4}\w+ "([^"]+)"', file.read(), re.MULTILINE)
    print("| model | eval f32 | pdf | eval_pdf | sample | eval f64 | pdf | eval_pdf | sample |")
    print("| --- |" + " ---: |" * 8)
    for name in options.models or names:
        cells = []
        for precision in ("f32", "f64"):
            nothing = instructions(name, "nothing", precision)
            for operation in ("eval", "pdf", "eval_pdf", "sample"):
                cells.append(f"{(instructions(name, operation, precision) - nothing) / CALLS:.0f}")
        print("|", " | ".join([name, *cells]), "|", flush=True)


if __name__ == "__main__":
    main()
