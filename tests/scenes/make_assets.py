#!/usr/bin/env python3
"""Writes the small files the scenes in this folder refer to, into assets/. Standard library only.

usage: make_assets.py [FOLDER]

The patterns have no symmetry, so that a flipped, turned or shifted texture is a different picture.
"""
import math
import os
import struct
import sys
import zlib


def png(path, width, height, pixel):
    """8-bit PNG; `pixel(x, y)` gives one byte per channel, y downwards."""
    rows = [[pixel(x, y) for x in range(width)] for y in range(height)]
    color_type = {1: 0, 3: 2}[len(rows[0][0])]
    raw = b"".join(b"\0" + bytes(value for p in row for value in p) for row in rows)

    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))

    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
        file.write(chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def exr(path, width, height, pixel):
    """Uncompressed OpenEXR of 32-bit RGB; `pixel(x, y)` gives three floats."""

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    channels = b"".join(c + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = b"\x76\x2f\x31\x01\x02\0\0\0"
    header += attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", b"\0")
    header += attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window)
    header += attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    line = 12 * width
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header)
        file.write(b"".join(struct.pack("<Q", first + y * (8 + line)) for y in range(height)))
        for y in range(height):
            colors = [pixel(x, y) for x in range(width)]
            planes = b"".join(struct.pack("<f", color[c]) for c in (2, 1, 0) for color in colors)
            file.write(struct.pack("<iI", y, line) + planes)


def hdr(path, width, height, pixel):
    """Radiance picture without run lengths."""
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            for x in range(width):
                color = pixel(x, y)
                _, exponent = math.frexp(max(color))
                scale = math.ldexp(256, -exponent)
                file.write(bytes([min(int(c * scale), 255) for c in color] + [exponent + 128]))


def card(x, y):
    """A colour card of 8 × 4: every texel another colour, brighter towards the upper left."""
    return (40 + (7 - x) * 25, 40 + (3 - y) * 60, 40 + (x * 5 + y * 11) % 8 * 26)


def sky(x, y):
    """An uneven sky of 32 × 16 over a brown ground, with a soft bright patch on the left."""
    up = 1 - (y + 0.5) / 16
    patch = 6 * math.exp(-((x - 9) / 3) ** 2 - ((y - 4) / 2) ** 2)
    tint = 0.3 * (1 + math.cos(2 * math.pi * (x - 3) / 32))
    if up < 0.5:
        return (0.3 + 0.2 * tint, 0.2, 0.1 + 0.1 * tint)
    return (0.3 + patch + tint, 0.4 + 0.9 * patch + 0.5 * tint, 0.5 + 0.7 * patch + 0.4 * up)


def torus(rings=14, sides=8, major=0.7, minor=0.3):
    """Vertices (position, normal, uv) and quadrilaterals of a torus around z; the seams are open in uv."""
    vertices, faces = [], []
    for i in range(rings + 1):
        for j in range(sides + 1):
            a, b = 2 * math.pi * i / rings, 2 * math.pi * j / sides
            normal = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b))
            center = (major * math.cos(a), major * math.sin(a), 0)
            position = tuple(c + minor * n for c, n in zip(center, normal))
            vertices.append((position, normal, (i / rings, j / sides)))
    for i in range(rings):
        for j in range(sides):
            k = i * (sides + 1) + j
            faces.append((k, k + sides + 1, k + sides + 2, k + 1))
    return vertices, faces


