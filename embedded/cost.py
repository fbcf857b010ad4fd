#!/usr/bin/env python3
"""What each model costs on a microcontroller: bytes of flash and instructions per call.

usage: cost.py [MODEL ...]        prints the tables of docs/embedded.md

Flash is the size of a program that evaluates the model (value and density), or also samples it, less the size of the same program without a
model, both linked with `lto = "fat"`. The float functions that a model needs are part of its cost, and on the
Cortex-M0 the floating-point operations that the program without it does not have.
Instructions are those of a simulated processor (`qemu-system-arm -icount`), means over 32 pairs of
directions above the surface, in f32, compiled with opt-level 3: not cycles, but the same in every run.

Needs qemu-system-arm and the Rust targets thumbv7em-none-eabihf and thumbv6m-none-eabi.
"""
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


def main():
    models = sys.argv[1:] or specimens()
    empty = {(target, level): flash(build("", target, level)) for _, target, _, _ in BOARDS for level in "s3"}
    for name, target, machine, cpu in BOARDS:
        print(f"\n{name} (`{target}`); the program without a model has {empty[target, 's']} bytes with `s`, {empty[target, '3']} with 3.\n")
        print("| model | eval alone, `s` | with sample, `s` | with sample, 3 | instructions of eval | of sample |")
        print("| --- | ---: | ---: | ---: | ---: | ---: |")
        for model in models:
            sizes = [
                flash(build(model, target, level, calls)) - empty[target, level]
                for level, calls in (("s", "eval"), ("s", ""), ("3", ""))
            ]
            counts = instructions(build(model, target, "3"), machine, cpu)
            print("|", " | ".join([model, *map(str, sizes), *counts]), "|", flush=True)


if __name__ == "__main__":
    main()
