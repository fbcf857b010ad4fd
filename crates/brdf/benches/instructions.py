#!/usr/bin/env python3
"""Instructions per call of every model: a measure of speed that a busy machine does not disturb.

usage: instructions.py [--backend std|libm] [--markdown FILE] [MODEL ...]

Runs the example `calls` of etendue-specimens under valgrind, with an operation and with none, and divides the difference by the
number of calls: pairs of directions above the surface. Prints a table in Markdown, in f32 and in f64, for one backend or for
both; --markdown writes it into FILE instead, between the lines `begin instructions` and `end instructions`.
Ten runs of about a second per model and backend. Needs cargo and valgrind.
"""
import argparse
import os
import re
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
OPERATIONS = ["eval", "pdf", "eval_pdf", "sample"]
CALLS = 12_800
BEGIN, END = "<!-- begin instructions -->\n", "<!-- end instructions -->\n"


def build(backend):
    """Path of the program, in a folder of its backend's own."""
    folder = os.path.join(ROOT, "target", "instructions", backend)
    command = ["cargo", "build", "--quiet", "--release", "--locked", "-p", "etendue-specimens", "--example", "calls"]
    command += ["--no-default-features", "--features", backend, "--target-dir", folder]
    subprocess.run(command, cwd=ROOT, check=True)
    return os.path.join(folder, "release", "examples", "calls")


def instructions(program, *arguments):
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    command += [program, *arguments, str(CALLS)]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    return int(re.search(r"refs:\s*([\d,]+)", output).group(1).replace(",", ""))


def per_call(program, model):
    """Instructions of every operation, in f32 and then in f64."""
    for precision in ("f32", "f64"):
        nothing = instructions(program, model, "nothing", precision)
        for operation in OPERATIONS:
            yield (instructions(program, model, operation, precision) - nothing) / CALLS


def table(backend, models):
    program = build(backend)
    yield f"\nBackend `{backend}`:\n\n"
    yield "| model | f32: " + " | ".join(OPERATIONS) + " | f64: " + " | ".join(OPERATIONS) + " |\n"
    yield "| --- |" + " ---: |" * 2 * len(OPERATIONS) + "\n"
    for model in models:
        cells = [f"{count:.0f}".replace("-", "−") for count in per_call(program, model)]
        yield "| " + " | ".join([model, *cells]) + " |\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--backend", choices=["std", "libm"])
    parser.add_argument("--markdown", metavar="FILE")
    parser.add_argument("models", nargs="*", metavar="MODEL")
    options = parser.parse_args()
    with open(os.path.join(ROOT, "crates", "specimens", "src", "models.rs"), encoding="utf-8") as file:
        names = re.findall(r'^ {4}\w+ "([^"]+)" \|', file.read(), re.MULTILINE)
    text = ""
    for backend in [options.backend] if options.backend else ["std", "libm"]:
        for line in table(backend, options.models or names):
            text += line
            print(line, end="", file=sys.stderr if options.markdown else sys.stdout, flush=True)
    if options.markdown:
        with open(options.markdown, encoding="utf-8") as file:
            before, rest = file.read().split(BEGIN)
        with open(options.markdown, "w", encoding="utf-8") as file:
            file.write(before + BEGIN + text + "\n" + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
