#!/usr/bin/env python3
"""What ways of compiling gain: link-time and profile-guided optimisation and instructions of one processor, on the reference scenes.

usage: packagers.py --build [WAY ...] [--profdata llvm-profdata]        (five minutes a way on two cores; into target/packagers)
       packagers.py [--rounds 5] [--document docs/performance.md]

Without a WAY all are built; what has been built is measured.

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


def built(folder):
    """Those of the measured ways that have been built."""
    return [way for way in MEASURED if os.path.exists(binary(folder, way))]


def binary(folder, way):
    return os.path.join(folder, way)


def build(folder, way):
    settings = {name: value.format(folder=folder) for name, value in WAYS[way].items()}
    target = os.path.join(folder, "build")
    command = ["cargo", "build", "--release", "--locked", "-p", "etendue-cli", "--target-dir", target]
    subprocess.run(command, cwd=ROOT, env={**os.environ, **settings}, check=True)
    shutil.copy(os.path.join(target, "release", "etendue"), binary(folder, way))


def train(folder, profdata, options):
    """Renders every scene with what is instrumented, and merges what that wrote."""
    shutil.rmtree(os.path.join(folder, "profile"), ignore_errors=True)  # of programs that ran during the build
    with tempfile.TemporaryDirectory() as pictures:
        for name in scenes.SCENES:
            scene = scenes.write(pictures, name, options)
            output = os.path.join(pictures, "picture.pfm")
            program.render(binary(folder, "instrumented"), scene, output, "--size", "128x128", "--spp", 4)
    command = [profdata, "merge", "-o", os.path.join(folder, "etendue.profdata"), os.path.join(folder, "profile")]
    subprocess.run(command, check=True)


def measure(folder, ways, options):
    """Ratios of the first way's time to that of the others, by scene and way."""
    ratios = {}
    with tempfile.TemporaryDirectory() as pictures:
        output = os.path.join(pictures, "picture.pfm")
        for name in scenes.SCENES:
            scene = scenes.write(pictures, name, options)
            binaries = {way: binary(folder, way) for way in ways}
            starts = {way: program.start(path, scene, output).seconds for way, path in binaries.items()}
            rounds = [
                {way: program.render(path, scene, output, "--spp", 16).seconds - starts[way] for way, path in binaries.items()}
                for _ in range(options.rounds)
            ]
            agree(name, binaries, scene, output)
            ratios[name] = {way: statistics.median(times[ways[0]] / times[way] for times in rounds) for way in ways[1:]}
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
    parser.add_argument("--build", nargs="*", choices=list(WAYS), help="all, or some, in this order")
    parser.add_argument("--profdata", default="llvm-profdata")
    parser.add_argument("--folder", default="target/packagers")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--document")
    scenes.add_options(parser)
    options = parser.parse_args()
    folder = os.path.abspath(options.folder)
    if options.build is not None:
        os.makedirs(folder, exist_ok=True)
        for way in options.build or WAYS:
            if way == "guided":
                train(folder, options.profdata, options)
            build(folder, way)
        return
    first, *others = ways = built(folder)
    ratios = measure(folder, ways, options)
    means = {way: math.exp(statistics.mean(math.log(of[way]) for of in ratios.values())) for way in others}
    rows = [[name, *(f"{of[way]:.3f}" for way in others)] for name, of in {**ratios, "geometric mean": means}.items()]
    sizes = {way: f"{os.path.getsize(binary(folder, way)) / 2**20:.1f}" for way in ways}
    rows.append([f"size, MiB ({first}: {sizes[first]})", *(sizes[way] for way in others)])
    lines = documents.table([f"times as fast as {first}", *others], rows)
    documents.publish(options.document, "packagers", [documents.machine() + ".", "", *lines])


if __name__ == "__main__":
    main()
