#!/usr/bin/env python3
"""Where the time of each reference scene goes: shares of samples of the program counter, by the source file that each is from.

usage: profiles.py [--etendue target/profile/release/etendue] [--spp 16] [--document docs/performance.md]

    CARGO_PROFILE_RELEASE_DEBUG=line-tables-only cargo build --release -p etendue-cli --target-dir target/profile

What a path runs through is inlined into one function, so symbols say nothing. The lines of a build with line tables do: of the frames
inlined at an address, from the innermost outwards, the first whose file is in `NOUNS` counts. Needs perf (Linux), addr2line and
readelf. One thread; samples are taken by the processor's clock, a thousand a second.
"""
import argparse
import collections
import os
import re
import subprocess
import tempfile

import documents
import program
import scenes

# The first whose pattern is in the path of a file. Helpers that are everybody's (vectors, numbers) have none: who called them counts.
NOUNS = {
    "traversal": r"geometry/bvh/(simd|traverse|boxes|node|block)|geometry/rays\.rs",
    "building": r"geometry/bvh/(build|split|binary|mod)|geometry/builder",
    "triangles": r"geometry/bvh/triangles|geometry/triangle\.rs",
    "other shapes": r"geometry/(cube|curves|cylinder|disk|rectangle|sdf|sphere|root|shape)",
    "choice of lights": r"light_sampler/",
    "points on lights": r"geometry/(seen|sample)|scene/src/light/|sampling/src/(tabulated|warp/(seen|spherical|triangle|rectangle|area))|path/(direct_light|found_light)",
    "points of surfaces": r"geometry/|math/src/frame",
    "materials": r"crates/brdf/|scene/src/material|path/scatter",
    "textures": r"scene/src/texture",
    "random numbers": r"sampling/src/(independent|sobol|owen|sampler|dimension|pcg32)|math/src/hash",
    "film": r"renderer/src/(film|tile|render|progressive|pilot)|scene/src/film",
    "camera": r"scene/src/camera",
    "paths": r"renderer/src/path|renderer/src/|scene/src/scene",
    "loading": r"scene/src/(load|mitsuba|xml|gltf|parallel)|png-|/image-|zune|fdeflate|roxmltree|flate2",
    "output": r"apps/cli",
}
# What a renderer does that only follows rays.
RAYS = ["traversal", "triangles", "other shapes"]
OTHERS = {"float functions": r"libm|/m/|math/src/backend|compiler_builtins", "system": r""}


def counts(binary, scene, output, spp, folder):
    """How often each address of the binary, and each other object, was met."""
    data = os.path.join(folder, "perf.data")
    command = program.command(binary, scene, output, "--spp", spp)
    record = ["perf", "record", "-q", "-e", "cpu-clock", "-F", "1000", "-o", data, *command]
    subprocess.run(record, stdout=subprocess.DEVNULL, check=True)
    script = ["perf", "script", "-i", data, "--show-mmap-events", "-F", "ip,dso"]
    text = subprocess.run(script, capture_output=True, text=True, check=True).stdout
    name = re.escape(os.path.realpath(binary))
    start, offset = (
        int(x, 16) for x in re.search(rf"\[0x(\w+)\(0x\w+\) @ (?:0x)?(\w+) [^\n]*r-xp {name}\n", text).groups()
    )
    shift = segment(binary, offset) - start
    addresses, objects = collections.Counter(), collections.Counter()
    for address, name in re.findall(r"^\s*([0-9a-f]+) \((.*)\)$", text, re.MULTILINE):
        if name == os.path.realpath(binary):
            addresses[int(address, 16) + shift] += 1
        else:
            objects[name] += 1
    return addresses, objects


def segment(binary, offset):
    """The address that the linker gave to an offset of the file, in what is executable."""
    headers = subprocess.run(["readelf", "-lW", binary], capture_output=True, text=True, check=True).stdout
    at, address = (int(x, 16) for x in re.search(r"LOAD\s+0x(\w+) 0x(\w+) 0x\w+ 0x\w+ 0x\w+ R E", headers).groups())
    return offset - at + address


def frames(binary, addresses):
    """Files of the frames inlined at each address, the innermost first."""
    lines = "".join(f"{address:#x}\n" for address in addresses)
    command = ["addr2line", "-a", "-i", "-e", binary]
    output = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout
    for part in re.split(r"^0x", output, flags=re.MULTILINE)[1:]:
        address, *files = part.splitlines()
        yield int(address, 16), files


def noun(files, nouns):
    for file in files:
        for name, pattern in nouns.items():
            if re.search(pattern, file):
                return name
    return None


def shares(binary, scene, output, spp, folder):
    """Parts of the whole by noun."""
    addresses, objects = counts(binary, scene, output, spp, folder)
    sums = collections.Counter()
    for address, files in frames(binary, addresses):
        sums[noun(files, NOUNS) or noun(files, OTHERS)] += addresses[address]
    for name, count in objects.items():
        sums[noun([name], OTHERS)] += count
    total = sum(sums.values())
    return {name: count / total for name, count in sums.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--etendue", default="target/profile/release/etendue")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--document")
    scenes.add_options(parser)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "picture.pfm")
        columns = {
            name: shares(options.etendue, scenes.write(folder, name, options), output, options.spp, folder) for name in scenes.SCENES
        }
    rows = [
        [name, *(f"{100 * column.get(name, 0):.1f}" for column in columns.values())]
        for name in [*NOUNS, *OTHERS] if any(column.get(name, 0) >= 0.0005 for column in columns.values())
    ]
    rays = [sum(column.get(name, 0) for name in RAYS) for column in columns.values()]
    rows.append(["*rays: " + ", ".join(RAYS) + "*", *(f"{100 * share:.1f}" for share in rays)])
    lines = documents.table(["% of the time", *columns], rows)
    documents.publish(options.document, "profiles", [documents.machine() + ".", "", *lines])


if __name__ == "__main__":
    main()
