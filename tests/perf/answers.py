#!/usr/bin/env python3
"""Writes the short answers at the top of docs/performance.md from the tables below them.

usage: answers.py docs/performance.md

To be run after `profiles.py`, `growth.py`, `limits.py` and `packagers.py` have written their parts.
"""
import sys

import documents


def numbers(row):
    return [float(cell.removesuffix("%")) for cell in row.values()]


def span(values, unit):
    return f"{min(values):.0f} to {max(values):.0f} {unit}"


def answers(path):
    profiles = documents.part(path, "profiles")
    rays = numbers(next(row for name, row in profiles.items() if name.startswith("*rays")))
    triangles = documents.part(path, "growth triangles")
    lights = documents.part(path, "growth lights")
    limits = documents.part(path, "limits")
    packagers = documents.part(path, "packagers")["geometric mean"]
    few, many = triangles["10³"], triangles["10⁷"]
    one, most = lights["10⁰"], lights["10⁵"]
    sample = "µs per sample"
    yield "Where does the time go?", f"{span(rays, '%')} into rays meeting shapes, the rest into what is done where they meet", "where-the-time-goes"
    yield (
        "10⁴ times as many triangles?",
        f"{float(many[sample]) / float(few[sample]):.1f} times the time per sample; {many['bytes per triangle']} bytes per triangle at most",
        "how-it-grows",
    )
    yield "10⁵ lights instead of one?", f"{float(most[sample]) / float(one[sample]):.1f} times the time per sample", "how-it-grows"
    yield (
        "When is there a first pixel?",
        f"after {few['first pixel, s']} s with 10³ triangles, {triangles['10⁶']['first pixel, s']} s with 10⁶",
        "how-it-grows",
    )
    threads = documents.part(path, "growth threads")
    count = list(next(iter(threads.values())))[-1]
    yield f"{count} instead of one?", " and ".join(f"{row[count]} (`{name}`)" for name, row in threads.items()) + " times as fast", "how-it-grows"
    lines = [float(row["of random lines"].removesuffix("%")) for row in limits.values()]
    yield "Is memory the limit?", f"{span(lines, '%')} of the bytes that could come are asked for", "the-physical-limit"
    yield (
        "What does compiling differently gain?",
        ", ".join(f"`{way}` {gain} times the speed" for way, gain in packagers.items()),
        "for-packagers",
    )


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    rows = [[question, answer, f"[{anchor.replace('-', ' ')}](#{anchor})"] for question, answer, anchor in answers(sys.argv[1])]
    lines = ["| question | answer | more |", "| --- | --- | --- |", *("| " + " | ".join(row) + " |" for row in rows)]
    documents.publish(sys.argv[1], "answers", lines)


if __name__ == "__main__":
    main()
