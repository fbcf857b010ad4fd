#!/usr/bin/env python3
"""Writes weave.png: 16 × 16 texels of two interwoven strands."""
import struct
import zlib

SIZE, STRAND = 16, 4
SHADE = [0.55, 1, 1, 0.55]  # across a strand
COLOURS = [(70, 90, 130), (200, 150, 90)]  # lying along y, along x


def texel(x, y):
    along_x = (x // STRAND + y // STRAND) % 2 == 0
    shade = SHADE[(y if along_x else x) % STRAND]
    return bytes(int(c * shade) for c in COLOURS[along_x])


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


rows = b"".join(b"\0" + b"".join(texel(x, y) for x in range(SIZE)) for y in range(SIZE))
header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
with open("weave.png", "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
