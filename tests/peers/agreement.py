#!/usr/bin/env python3
"""Does étendue render what Mitsuba 3 renders? A statistical test over small scenes.

usage: agreement.py [--etendue target/release/etendue] [--scenes tests/scenes] [--runs 16]
                    [--spp-factor 1] [--pictures FOLDER] [--markdown] [NAME ...]

Each scene, in each variant its first comment lists (`variants: name=value …`, passed as -D name=value), is
rendered by both, `--runs` times with as many seeds, with the samples per pixel that the file states, times
`--spp-factor`; by Mitsuba's `scalar_rgb`, or by what the comment names (`mitsuba: scalar_spectral`), in which case we
carry wavelengths, too. What Mitsuba 3 does not have (`mitsuba: a plugin of version 0.6`) is only rendered. Then
* per pixel and channel: Welch's t-test of the two means, p-values Šidák-corrected to 1 % for the whole picture;
  at least 99.75 % of the values must be accepted. Variances have the floor that Mitsuba's own test_renders.py
  gives them: 1e-4 per sample, so that a last bit does not count as a difference in a constant area.
* of the whole picture: the two means must lie within 4 standard errors of the difference (or 2e-5, relatively).

`NAME` restricts the run to scenes whose name contains it. `--pictures` writes for every variant that differs
both pictures and the map of the differences in standard errors (red: étendue is brighter). `--markdown` prints
the table as in docs/scenes.md. Exit code: 0 all agree, 1 some differ, 2 something could not be rendered.

Needs `pip install mitsuba numpy` and a release build of étendue.
"""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile

import numpy

SIGNIFICANCE = 0.01
ACCEPTED_SHARE = 0.9975
VARIANCE_FLOOR = 1e-4
MEAN_SIGMAS = 4.0
MEAN_FLOOR = 2e-5


def variants(path):
    """The definitions of each variant; one without any where the file lists none."""
    with open(path, encoding="utf-8") as file:
        comment = re.match(r"<!--(.*?)-->", file.read(), re.DOTALL)
    lines = re.findall(r"variants:(.*)", comment.group(1)) if comment else []
    return [dict(item.split("=", 1) for item in line.split()) for line in lines] or [{}]


def peer(path):
    """What the first comment says about Mitsuba: a variant of it, or why it has no such plugin."""
    with open(path, encoding="utf-8") as file:
        comment = re.match(r"<!--(.*?)-->", file.read(), re.DOTALL)
    found = re.search(r"mitsuba: (.*?)\s*$", comment.group(1), re.MULTILINE) if comment else None
    return found.group(1) if found else "scalar_rgb"


def render_mitsuba(path, definitions, runs, factor):
    import mitsuba

    mitsuba.set_variant(peer(path))
    scene = mitsuba.load_file(path, **definitions)
    spp = scene.sensors()[0].sampler().sample_count() * factor
    pictures = [mitsuba.render(scene, spp=spp, seed=seed) for seed in range(runs)]
    return numpy.stack([numpy.array(picture, dtype=float)[:, :, :3] for picture in pictures]), spp


def render_etendue(binary, path, definitions, runs, spp, arguments=()):
    import mitsuba

    pictures = []
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "picture.exr")
        for seed in range(runs):
            command = [binary, "render", path, "-o", output, "--quiet", "--spp", str(spp), "--seed", str(seed)]
            command += arguments
            command += [word for name, value in definitions.items() for word in ("-D", f"{name}={value}")]
            result = subprocess.run(command, capture_output=True, text=True)
            if result.returncode != 0:
                raise RuntimeError(result.stderr.strip())
            pictures.append(numpy.array(mitsuba.Bitmap(output), dtype=float)[:, :, :3])
    return numpy.stack(pictures)


def p_value(t, freedom):
    """Two-sided, by Wallace's transform of t to a normal deviate (1959), good to a few per cent of p."""
    z = (8 * freedom + 1) / (8 * freedom + 3) * numpy.sqrt(freedom * numpy.log1p(t * t / freedom))
    return numpy.vectorize(math.erfc)(z / math.sqrt(2))


