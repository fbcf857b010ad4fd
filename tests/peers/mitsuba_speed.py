#!/usr/bin/env python3
"""Time of a render by étendue and by Mitsuba 3 (scalar_rgb), in turn, in one run.

usage: mitsuba_speed.py [--scene scenes/cornell-box/scene.xml] [--size 256] [--spp 64] [--threads 2] [--rounds 5]

Both render the same file at the same size and sample count with the same number of threads. Only rendering
is timed: étendue reports `render_seconds`, Mitsuba's clock runs around `mi.render` on a loaded scene. The
pictures are compared as well: a fast wrong picture is worth nothing.
Needs `pip install mitsuba numpy` and a release build of étendue.
"""
import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--scene", default="scenes/cornell-box/scene.xml")
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()

    import drjit
    import mitsuba
    import numpy

    mitsuba.set_variant("scalar_rgb")
    drjit.set_thread_count(options.threads)
    scene = mitsuba.load_file(options.scene, spp=options.spp, size=options.size)
    mitsuba.render(scene, spp=1, seed=0)  # warm up

    output = os.path.join(tempfile.mkdtemp(), "etendue.exr")
    command = [
        options.etendue, "render", options.scene, "-o", output, "--json", "--quiet",
        "--spp", str(options.spp), "--threads", str(options.threads), "-D", f"size={options.size}",
    ]
    ours, theirs, picture = [], [], None
    for round_number in range(options.rounds):
        report = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        ours.append(json.loads(report)["render_seconds"])
        start = time.perf_counter()
        picture = mitsuba.render(scene, spp=options.spp, seed=round_number)
        theirs.append(time.perf_counter() - start)

    ratios = [b / a for a, b in zip(ours, theirs)]
    mean_ours = numpy.array(mitsuba.Bitmap(output)).mean()
    mean_theirs = numpy.array(picture).mean()
    print(f"{options.scene}, {options.size}², {options.spp} spp, {options.threads} threads, {options.rounds} rounds")
    print(f"étendue              {statistics.median(ours):8.3f} s  ({min(ours):.3f} to {max(ours):.3f})")
    print(f"Mitsuba {mitsuba.__version__} scalar  {statistics.median(theirs):8.3f} s  ({min(theirs):.3f} to {max(theirs):.3f})")
    print(f"ratio                {statistics.median(ratios):8.2f}    ({min(ratios):.2f} to {max(ratios):.2f})")
    print(f"means of the pictures {mean_ours:.5f} and {mean_theirs:.5f}")


if __name__ == "__main__":
    main()
