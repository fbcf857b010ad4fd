#!/usr/bin/env python3
"""Time and error of two programs, or of the program and Mitsuba 3, on the reference scenes, in turn, in one run.

usage: compare.py --baseline OLD [--candidate NEW] [--peer] [--rounds 5] [--spp 64] [--size 256] [--document FILE]

--candidate compares two binaries of étendue; --peer compares one with Mitsuba 3 (variant llvm_ad_rgb; needs the package, and
DRJIT_LIBLLVM_PATH where its LLVM is not found). Every round renders every scene by every contestant with a seed of its own.

time     processor seconds of a render less those of a picture of one pixel: loading, building and the compiler of Mitsuba do not count
relMSE   mean((x − r)² / (r² + 0.01)) against r of `--reference-spp` samples by the baseline (other seeds), kept in `--cache`,
         less the error that its two halves show r to have
effic.   1 / (relMSE · time)

Ratios are medians of the rounds' (first over second: above 1 the second is better), with the least and the greatest.
"""
import argparse
import math
import os
import statistics
import tempfile
import zlib

import documents
import mitsuba_worker
import pictures
import program
import scenes

# Seeds of the reference's halves; rounds have theirs from 1.
REFERENCE_SEEDS = [1_000_000, 2_000_000]


class Binary:
    """A binary of étendue with arguments, on one scene."""

    def __init__(self, path, scene, folder, options, *arguments):
        self.path, self.scene, self.options = path, scene, options
        self.output = os.path.join(folder, "picture.pfm")
        self.arguments = ["--size", f"{options.size}x{options.size}", *arguments]
        start = program.start(path, scene, self.output, *self.arguments)
        self.start, self.first_pixel = start.seconds, start.clock
        self.peak_bytes = 0

    def render(self, seed):
        run = program.render(self.path, self.scene, self.output, "--spp", self.options.spp, "--seed", seed, *self.arguments)
        self.peak_bytes = max(self.peak_bytes, run.peak_bytes)
        return run.seconds - self.start, pictures.read_pfm(self.output)

    def close(self):
        pass


def reference(name, scene, options):
    """The converged picture of a scene, of which the two halves are in the cache if they are there."""
    os.makedirs(options.cache, exist_ok=True)
    return pictures.Reference(*(half(name, scene, options, seed) for seed in REFERENCE_SEEDS))


def half(name, scene, options, seed):
    stem = f"{name}-{options.size}-{options.reference_spp}-{checksum(os.path.dirname(scene)):08x}-{seed}"
    path = os.path.join(options.cache, f"{stem}.pfm")
    if not os.path.exists(path):
        # The extension decides the format, so that of an unfinished picture is the same.
        unfinished = path.removesuffix(".pfm") + ".part.pfm"
        size, samples = f"{options.size}x{options.size}", options.reference_spp // 2
        arguments = ["--size", size, "--spp", samples, "--seed", seed, "--sampler", "sobol"]
        program.render(options.baseline, scene, unfinished, *arguments, threads=os.cpu_count())
        os.rename(unfinished, path)
    return pictures.read_pfm(path)


def checksum(folder):
    """Of all files, so that a scene that changes has another reference."""
    sum = 0
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
        with open(entry.path, "rb") as file:
            sum = zlib.crc32(file.read(), sum)
    return sum


def measure(contestants, ideal, rounds):
    """Seconds and relMSE of every contestant, one pair a round."""
    measured = {name: [] for name in contestants}
    for seed in range(1, rounds + 1):
        for name, contestant in contestants.items():
            seconds, picture = contestant.render(seed)
            measured[name].append((seconds, ideal.relative_mse(picture)))
    return measured


def ratio(first, second, of):
    """Median ratio of `of(seconds, error)` between rounds, as text and as a number."""
    ratios = [of(*a) / of(*b) for a, b in zip(first, second)]
    return f"{statistics.median(ratios):.3f} ({min(ratios):.2f} to {max(ratios):.2f})", statistics.median(ratios)


QUANTITIES = {
    "time": lambda seconds, _: seconds,
    "relMSE": lambda _, error: error,
    "time · relMSE": lambda seconds, error: seconds * error,
}


def compare(options, pairs, contestants_of):
    """Rows of ratios for every scene and pair, and a row of their geometric means."""
    head = ["scene", "contestants", "s", "s", *(f"{quantity}, ratio" for quantity in QUANTITIES)]
    rows, logs, memory = [], {pair: [] for pair in pairs}, []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.only or scenes.SCENES:
            scene = scenes.write(folder, name, options)
            ideal = reference(name, scene, options)
            contestants = contestants_of(scene, folder)
            measured = measure(contestants, ideal, options.rounds)
            for pair in pairs:
                first, second = (measured[contestant] for contestant in pair)
                ratios = [ratio(first, second, of) for of in QUANTITIES.values()]
                logs[pair].append([math.log(number) for _, number in ratios])
                seconds = [f"{statistics.median(s for s, _ in side):.2f}" for side in (first, second)]
                rows.append([name, " / ".join(pair), *seconds, *(text for text, _ in ratios)])
                print(documents.table(head, rows)[-1], flush=True)
            for label, contestant in contestants.items():
                memory.append([name, label, f"{contestant.first_pixel:.2f}", f"{contestant.peak_bytes / 2**20:.0f}"])
                contestant.close()
    for pair, columns in logs.items():
        means = [f"{math.exp(statistics.mean(column)):.3f}" for column in zip(*columns)]
        rows.append(["geometric mean", " / ".join(pair), "", "", *means])
    return documents.table(head, rows), documents.table(["scene", "contestant", "time to first pixel, s", "peak memory, MiB"], memory)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--baseline", default="target/release/etendue")
    parser.add_argument("--candidate")
    parser.add_argument("--peer", action="store_true")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--reference-spp", type=int, default=2048)
    parser.add_argument("--cache", default="target/perf")
    parser.add_argument("--only", type=lambda text: text.split(","))
    parser.add_argument("--document", help="where the part `pictures` (of --peer) is written")
    scenes.add_options(parser)
    options = parser.parse_args()

    if options.candidate:
        def contestants(scene, folder):
            return {
                "baseline": Binary(options.baseline, scene, folder, options),
                "candidate": Binary(options.candidate, scene, folder, options),
            }

        lines, memory = compare(options, [("baseline", "candidate")], contestants)
        documents.publish(None, "", ["", *lines, "", *memory])
    if options.peer:
        def contestants(scene, folder):
            return {
                "étendue independent": Binary(options.baseline, scene, folder, options, "--sampler", "independent"),
                "Mitsuba independent": mitsuba_worker.Mitsuba(scene, folder, options, "independent"),
                "étendue sobol": Binary(options.baseline, scene, folder, options, "--sampler", "sobol"),
                "étendue sobol, reuse": Binary(options.baseline, scene, folder, options, "--reuse"),
                "Mitsuba multijitter": mitsuba_worker.Mitsuba(scene, folder, options, "multijitter"),
            }

        pairs = [
            ("Mitsuba independent", "étendue independent"),
            ("Mitsuba multijitter", "étendue sobol"),
            ("Mitsuba multijitter", "étendue sobol, reuse"),
        ]
        lines, memory = compare(options, pairs, contestants)
        print()
        what = f"{documents.machine()}; {options.size}², {options.spp} samples per pixel, {options.rounds} rounds."
        documents.publish(options.document, "pictures", [what, "", *lines, "", *memory])


if __name__ == "__main__":
    main()
