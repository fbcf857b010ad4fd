#!/usr/bin/env python3
"""Writes cloud.vol: the density of the shipped scene heterogeneous-medium.xml, a puffy cloud by formula.

A dozen balls with soft edges on a flat base, roughened by a few sines; 24 × 16 × 24 cells of one channel, between
0 and 1, in Mitsuba's volume format. Run it in this directory; it needs nothing but Python.
"""
import math
import struct

SIZE = (24, 16, 24)

# centre and radius in the unit cube
PUFFS = [
    (0.50, 0.40, 0.50, 0.26),
    (0.30, 0.34, 0.45, 0.20),
    (0.70, 0.33, 0.55, 0.21),
    (0.45, 0.32, 0.72, 0.19),
    (0.58, 0.31, 0.28, 0.18),
    (0.40, 0.58, 0.52, 0.19),
    (0.60, 0.62, 0.46, 0.20),
    (0.52, 0.78, 0.50, 0.13),
    (0.18, 0.28, 0.52, 0.13),
    (0.84, 0.28, 0.48, 0.13),
    (0.28, 0.28, 0.26, 0.13),
    (0.72, 0.28, 0.78, 0.14),
]


def smooth_step(x):
    t = min(max(x, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def density(x, y, z):
    roughness = 0.03 * (math.sin(23 * x + 5 * z) + math.sin(19 * y + 11 * x) + math.sin(29 * z + 7 * y))
    depth = max(r - math.dist((x, y, z), (cx, cy, cz)) for cx, cy, cz, r in PUFFS) + roughness
    base = smooth_step((y - 0.14) / 0.1)
    return base * smooth_step(depth / 0.12)


def main():
    nx, ny, nz = SIZE
    values = [
        density((i + 0.5) / nx, (j + 0.5) / ny, (k + 0.5) / nz)
        for k in range(nz)
        for j in range(ny)
        for i in range(nx)
    ]
    with open("cloud.vol", "wb") as file:
        file.write(b"VOL\x03" + struct.pack("<5i6f", 1, nx, ny, nz, 1, 0, 0, 0, 1, 1, 1))
        file.write(struct.pack(f"<{len(values)}f", *values))


if __name__ == "__main__":
    main()