def obj(path, has_normals):
    vertices, faces = torus()
    lines = ["# a torus of quadrilaterals"]
    lines += ["v %.5g %.5g %.5g" % p for p, _, _ in vertices]
    lines += ["vt %.5g %.5g" % uv for _, _, uv in vertices]
    if has_normals:
        lines += ["vn %.5g %.5g %.5g" % n for _, n, _ in vertices]
    corner = "{0}/{0}/{0}" if has_normals else "{0}/{0}"
    lines += ["f " + " ".join(corner.format(k + 1) for k in face) for face in faces]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def ply(path, is_binary):
    vertices, faces = torus()
    triangles = [(f[0], f[a], f[a + 1]) for f in faces for a in (1, 2)]
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if is_binary else []) + ["u", "v"]
    header = ["ply", "format %s 1.0" % ("binary_little_endian" if is_binary else "ascii")]
    header += ["element vertex %d" % len(vertices)] + ["property float " + name for name in names]
    header += ["element face %d" % len(triangles), "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        for position, normal, uv in vertices:
            values = position + (normal if is_binary else ()) + uv
            text = " ".join("%.5g" % v for v in values) + "\n"
            file.write(struct.pack("<%df" % len(values), *values) if is_binary else text.encode())
        for triangle in triangles:
            text = "3 %d %d %d\n" % triangle
            file.write(struct.pack("<Biii", 3, *triangle) if is_binary else text.encode())


def serialized(path):
    """Version 4, two meshes: a triangle, and the torus with normals and coordinates."""
    vertices, faces = torus()
    triangles = [(f[0], f[a], f[a + 1]) for f in faces for a in (1, 2)]
    corners = [((0, 0, 0), (0, 0, 1), (0, 0)), ((1, 0, 0), (0, 0, 1), (1, 0)), ((0, 1, 0), (0, 0, 1), (0, 1))]
    offsets = []
    with open(path, "wb") as file:
        for name, (vertices, triangles) in [(b"triangle", (corners, [(0, 1, 2)])), (b"torus", (vertices, triangles))]:
            offsets.append(file.tell())
            stream = struct.pack("<I", 0x1003) + name + b"\0" + struct.pack("<QQ", len(vertices), len(triangles))
            for part in range(3):
                stream += b"".join(struct.pack("<%df" % len(v[part]), *v[part]) for v in vertices)
            stream += b"".join(struct.pack("<3I", *t) for t in triangles)
            file.write(struct.pack("<HH", 0x041C, 4) + zlib.compress(stream, 9))
        file.write(struct.pack("<%dQI" % len(offsets), *offsets, len(offsets)))


def vol(path, size, channels, value):
    """Mitsuba's volume format; `value(x, y, z)` gives one float per channel, for cells in a box of 2 × 1 × 1."""
    nx, ny, nz = size
    cells = [value(x, y, z) for z in range(nz) for y in range(ny) for x in range(nx)]
    numbers = [number for cell in cells for number in cell]
    with open(path, "wb") as file:
        file.write(b"VOL\x03" + struct.pack("<5i6f", 1, nx, ny, nz, channels, -0.5, 0, 0, 1.5, 1, 1))
        file.write(struct.pack(f"<{len(numbers)}f", *numbers))


def smoke(x, y, z):
    return 0.1 + ((3 * x + 5 * y + 7 * z) % 11) / 11


def normals(x, y):
    """Normals of a pyramid that leans."""
    dx, dy = x - 3.5, y - 3.5
    n = (math.copysign(0.5, dx), 0.1, 0.8) if abs(dx) > abs(dy) else (-0.1, math.copysign(0.5, dy), 0.8)
    length = math.sqrt(sum(c * c for c in n))
    return tuple(round(255 * (c / length + 1) / 2) for c in n)


def bumps(x, y):
    return (round(127.5 + 127.5 * math.sin(math.pi * (x + 0.5) / 4) * math.cos(math.pi * (y + 1) / 4)),)


def octahedron(path):
    """A colour of each vertex and a number of each face."""
    corners = [(0, 0, 1), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
    colors = [(0.9, 0.9, 0.9), (0.9, 0.1, 0.1), (0.1, 0.9, 0.1), (0.1, 0.1, 0.9), (0.9, 0.9, 0.1), (0.1, 0.1, 0.1)]
    faces = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]
    weights = [0.05, 0.9, 0.2, 0.7, 0.4, 0.6, 0.3, 0.8]
    lines = ["ply", "format ascii 1.0", "comment an octahedron with a colour of each vertex and a weight of each face"]
    lines += ["element vertex 6"] + ["property float " + name for name in ["x", "y", "z"]]
    lines += ["property float color_%d" % i for i in range(3)]
    lines += ["element face 8", "property list uchar int vertex_indices", "property float weight_0", "end_header"]
    lines += [" ".join(map(str, vertex)) for vertex in (p + c for p, c in zip(corners, colors))]
    lines += ["3 %d %d %d %g" % (face + (weight,)) for face, weight in zip(faces, weights)]
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "assets")
    os.makedirs(folder, exist_ok=True)

    def path(name):
        return os.path.join(folder, name)

    png(path("card.png"), 8, 4, card)
    png(path("roughness.png"), 4, 4, lambda x, y: (30 + 13 * ((x + 3 * y) % 13),))
    png(path("holes.png"), 8, 8, lambda x, y: (255 if (x * 3 + y * 5) % 7 > 2 else 60 * (y % 3),))
    png(path("normals.png"), 8, 8, normals)
    png(path("bumps.png"), 8, 8, bumps)
    exr(path("sky.exr"), 32, 16, sky)
    hdr(path("sky.hdr"), 32, 16, sky)
    obj(path("torus.obj"), has_normals=True)
    obj(path("torus-without-normals.obj"), has_normals=False)
    ply(path("torus.ply"), is_binary=True)
    ply(path("torus-ascii.ply"), is_binary=False)
    vol(path("grey.vol"), (6, 4, 5), 1, lambda x, y, z: (smoke(x, y, z) * (x + y > 2),))
    vol(path("rgb.vol"), (4, 3, 5), 3, lambda x, y, z: [0.9 * smoke(*p) for p in ((x, y, z), (y, z, x), (z, x, y))])
    octahedron(path("octahedron.ply"))
    serialized(path("two.serialized"))
    with open(path("leaf.spd"), "w") as file:
        file.write("# wavelength in nm, reflectance\n400 0.05\n500 0.1\n550 0.35\n600 0.15\n680 0.05\n720 0.5\n")


if __name__ == "__main__":
    main()
