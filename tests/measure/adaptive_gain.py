#!/usr/bin/env python3
"""How much sooner adaptive sampling reaches an error than uniform sampling, and what rounds cost.

usage: adaptive_gain.py [--etendue target/release/etendue] [--size 128x128] [--spp 256] [--seeds 3]

Renders every shipped scene with as many samples adaptively, uniformly in rounds, and by the plain loop, in turn,
on one thread. Times are processor times, which other processes disturb less than clocks. The time to an equal
error is that of equally many samples times the ratio of the squared errors:

    gain = (error_uniform² seconds_uniform) / (error_adaptive² seconds_adaptive)

Errors are those that the renders state (means over the seeds of their squares).
"""
import argparse
import json
import os
import subprocess
import tempfile

SCENES = ["cornell-box/scene", "glass-and-metal", "lambert-oren-nayar", "materials"]
WAYS = {"adaptive": ["--allocation", "adaptive"], "uniform": ["--allocation", "uniform"], "plain": []}


def render(options, scene, seed, arguments):
    """What the command reports, and the seconds of processor time it took."""
    with tempfile.TemporaryDirectory() as folder:
        command = [
            options.etendue, "render", f"scenes/{scene}.xml", "-o", os.path.join(folder, "a.pfm"), "--json", "--quiet",
            "--threads", "1", "--spp", str(options.spp), "--size", options.size, "--seed", str(seed), *arguments,
        ]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        report = json.loads(process.stdout.read())
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise SystemExit(f"{' '.join(command)} failed")
        return report, usage.ru_utime + usage.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--size", default="128x128")
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--seeds", type=int, default=3)
    options = parser.parse_args()

    print("| scene | error, uniform | adaptive | gain at equal samples | gain at equal time | rounds / plain loop |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for scene in SCENES:
        squares = dict.fromkeys(WAYS, 0.0)
        seconds = {way: [] for way in WAYS}
        for seed in range(options.seeds):
            for way, arguments in WAYS.items():
                report, time = render(options, scene, seed, arguments)
                seconds[way].append(time)
                if report["error"]:
                    squares[way] += report["error"]["estimate"] ** 2 / options.seeds
        least = {way: min(times) for way, times in seconds.items()}
        samples = squares["uniform"] / squares["adaptive"]
        time = samples * least["uniform"] / least["adaptive"]
        errors = [f"{100 * squares[way] ** 0.5:.2g} %" for way in ("uniform", "adaptive")]
        overhead = least["uniform"] / least["plain"]
        print(f"| {scene.split('/')[0]} | {errors[0]} | {errors[1]} | {samples:.2f} | {time:.2f} | {overhead:.2f} |", flush=True)


if __name__ == "__main__":
    main()
