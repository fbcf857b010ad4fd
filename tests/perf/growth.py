#!/usr/bin/env python3
"""How time and memory grow with triangles, lights, depth, resolution and threads, as tables and plots.

usage: growth.py [--etendue target/release/etendue] [--only triangles,threads] [--document docs/performance.md] [--images docs/images]

Times of samples are processor times of one thread, less those of a picture of one pixel, the least of `--rounds` runs; where these
are most of it (large meshes), those while the program rendered. Time to the first pixel is the clock's, with all threads: reading
the files, building the hierarchies, one sample. Memory is what the process has at most. Other work disturbs what the clock says.
The plots are IMAGES/growth-NAME.svg, the tables go into the part `growth NAME` of the document.
"""
import argparse
import os
import tempfile
import types

import charts
import documents
import program
import scenes


SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷"


class Bench:
    """A binary and a folder for scenes and pictures."""

    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.output = os.path.join(folder, "picture.pfm")

    def scene(self, name, triangles=1_000_000, lights=1024):
        return scenes.write(self.folder, name, types.SimpleNamespace(triangles=triangles, lights=lights))

    def time_per_sample(self, scene, size, spp, *arguments):
        """Microseconds of a sample and rays of a sample."""
        arguments = ["--size", f"{size}x{size}", *arguments]
        start = program.start(self.options.etendue, scene, self.output, *arguments).seconds
        arguments += ["--spp", spp]
        runs = [program.render(self.options.etendue, scene, self.output, *arguments) for _ in range(self.options.rounds)]
        seconds = min(run.seconds for run in runs) - start
        if start > seconds:
            command = program.command(self.options.etendue, scene, self.output, *arguments)
            seconds = min(program.rendering_seconds(command) for _ in range(self.options.rounds))
        samples = runs[0].report["samples"]
        return 1e6 * seconds / samples, runs[0].report["rays"] / samples

    def first_pixel(self, scene):
        """Seconds until the first pixel, seconds of building, and peak bytes."""
        runs = [
            program.render(self.options.etendue, scene, self.output, *program.FIRST_PIXEL, threads=os.cpu_count())
            for _ in range(self.options.rounds)
        ]
        fastest = min(runs, key=lambda run: run.clock)
        return fastest.clock, min(run.report["build_seconds"] for run in runs), fastest.peak_bytes


def triangles(bench, chart):
    rows, time, first, memory = [], [], [], []
    for exponent in range(3, 8):
        scene = bench.scene("surface", triangles=10**exponent)
        # Two triangles to a quad of a square grid.
        count = 2 * int((10**exponent / 2) ** 0.5 + 0.5) ** 2
        sample, rays = bench.time_per_sample(scene, 256, 16)
        clock, build, peak = bench.first_pixel(scene)
        rows.append([
            f"10{SUPERSCRIPTS[exponent]}", f"{sample:.2f}", f"{1000 * sample / rays:.0f}", documents.significant(clock),
            documents.significant(build), f"{peak / 2**20:.0f}", documents.significant(peak / count),
        ])
        time.append([count, sample])
        first.append([count, clock])
        memory.append([count, peak / 2**20])
    chart(
        "A surface in sun and sky", charts.axis("triangles"), charts.axis("µs per sample, s, MiB"),
        {"time of a sample, µs": time, "time to the first pixel, s": first, "peak memory, MiB": memory},
        powers=[charts.power(1, memory[-1], "∝ n")],
    )
    return ["triangles", "µs per sample", "ns per ray", "first pixel, s", "loaded and built, s", "peak MiB", "bytes per triangle"], rows


def lights(bench, chart):
    rows, time, first = [], [], []
    for exponent in range(6):
        scene = bench.scene("lights", lights=10**exponent)
        sample, rays = bench.time_per_sample(scene, 128, 16)
        clock, _, peak = bench.first_pixel(scene)
        rows.append([f"10{SUPERSCRIPTS[exponent]}", f"{sample:.2f}", f"{rays:.2f}", documents.significant(clock), f"{peak / 2**20:.0f}"])
        time.append([10**exponent, sample])
        first.append([10**exponent, 1000 * clock])
    chart(
        "Emitting triangles of equal power together", charts.axis("lights"), charts.axis("µs per sample, ms"),
        {"time of a sample, µs": time, "time to the first pixel, ms": first},
    )
    return ["lights", "µs per sample", "rays per sample", "first pixel, s", "peak MiB"], rows


def depth(bench, chart):
    rows, series = [], {}
    depths = [1, 2, 3, 4, 6, 8, 16, 32, 64]
    for name in ["box", "door"]:
        scene = bench.scene(name)
        measured = [bench.time_per_sample(scene, 128, 16, "--max-depth", depth) for depth in [*depths, -1]]
        series[name] = [[depth, sample] for depth, (sample, _) in zip(depths, measured)]
        rows.append([name, *(f"{sample:.2f} ({rays:.1f})" for sample, rays in measured)])
    chart("Paths of at most so many edges, roulette from the fifth", charts.axis("edges"), charts.axis("µs per sample", False), series)
    return ["µs (rays) per sample at depth", *map(str, depths), "no limit"], rows


def resolution(bench, chart):
    rows, series = [], {}
    sizes = [64, 128, 256, 512, 1024, 2048]
    for name in ["box", "surface"]:
        scene = bench.scene(name)
        # As many samples at every size, down to one each.
        series[name] = [[size, bench.time_per_sample(scene, size, max(2048**2 // size**2 // 4, 1))[0]] for size in sizes]
        rows.append([name, *(f"{sample:.2f}" for _, sample in series[name])])
    chart("Pictures of n² pixels", charts.axis("n"), charts.axis("µs per sample", False), series)
    return ["µs per sample at", *(f"{size}²" for size in sizes)], rows


def threads(bench, chart):
    """By the clock: a machine with other work to do shows less than it has."""
    counts = sorted({*(2**k for k in range(8) if 2**k <= os.cpu_count()), os.cpu_count()})
    rows, series = [], {}
    for name in ["box", "surface"]:
        scene = bench.scene(name)
        best = []
        for count in counts:
            arguments = ["--size", "512x512", "--spp", 8]
            runs = [program.render(bench.options.etendue, scene, bench.output, *arguments, threads=count) for _ in range(bench.options.rounds)]
            best.append(min(run.report["render_seconds"] for run in runs))
        series[name] = [[count, best[0] / seconds] for count, seconds in zip(counts, best)]
        rows.append([name, *(f"{best[0] / seconds:.2f}" for seconds in best)])
    chart(
        "Speed against one thread", charts.axis("threads", False), charts.axis("times as fast", False),
        {**series, "as many": [[count, count] for count in counts]},
    )
    return ["times as fast with", *(f"{count} thread{'s' * (count > 1)}" for count in counts)], rows


GROWTHS = {growth.__name__: growth for growth in [triangles, lights, depth, resolution, threads]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(GROWTHS))
    parser.add_argument("--document")
    parser.add_argument("--images")
    options = parser.parse_args()
    for name in options.only:
        def chart(*arguments, name=name, **guides):
            if options.images:
                charts.write(os.path.join(options.images, f"growth-{name}.svg"), *arguments, **guides)

        with tempfile.TemporaryDirectory() as folder:
            head, rows = GROWTHS[name](Bench(options, folder), chart)
        documents.publish(options.document, f"growth {name}", [documents.machine() + ".", "", *documents.table(head, rows)])


if __name__ == "__main__":
    main()
