#!/usr/bin/env python3
"""How far rendering is from what memory allows: bytes per ray from beyond the second cache, against the bandwidth of the machine.

usage: limits.py [--etendue target/release/etendue] [--document docs/performance.md]

bandwidth      bytes read and written by copies of 1 GiB by one thread, the best of some
random lines   lines of 64 bytes at random places of 1 GiB, read one after the other
rays           per sample, as the program counts them; ns per ray by processor time of one thread, less the start
bytes per ray  data missing a cache of the size of this processor's second one, by cachegrind: what 8 further samples per pixel
               add to 4 (64² pixels), for caches to be warm. valgrind knows no AVX-512; the data are the same

Both shares are of the speed at which the bytes could come if nothing else was done: 100 % would be the physical limit.
"""
import argparse
import os
import re
import subprocess
import tempfile
import time

import numpy as np

import documents
import program
import scenes

LINE = 64
WHOLE = 1 << 30


def bandwidth():
    """Bytes per second of copying, and of reading random lines."""
    source, target = np.ones((2, WHOLE // LINE, LINE // 4), np.float32)
    # As many as the smallest piece of such a copy is long, else numpy would copy elements.
    places = np.random.default_rng(1).integers(0, len(source), len(source) // 8)

    def best(work, amount):
        times = []
        for _ in range(7):
            start = time.thread_time()
            work()
            times.append(time.thread_time() - start)
        return amount / min(times)

    copied = best(lambda: np.copyto(target, source), 2 * WHOLE)
    read = best(lambda: np.take(source, places, axis=0, out=target[: len(places)], mode="clip"), LINE * len(places))
    return copied, read


def second_cache():
    """Bytes and ways of a processor's second cache, as cachegrind wants them: a power of two of sets."""
    folder = "/sys/devices/system/cpu/cpu0/cache/index2/"
    with open(folder + "size", encoding="ascii") as size, open(folder + "ways_of_associativity", encoding="ascii") as ways:
        return int(size.read().strip().removesuffix("K")) * 1024, int(ways.read())


def missing(binary, scene, output, spp):
    """Data lines that the second cache lacks, and rays."""
    size, ways = second_cache()
    command = ["valgrind", "--tool=cachegrind", "--cache-sim=yes", f"--LL={size},{ways},{LINE}", "--cachegrind-out-file=/dev/null"]
    command += program.command(binary, scene, output, "--size", "64x64", "--spp", spp)
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = re.search(r"LLd misses:\s*([\d,]+)", run.stderr).group(1).replace(",", "")
    return int(lines), int(re.search(r'"rays":(\d+)', run.stdout).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--document")
    scenes.add_options(parser)
    options = parser.parse_args()
    copied, read = bandwidth()
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "picture.pfm")
        for name in scenes.SCENES:
            scene = scenes.write(folder, name, options)
            start = program.start(options.etendue, scene, output).seconds
            runs = [program.render(options.etendue, scene, output, "--spp", 16) for _ in range(options.rounds)]
            rays = runs[0].report["rays"]
            time_per_ray = (min(run.seconds for run in runs) - start) / rays
            (some, some_rays), (more, more_rays) = (missing(options.etendue, scene, output, spp) for spp in (4, 12))
            bytes_per_ray = LINE * (more - some) / (more_rays - some_rays)
            reached = bytes_per_ray / time_per_ray
            rows.append([
                name, f"{rays / runs[0].report['samples']:.2f}", f"{1e9 * time_per_ray:.0f}", f"{bytes_per_ray:.1f}",
                f"{reached / 1e9:.2f}", f"{100 * reached / copied:.1f} %", f"{100 * reached / read:.1f} %",
            ])
    head = ["scene", "rays per sample", "ns per ray", "bytes per ray", "GB/s", "of the bandwidth", "of random lines"]
    lines = [
        f"{documents.machine()}; one thread copies {copied / 1e9:.1f} GB/s and reads {read / 1e9:.1f} GB/s of random lines; "
        f"`surface` with {options.triangles} triangles.",
        "", *documents.table(head, rows),
    ]
    documents.publish(options.document, "limits", lines)


if __name__ == "__main__":
    main()
