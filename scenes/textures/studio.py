#!/usr/bin/env python3
"""Writes studio.hdr: the environment of the shipped scenes, a photographer's studio by formula.

A grey room, brighter above than below, with three soft boxes and a warm strip: smooth enough for a
small map, bright enough (up to 40 times the room) to make importance sampling worth while.
Run it in this directory; it needs nothing but Python.
"""
import math
import struct

WIDTH, HEIGHT = 256, 128

# azimuth and elevation of the centre, half width and half height (degrees), radiance
SOFT_BOXES = [
    (-60.0, 35.0, 22.0, 18.0, (38.0, 40.0, 42.0)),
    (75.0, 50.0, 14.0, 20.0, (24.0, 22.0, 18.0)),
    (170.0, 20.0, 40.0, 6.0, (6.0, 8.0, 12.0)),
    (20.0, 8.0, 50.0, 2.5, (9.0, 5.0, 2.0)),
]


def smooth_edge(x, half):
    """1 inside, 0 outside, a smooth step over 3 degrees at the edge."""
    t = min(max((half + 1.5 - abs(x)) / 3.0, 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def radiance(azimuth, elevation):
    level = 0.35 + 0.25 * math.sin(math.radians(elevation))
    rgb = [level * c for c in (0.95, 1.0, 1.08)]
    if elevation < 0.0:
        rgb = [level * c for c in (1.0, 0.92, 0.82)]
    for centre, height, half_width, half_height, colour in SOFT_BOXES:
        across = (azimuth - centre + 180.0) % 360.0 - 180.0
        weight = smooth_edge(across, half_width) * smooth_edge(elevation - height, half_height)
        rgb = [a + weight * b for a, b in zip(rgb, colour)]
    return rgb


def rgbe(rgb):
    """Shared-exponent encoding of the Radiance format."""
    largest = max(rgb)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256.0 / largest
    return struct.pack("4B", *(int(c * scale) for c in rgb), exponent + 128)


with open("studio.hdr", "wb") as file:
    file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
    for row in range(HEIGHT):
        elevation = 90.0 - 180.0 * (row + 0.5) / HEIGHT
        for column in range(WIDTH):
            file.write(rgbe(radiance(360.0 * (column + 0.5) / WIDTH - 180.0, elevation)))
