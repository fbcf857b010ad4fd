#!/usr/bin/env python3
"""What ways of compiling gain: link-time and profile-guided optimisation and instructions of one processor, on the reference scenes.

usage: packagers.py --build [--profdata llvm-profdata]        (half an hour on two cores; into target/packagers)
       packagers.py [--rounds 5] [--document docs/performance.md]

Times are processor times of one thread, less those of a picture of one pixel, in turn in every round; a ratio is the median of the
rounds', the time of the release profile over that of the way. --profdata must be of the LLVM that `rustc -vV` names or a later one.
"""
import argparse
import math
import os
import shutil
import statistics
import subprocess
import tempfile

import documents
import program
import scenes

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
FAT = {"CARGO_PROFILE_RELEASE_LTO": "fat", "CARGO_PROFILE_RELEASE_CODEGEN_UNITS": "1"}
# Environment of cargo; the profile of `guided` is that of pictures of the reference scenes by `instrumented`.
WAYS = {
    "release": {},
    "fat": FAT,
    "native": {"RUSTFLAGS": "-Ctarget-cpu=native"},
    "instrumented": {**FAT, "RUSTFLAGS": "-Cprofile-generate={folder}/profile"},
    "guided": {**FAT, "RUSTFLAGS": "-Cprofile-use={folder}/etendue.profdata"},
}
MEASURED = ["release", "fat", "guided", "native"]


def binary(folder, way):
    return os.path.join(folder, way)


def build(folder, way):
    settings = {name: value.format(folder=folder) for name, value in WAYS[way].items()}
    target = os.path.join(folder, "build")
    command = ["cargo", "build", "--release", "--locked", "-p", "etendue-cli", "--target-dir", target]
    subprocess.run(command, cwd=ROOT, env={**os.environ, **settings}, check=True)
    shutil.copy(os.path.join(target, "release", "etendue"), binary(folder, way))


def train(folder, profdata, options):
    """Runs what is instrumented and merges what it wrote. The mesh of `surface` is small: profiles count, they do not time."""
    with tempfile.TemporaryDirectory() as pictures:
        for name in scenes.SCENES:
            scene = scenes.write(pictures, name, options)
            output = os.path.join(pictures, "picture.pfm")
            program.render(binary(folder, "instrumented"), scene, output, "--size", "128x128", "--spp", 4)
    command = [profdata, "merge", "-o", os.path.join(folder, "etendue.profdata"), os.path.join(folder, "profile")]
    subprocess.run(command, check=True)


def measure(folder, options):
    """Ratios by scene and way."""
    ratios = {}
    with tempfile.TemporaryDirectory() as pictures:
        output = os.path.join(pictures, "picture.pfm")
        for name in scenes.SCENES:
            scene = scenes.write(pictures, name, options)
            binaries = {way: binary(folder, way) for way in MEASURED}
            starts = {way: program.start(path, scene, output).seconds for way, path in binaries.items()}
            rounds = [
                {way: program.render(path, scene, output, "--spp", 16).seconds - starts[way] for way, path in binaries.items()}
                for _ in range(options.rounds)
            ]
            agree(name, binaries, scene, output)
            ratios[name] = {way: statistics.median(times["release"] / times[way] for times in rounds) for way in MEASURED[1:]}
    return ratios


def agree(name, binaries, scene, output):
    """Every binary renders the same bits."""
    rendered = []
    for path in binaries.values():
        program.render(path, scene, output, "--size", "64x64", "--spp", 4)
        with open(output, "rb") as file:
            rendered.append(file.read())
    differing = [way for way, picture in zip(binaries, rendered) if picture != rendered[0]]
    if differing:
        raise SystemExit(f"{name}: the pictures of {', '.join(differing)} are not that of {next(iter(binaries))}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--build", action="store_true")
    parser.add_argument("--profdata", default="llvm-profdata")
    parser.add_argument("--folder", default="target/packagers")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--document")
    scenes.add_options(parser)
    options = parser.parse_args()
    folder = os.path.abspath(options.folder)
    if options.build:
        os.makedirs(folder, exist_ok=True)
        for way in WAYS:
            if way == "guided":
                train(folder, options.profdata, options)
            build(folder, way)
        return
    ratios = measure(folder, options)
    means = {way: math.exp(statistics.mean(math.log(of[way]) for of in ratios.values())) for way in MEASURED[1:]}
    rows = [[name, *(f"{of[way]:.3f}" for way in MEASURED[1:])] for name, of in {**ratios, "geometric mean": means}.items()]
    sizes = [f"{os.path.getsize(binary(folder, way)) / 2**20:.1f}" for way in MEASURED]
    lines = documents.table(["times as fast as the release profile", *MEASURED[1:]], [*rows, ["size, MiB (release: " + sizes[0] + ")", *sizes[1:]]])
    documents.publish(options.document, "packagers", [documents.machine() + ".", "", *lines])


if __name__ == "__main__":
    main()
