#!/usr/bin/env python3
"""Writes the price list of every shipped scene into a document: what each effect costs, what leaving it out does.

usage: effect_prices.py DOCUMENT [--etendue target/release/etendue] [--spp 16] [--rounds 5]

Tables of `etendue effects --measure` go between the lines `<!-- begin prices -->` and `<!-- end prices -->`, what the configuration
of a scene saves between those of `unused`. A scene with one effect alone is black without it and has no prices.
"""
import argparse
import glob
import json
import subprocess

SIZES = {"scenes/cornell-box/scene.xml": "160x160"}
USUAL_SIZE = "240x160"


def prices(options, scene):
    command = [
        options.etendue, "effects", scene, "--measure", "--json", "--quiet", "--spp", str(options.spp),
        "--rounds", str(options.rounds), "--size", SIZES.get(scene, USUAL_SIZE),
    ]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout)


def row(name, price):
    return (
        f"| {name} | {price['effect']} | {price['time_percent']:+.0f} % "
        f"| {price['mean_difference_percent']:+.1f} % | {price['flip']:.3f} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("document")
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()

    lines = [
        "| scene | effect | time it adds | mean without it | ꟻLIP without it |",
        "| --- | --- | ---: | ---: | ---: |",
    ]
    unused = ["| scene | configuration | time that everything would add |", "| --- | --- | ---: |"]
    scenes = sorted(glob.glob("scenes/*.xml") + glob.glob("scenes/cornell-box/*.xml") + glob.glob("scenes/effects/*.xml"))
    for scene in scenes:
        measured = prices(options, scene)
        name = scene.removeprefix("scenes/").removesuffix(".xml").removesuffix("/scene")
        unused.append(f"| {name} | {measured['configuration']} | {measured['unused_percent']:+.1f} % |")
        listed = measured["effects"]
        if len(listed) > 1:
            lines += [row(name if i == 0 else "", price) for i, price in enumerate(listed)]

    with open(options.document, encoding="utf-8") as file:
        text = file.read()
    for part, table in [("prices", lines), ("unused", unused)]:
        begin, end = f"<!-- begin {part} -->\n", f"<!-- end {part} -->\n"
        before, rest = text.split(begin)
        text = f"{before}{begin}\n" + "\n".join(table) + f"\n\n{end}" + rest.split(end)[1]
    with open(options.document, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