class Comparison:
    """The statistics of two stacks of pictures of the same scene."""

    def __init__(self, ours, theirs, spp):
        runs = len(ours)
        mean_ours, mean_theirs = ours.mean(0), theirs.mean(0)
        floor = VARIANCE_FLOOR / spp
        errors = [numpy.maximum(stack.var(0, ddof=1), floor) / runs for stack in (ours, theirs)]
        squares = sum(error**2 for error in errors)
        freedom = (runs - 1) * sum(errors) ** 2 / squares
        self.deviation = (mean_ours - mean_theirs) / numpy.sqrt(sum(errors))
        p = p_value(self.deviation, freedom)
        pixels = p.shape[0] * p.shape[1]
        self.accepted = float((p > 1 - (1 - SIGNIFICANCE) ** (1 / pixels)).mean())
        means = [stack.mean((1, 2, 3)) for stack in (ours, theirs)]
        self.mean = float(means[1].mean())
        self.difference = float(means[0].mean() - means[1].mean())
        sigma = math.sqrt(sum(mean.var(ddof=1) for mean in means) / runs)
        self.sigmas = self.difference / math.hypot(sigma, MEAN_FLOOR * abs(self.mean) / MEAN_SIGMAS, 1e-12)
        self.pictures = mean_ours, mean_theirs
        self.agrees = self.accepted >= ACCEPTED_SHARE and abs(self.sigmas) < MEAN_SIGMAS

    def figures(self):
        relative = 100 * self.difference / self.mean if self.mean else 0.0
        return f"{100 * self.accepted:7.3f} %", f"{relative:+8.4f} %", f"{self.sigmas:+6.1f} σ"

    def write(self, stem):
        import mitsuba

        sign = self.deviation.mean(2) / 8
        nothing = numpy.zeros_like(sign)
        map_of = numpy.stack([sign.clip(0), nothing, (-sign).clip(0)], axis=2)
        row = numpy.concatenate([*self.pictures, map_of], axis=1).astype(numpy.float32)
        mitsuba.util.write_bitmap(f"{stem}.png", numpy.repeat(numpy.repeat(row, 4, 0), 4, 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--scenes", default="tests/scenes")
    parser.add_argument("--runs", type=int, default=16)
    parser.add_argument("--spp-factor", type=int, default=1)
    parser.add_argument("--pictures")
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()

    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    if options.pictures:
        os.makedirs(options.pictures, exist_ok=True)
    files = sorted(name for name in os.listdir(options.scenes) if name.endswith(".xml"))
    files = [name for name in files if not options.names or any(part in name for part in options.names)]
    row = "| {} | {} | {} | {} | {} |" if options.markdown else "{:<58} {:<8} {:>10} {:>11} {:>9}"
    print(row.format("scene", "result", "accepted", "Δ mean", "in σ"))
    if options.markdown:
        print("| --- | --- | ---: | ---: | ---: |")
    differing, failed = 0, 0
    for file in files:
        path = os.path.join(options.scenes, file)
        for definitions in variants(path):
            name = " ".join([file[:-4]] + [f"{key}={value}" for key, value in definitions.items()])
            try:
                if " " in peer(path):
                    render_etendue(options.etendue, path, definitions, 1, 1)
                    print(row.format(name, peer(path), *[""] * 3).rstrip(), flush=True)
                    continue
                theirs, spp = render_mitsuba(path, definitions, options.runs, options.spp_factor)
                mode = ["--spectral"] if peer(path).endswith("spectral") else []
                ours = render_etendue(options.etendue, path, definitions, options.runs, spp, mode)
                if ours.shape != theirs.shape:
                    raise RuntimeError(f"sizes differ: {ours.shape[2:0:-1]} and {theirs.shape[2:0:-1]}")
            except RuntimeError as error:
                failed += 1
                print(row.format(name, "failed", *[""] * 3).rstrip())
                print(error, file=sys.stderr)
                continue
            comparison = Comparison(ours, theirs, spp)
            differing += not comparison.agrees
            print(row.format(name, "agrees" if comparison.agrees else "differs", *comparison.figures()), flush=True)
            if options.pictures and not comparison.agrees:
                comparison.write(os.path.join(options.pictures, name.replace(" ", ",")))
    print(f"\nMitsuba {mitsuba.__version__}: {differing} differ, {failed} could not be rendered", file=sys.stderr)
    sys.exit(2 if failed else 1 if differing else 0)


if __name__ == "__main__":
    main()
