#!/usr/bin/env python3
"""What dividing a render costs: measures one part of each division and the merging of parts, and prints the tables of docs/scaling.md.

    python3 recipes/efficiency.py [--etendue target/release/etendue] [--document docs/scaling.md]

Processor seconds of one thread, so that other programs on the machine matter little.
"""

import argparse
import resource
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES = {
    "box, 256², 256 samples": (HERE.parent / "scenes/cornell-box/scene.xml", ["--size", "256x256", "--spp", "256"]),
    "glass and metal, 256², 64 samples": (HERE.parent / "scenes/glass-and-metal.xml", ["--size", "256x256", "--spp", "64"]),
}
DIVISIONS = [1, 4, 16, 64]
LARGE = ["--size", "3840x2160"]
LARGE_DIVISIONS = [2, 4]


def seconds(command):
    """Processor seconds and peak MiB of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, after.ru_maxrss / 1024


def part(etendue, scene, options, which, of, folder):
    picture = folder / f"{which}-{of}.exr"
    command = [etendue, "render", str(scene), *options, "--shard", f"{which}/{of}", "-o", str(picture), "-q", "--threads", "1"]
    return seconds(command)[0], picture


def merged(etendue, parts, folder):
    return seconds([etendue, "merge", *map(str, parts), "-o", str(folder / "merged.exr"), "-q"])


def efficiency(etendue, scene, options):
    """A row: for each division the share of n machines' time that goes into samples."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        whole, _ = seconds([etendue, "render", str(scene), *options, "-o", str(folder / "whole.exr"), "-q", "--threads", "1"])
        drawn = [part(etendue, scene, options, i, 16, folder)[1] for i in range(1, 17)]
        joining = merged(etendue, drawn, folder)[0] / len(drawn)
        row = []
        for n in DIVISIONS:
            for picture in folder.glob(f"*-{n}.exr"):
                picture.unlink()  # what is there is not drawn again
            one = min(part(etendue, scene, options, which, n, folder)[0] for which in range(1, min(n, 2) + 1))
            row.append((whole / (n * one), whole / (n * (one + n * joining))))
        return whole, joining, row


def large(etendue):
    """Of parts of one sample: MiB of each, seconds to write the picture and to merge one, peak MiB."""
    scene = HERE.parent / "scenes/cornell-box/scene.xml"
    times = []
    for n in LARGE_DIVISIONS:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            parts = [part(etendue, scene, [*LARGE, "--spp", str(n)], i, n, folder)[1] for i in range(1, n + 1)]
            time, memory = merged(etendue, parts, folder)
            times.append(time)
            size = sum(p.stat().st_size for p in parts) / n / 2**20
    few, many = LARGE_DIVISIONS
    one = (times[1] - times[0]) / (many - few)
    return size, times[0] - few * one, one, memory


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--etendue", default=str(HERE.parent / "target/release/etendue"))
    parser.add_argument("--document", type=Path)
    arguments = parser.parse_args()
    lines = [
        "| efficiency with n parts | whole, s | to merge a part, s | " + " | ".join(map(str, DIVISIONS)) + " |",
        "| --- | ---: | ---: |" + " ---: |" * len(DIVISIONS),
    ]
    for name, (scene, options) in SCENES.items():
        whole, joining, row = efficiency(arguments.etendue, scene, options)
        cells = [f"{alone:.2f} ({total:.2f})" for alone, total in row]
        lines.append(f"| {name} | {whole:.1f} | {joining:.4f} | " + " | ".join(cells) + " |")
    size, picture, one, memory = large(arguments.etendue)
    lines += [
        "",
        f"Parts of a picture of 3840 × 2160: {size:.0f} MiB each; {one:.2f} s to merge one and {picture:.1f} s for the picture, with {memory:.0f} MiB at "
        f"most; a thousand take {(picture + 1000 * one) / 60:.0f} min and {1000 * size / 1024:.0f} GiB on disk.",
    ]
    text = "\n".join(lines)
    print(text)
    if arguments.document:
        begin, end = "<!-- begin efficiency -->", "<!-- end efficiency -->"
        document = arguments.document.read_text()
        head, rest = document.split(begin)
        arguments.document.write_text(head + begin + "\n\n" + text + "\n\n" + end + rest.split(end)[1])


if __name__ == "__main__":
    main()
