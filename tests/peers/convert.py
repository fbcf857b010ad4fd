#!/usr/bin/env python3
"""Does Mitsuba 3 (scalar_rgb) render what `etendue convert` writes as étendue renders what it was written from?

usage: convert.py [--etendue target/release/etendue] [--scenes tests/scenes scenes] [--runs 8]
                  [--spp-factor 1] [--most-pixels 64] [--most-samples 64] [--markdown] [NAME ...]

Every scene under the folders, in each variant that it lists, is converted; Mitsuba loads and renders what was written, étendue
the scene itself, and the two stacks of pictures are compared as in agreement.py, which says how. Pictures are at most
`--most-pixels` wide and high, with at most `--most-samples` per pixel. Where the conversion lost something, étendue renders what
was written, too, and the result says so.

Exit code: 0 all agree, 1 some differ, 2 something could not be converted or rendered.

Needs `pip install mitsuba numpy` and a release build of étendue.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

import agreement


def files_under(folders):
    for folder in folders:
        for where, _, names in sorted(os.walk(folder)):
            if os.path.basename(where) != "include":  # parts of others
                yield from (os.path.join(where, name) for name in sorted(names) if name.endswith(".xml"))


def convert(binary, path, definitions, output):
    """Writes the converted scene; gives the warnings about what is lost."""
    command = [binary, "convert", path, output]
    command += [word for name, value in definitions.items() for word in ("-D", f"{name}={value}")]
    result = subprocess.run(command, capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(result.stderr.strip())
    return [line for line in result.stderr.splitlines() if re.search(r"is lost|are lost|only the first is", line)]


def shrink(path, most_pixels, most_samples):
    """Makes the picture of a converted scene small; gives the size where it was too large."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    spp = int(re.search(r'name="spp" value="(\d+)"', text).group(1))
    text = text.replace(f'name="spp" value="{spp}"', f'name="spp" value="{min(spp, most_samples)}"')
    size = [int(re.search(f'name="{name}" value="(\\d+)"', text).group(1)) for name in ("width", "height")]
    largest = max(size)
    if largest > most_pixels:
        size = [max(1, round(n * most_pixels / largest)) for n in size]
        text = re.sub(r'\s*<integer name="crop_\w+" value="\d+"/>', "", text)
        for name, pixels in zip(("width", "height"), size):
            text = re.sub(f'(<integer name="{name}" value=")\\d+', f"\\g<1>{pixels}", text)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return size if largest > most_pixels else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--etendue", default="target/release/etendue")
    parser.add_argument("--scenes", nargs="+", default=["tests/scenes", "scenes"])
    parser.add_argument("--runs", type=int, default=8)
    parser.add_argument("--spp-factor", type=int, default=1)
    parser.add_argument("--most-pixels", type=int, default=64)
    parser.add_argument("--most-samples", type=int, default=64)
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()

    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    row = "| {} | {} | {} | {} | {} |" if options.markdown else "{:<58} {:<15} {:>10} {:>11} {:>9}"
    print(row.format("scene and variant", "result", "accepted", "Δ mean", "in σ"))
    if options.markdown:
        print("| --- | --- | ---: | ---: | ---: |")
    differing, failed = 0, 0
    for path in files_under(options.scenes):
        if options.names and not any(part in path for part in options.names):
            continue
        for definitions in agreement.variants(path):
            stem = os.path.splitext(os.path.basename(path))[0]
            stem = os.path.basename(os.path.dirname(path)) if stem == "scene" else stem
            name = " ".join([stem] + [f"{key}={value}" for key, value in definitions.items()])
            with tempfile.TemporaryDirectory() as folder:
                output = os.path.join(folder, "scene.xml")
                try:
                    lost = convert(options.etendue, path, definitions, output)
                    size = shrink(output, options.most_pixels, options.most_samples)
                    theirs, spp = agreement.render_mitsuba(output, {}, options.runs, options.spp_factor)
                    original = (output, {}) if lost else (path, definitions)
                    arguments = ["--size", "x".join(map(str, size))] if size else []
                    ours = agreement.render_etendue(options.etendue, *original, options.runs, spp, arguments)
                    if ours.shape != theirs.shape:
                        raise RuntimeError(f"sizes differ: {ours.shape[2:0:-1]} and {theirs.shape[2:0:-1]}")
                except RuntimeError as error:
                    failed += 1
                    print(row.format(name, "failed", *[""] * 3).rstrip())
                    print(error, file=sys.stderr)
                    continue
            comparison = agreement.Comparison(ours, theirs, spp)
            differing += not comparison.agrees
            result = ("agrees" if comparison.agrees else "differs") + (", with losses" if lost else "")
            print(row.format(name, result, *comparison.figures()), flush=True)
    print(f"\nMitsuba {mitsuba.__version__}: {differing} differ, {failed} failed", file=sys.stderr)
    sys.exit(2 if failed else 1 if differing else 0)


if __name__ == "__main__":
    main()
