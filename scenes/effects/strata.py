#!/usr/bin/env python3
"""Writes strata.vol: the stone of the shipped scene volume-texture.xml, by formula.

Bent layers of ochre, rust and grey; 20 × 20 × 20 cells of linear RGB, in Mitsuba's volume format. Run it in this
directory; it needs nothing but Python.
"""
import math
import struct

SIZE = 20

# height within a period, and the colour of the layer that begins there
LAYERS = [
    (0.00, (0.55, 0.36, 0.16)),
    (0.35, (0.30, 0.10, 0.05)),
    (0.50, (0.62, 0.52, 0.38)),
    (0.80, (0.16, 0.17, 0.20)),
]


def stone(x, y, z):
    height = 3.0 * (y + 0.35 * x + 0.05 * math.sin(9.0 * x + 4.0 * z) + 0.07 * math.sin(7.0 * z))
    within = height % 1.0
    return [color for begin, color in LAYERS if begin <= within][-1]


def main():
    centres = [(i + 0.5) / SIZE for i in range(SIZE)]
    values = [channel for z in centres for y in centres for x in centres for channel in stone(x, y, z)]
    with open("strata.vol", "wb") as file:
        file.write(b"VOL\x03" + struct.pack("<5i6f", 1, SIZE, SIZE, SIZE, 3, 0, 0, 0, 1, 1, 1))
        file.write(struct.pack(f"<{len(values)}f", *values))


if __name__ == "__main__":
    main()
