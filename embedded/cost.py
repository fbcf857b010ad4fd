#!/usr/bin/env python3
"""What each model costs on a microcontroller: bytes of flash and instructions per call.

usage: cost.py [--markdown FILE] [MODEL ...]

Prints a table for each board; --markdown writes them into FILE instead, between the lines `begin cost` and `end cost`.
Flash is the size of a program that evaluates the model (value and density), or also samples it, less the size of the same program without a
model, both linked with `lto = "fat"`. The float functions that a model needs are part of its cost, and on the
Cortex-M0 the floating-point operations that the program without it does not have.
Instructions are those of a simulated processor (`qemu-system-arm -icount`), means over 32 pairs of
directions above the surface, in f32, compiled with opt-level 3: not cycles, but the same in every run.
A model that does not fit into the board's memory ends the run with an error.
Three builds and a run per model and board, some seconds each.

Needs qemu-system-arm and the Rust targets thumbv7em-none-eabihf and thumbv6m-none-eabi.
"""
import argparse
import os
import re
import struct
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
FIRMWARE = os.path.join(ROOT, "embedded", "firmware")
BOARDS = [
    ("Cortex-M4F", "thumbv7em-none-eabihf", "mps2-an386", "cortex-m4"),
    ("Cortex-M0", "thumbv6m-none-eabi", "microbit", "cortex-m0"),
]
BEGIN, END = "<!-- begin cost -->\n", "<!-- end cost -->\n"


def specimens():
    with open(os.path.join(ROOT, "crates", "specimens", "src", "models.rs"), encoding="utf-8") as file:
        return re.findall(r'^    \w+ "([^"]+)" \|', file.read(), re.MULTILINE)


def build(model, target, opt_level, calls=""):
    folder = os.path.join(FIRMWARE, "target", f"opt-{opt_level}")
    environment = os.environ | {"MODEL": model, "CALLS": calls, "CARGO_PROFILE_RELEASE_OPT_LEVEL": opt_level, "CARGO_TARGET_DIR": folder}
    command = ["cargo", "build", "--quiet", "--release", "--locked", "--bin", "cost", "--target", target]
    subprocess.run(command, cwd=FIRMWARE, env=environment, check=True)
    return os.path.join(folder, target, "release", "cost")


def flash(path):
    """Bytes of all sections of a 32-bit little-endian ELF file that are loaded and have contents."""
    with open(path, "rb") as file:
        data = file.read()
    start, size, count = struct.unpack_from("<I", data, 32)[0], *struct.unpack_from("<HH", data, 46)
    total = 0
    for i in range(count):
        _, kind, flags, _, _, length = struct.unpack_from("<6I", data, start + i * size)
        total += length if kind not in (0, 8) and flags & 2 else 0
    return total


def instructions(path, machine, cpu):
    command = ["qemu-system-arm", "-machine", machine, "-cpu", cpu, "-icount", "shift=10", "-nographic", "-monitor", "none"]
    command += ["-serial", "none", "-semihosting-config", "enable=on,target=native", "-kernel", path]
    output = subprocess.run(command, capture_output=True, text=True, timeout=600, check=True).stdout
    return re.search(r"eval_pdf (\d+) sample (\d+)", output).groups()


def row(model, target, machine, cpu, empty):
    sizes = []
    for level, calls in (("s", "eval"), ("s", ""), ("3", "")):
        program = build(model, target, level, calls)
        sizes.append(str(flash(program) - empty[level]))
    return "| " + " | ".join([model, *sizes, *instructions(program, machine, cpu)]) + " |\n"


def tables(models):
    for name, target, machine, cpu in BOARDS:
        empty = {level: flash(build("", target, level)) for level in "s3"}
        yield f"\n{name}; the program without a model has {empty['s']} bytes with `s`, {empty['3']} with 3:\n\n"
        yield "| model | eval alone, `s` | with sample, `s` | with sample, 3 | instructions of eval | of sample |\n"
        yield "| --- | ---: | ---: | ---: | ---: | ---: |\n"
        for model in models:
            yield row(model, target, machine, cpu, empty)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--markdown", metavar="FILE")
    parser.add_argument("models", nargs="*", metavar="MODEL")
    options = parser.parse_args()
    text = ""
    for line in tables(options.models or specimens()):
        text += line
        print(line, end="", file=sys.stderr if options.markdown else sys.stdout, flush=True)
    if options.markdown:
        with open(options.markdown, encoding="utf-8") as file:
            before, rest = file.read().split(BEGIN)
        with open(options.markdown, "w", encoding="utf-8") as file:
            file.write(before + BEGIN + text + "\n" + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
