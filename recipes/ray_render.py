#!/usr/bin/env python3
"""Renders a scene in parts as tasks of Ray, on this machine or on a cluster that shares a folder.

    ray_render.py SCENE PARTS PICTURE [options of etendue render]

A part whose worker dies is drawn again (max_retries), and goes on with its checkpoint. RAY_ADDRESS names a cluster; ETENDUE the command.
"""

import os
import subprocess
import sys
from pathlib import Path

import ray

ETENDUE = os.environ.get("ETENDUE", "etendue")


@ray.remote(max_retries=3, num_cpus=1, retry_exceptions=[subprocess.CalledProcessError])
def draw(scene, part, parts, folder, options):
    """One part; returns where it is."""
    picture = folder / f"{part}.exr"
    checkpoint = folder / f"{part}.checkpoint"
    command = [ETENDUE, "render", str(scene), "--shard", f"{part}/{parts}", "-o", str(picture), "-q"]
    subprocess.run([*command, "--checkpoint", f"{checkpoint}:5min", "--threads", "1", *options], check=True)
    return str(picture)


def main():
    scene, parts, picture = Path(sys.argv[1]).resolve(), int(sys.argv[2]), Path(sys.argv[3]).resolve()
    folder = picture.with_name(picture.name + ".parts")
    folder.mkdir(exist_ok=True)
    ray.init(log_to_driver=False)
    drawn = ray.get([draw.remote(scene, part, parts, folder, sys.argv[4:]) for part in range(1, parts + 1)])
    subprocess.run([ETENDUE, "merge", *drawn, "-o", str(picture), "-q"], check=True)


if __name__ == "__main__":
    main()
