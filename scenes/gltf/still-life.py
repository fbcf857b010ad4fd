#!/usr/bin/env python3
"""Writes still-life.gltf with still-life.bin and leaf.png: balls of metal, glass and paint on pedestals, a leaf, three kinds of light."""
import json
import math
import struct
import zlib

COLUMNS, ROWS, LEAF = 32, 16, 32
buffer, views, accessors = bytearray(), [], []


def accessor(kind, component, values, **bounds):
    """Puts vectors into the buffer."""
    code = {5126: "f", 5123: "H", 5121: "B"}[component]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
    flat = [x for value in values for x in value] if width > 1 else values
    data = struct.pack(f"<{len(flat)}{code}", *flat)
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
    buffer.extend(data + bytes(-len(data) % 4))
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind, "count": len(values), **bounds})
    return len(accessors) - 1


def positions(points):
    axes = list(zip(*points))
    return accessor("VEC3", 5126, points, min=[min(a) for a in axes], max=[max(a) for a in axes])


def ball():
    """A ball of radius 1 with texture coordinates of longitude and latitude."""
    points, uvs, triangles = [], [], []
    for row in range(ROWS + 1):
        for column in range(COLUMNS + 1):
            u, v = column / COLUMNS, row / ROWS
            theta, phi = math.pi * v, 2 * math.pi * u
            # Single precision, so that poles and seam are where the file says.
            point = (math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi))
            points.append(tuple(struct.unpack("<3f", struct.pack("<3f", *point))))
            uvs.append((u, v))
    for row in range(ROWS):
        for column in range(COLUMNS):
            a = row * (COLUMNS + 1) + column
            b = a + COLUMNS + 1
            triangles += [a, b, b + 1] if row < ROWS - 1 else []
            triangles += [a, b + 1, a + 1] if row > 0 else []
            if row == ROWS - 1:
                triangles += [a, b, a + 1]
    position = positions(points)
    return {
        "attributes": {"POSITION": position, "NORMAL": position, "TEXCOORD_0": accessor("VEC2", 5126, uvs)},
        "indices": accessor("SCALAR", 5123, triangles),
    }


def square(colours=None):
    """A square of side 2 that faces +y, as a strip."""
    attributes = {
        "POSITION": positions([(-1, 0, 1), (1, 0, 1), (-1, 0, -1), (1, 0, -1)]),
        "TEXCOORD_0": accessor("VEC2", 5126, [(0, 1), (1, 1), (0, 0), (1, 0)]),
    }
    if colours:
        attributes["COLOR_0"] = accessor("VEC4", 5121, colours, normalized=True)
    return {"attributes": attributes, "mode": 5}


def box():
    """A box of side 2, faceted for want of normals."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [i for a, b, c, d in faces for i in (a, b, c, a, c, d)]
    return {"attributes": {"POSITION": positions(corners)}, "indices": accessor("SCALAR", 5121, triangles)}


def leaf(x, y):
    """A texel of a leaf: green around a vein, and nothing outside."""
    u, v = (x + 0.5) / LEAF * 2 - 1, (y + 0.5) / LEAF * 2 - 1
    is_there = abs(u) < 0.75 * math.sqrt(max(0.0, 1 - v * v)) * (1 - 0.3 * v)
    vein = abs(u) < 0.06 or abs((v + abs(u)) % 0.5 - 0.25) < 0.03
    return (150, 190, 90, 255) if is_there and vein else (60, 130, 40, 255) if is_there else (60, 130, 40, 0)


def png(width, height, texel):
    rows = b"".join(b"\0" + b"".join(bytes(texel(x, y)) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def turn(axis, degrees):
    """A rotation as a quaternion."""
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * a for a in axis), math.cos(half)]


def aim(start, end):
    """The shortest rotation that takes −z into the direction from one point to another."""
    away = [b - a for a, b in zip(start, end)]
    x, y, z = (a / math.hypot(*away) for a in away)
    quaternion = [y, -x, 0, 1 - z]
    return [a / math.hypot(*quaternion) for a in quaternion]


def pbr(colour, metallic, roughness):
    return {"baseColorFactor": [*colour, 1], "metallicFactor": metallic, "roughnessFactor": roughness}


round_body, plane, block = ball(), square([(255, 240, 220, 255)] * 2 + [(120, 130, 160, 255)] * 2), box()
materials = [
    {"name": "floor", "pbrMetallicRoughness": pbr((0.8, 0.8, 0.8), 0, 0.9)},
    {"name": "stone", "pbrMetallicRoughness": pbr((0.5, 0.47, 0.42), 0, 1)},
    {"name": "gold", "pbrMetallicRoughness": pbr((1, 0.77, 0.34), 1, 0.4)},
    {
        "name": "paint",
        "pbrMetallicRoughness": pbr((0.6, 0.04, 0.03), 0, 0.5),
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.3}},
    },
    {
        "name": "green glass",
        "pbrMetallicRoughness": pbr((1, 1, 1), 0, 0),
        "extensions": {
            "KHR_materials_ior": {"ior": 1.5},
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 1, "attenuationColor": [0.3, 0.8, 0.45]},
        },
    },
    {
        "name": "leaf",
        "alphaMode": "MASK",
        "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 0.6},
    },
    {
        "name": "lamp",
        "pbrMetallicRoughness": pbr((0, 0, 0), 0, 1),
        "emissiveFactor": [1, 0.9, 0.75],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2.5}},
    },
]


def mesh(name, primitive, material):
    return {"name": name, "primitives": [{**primitive, "material": material}]}


meshes = [
    mesh("floor", plane, 0),
    mesh("pedestal", block, 1),
    mesh("gold ball", round_body, 2),
    mesh("painted ball", round_body, 3),
    mesh("glass ball", round_body, 4),
    mesh("leaf", square(), 5),
    mesh("lamp", square(), 6),
]


def on_pedestal(x, ball, radius):
    """A pedestal with a ball on it."""
    return [
        {"mesh": 1, "translation": [x, 0.25, 0], "scale": [0.6, 0.25, 0.6]},
        {"mesh": ball, "translation": [x, 0.5 + radius, 0], "scale": [radius] * 3},
    ]


nodes = [
    {"name": "floor", "mesh": 0, "scale": [6, 1, 4]},
    *on_pedestal(-1.6, 2, 0.55),
    *on_pedestal(0, 4, 0.55),
    *on_pedestal(1.6, 3, 0.55),
    {"name": "leaf", "mesh": 5, "translation": [0.75, 0.55, 1.1], "rotation": turn((1, 0, 0), 62), "scale": [0.4, 1, 0.55]},
    {"name": "lamp", "mesh": 6, "translation": [0, 4, 0.5], "rotation": turn((1, 0, 0), 180), "scale": [2, 1, 1.5]},
    {
        "name": "spot",
        "translation": [-4, 4, 3],
        "rotation": aim((-4, 4, 3), (0, 0.5, 0)),
        "extensions": {"KHR_lights_punctual": {"light": 0}},
    },
    {"name": "sun", "rotation": turn((1, 0, 0), -60), "extensions": {"KHR_lights_punctual": {"light": 1}}},
    {"name": "camera", "camera": 0, "translation": [0, 1.9, 6.2], "rotation": turn((1, 0, 0), -11)},
]
document = {
    "asset": {"version": "2.0", "generator": "still-life.py"},
    "extensionsUsed": [
        "KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_transmission", "KHR_materials_volume",
    ],
    "extensions": {
        "KHR_lights_punctual": {
            "lights": [
                {"name": "spot", "type": "spot", "color": [0.6, 0.75, 1], "intensity": 60,
                 "spot": {"innerConeAngle": 0.15, "outerConeAngle": 0.4}},
                {"name": "sun", "type": "directional", "color": [1, 0.95, 0.85], "intensity": 0.8},
            ]
        }
    },
    "scene": 0,
    "scenes": [{"nodes": list(range(len(nodes)))}],
    "nodes": nodes,
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 1.6, "znear": 0.01}}],
    "meshes": meshes,
    "materials": materials,
    "textures": [{"source": 0, "sampler": 0}],
    "samplers": [{"wrapS": 33071, "wrapT": 33071}],
    "images": [{"uri": "leaf.png"}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"uri": "still-life.bin", "byteLength": len(buffer)}],
}


def lines(value, depth=0):
    """JSON with one element of a list to a line, down to the elements of lists of the document."""
    pad = "  " * (depth + 1)
    if depth < 2 and isinstance(value, dict) and value:
        items = [f"{pad}{json.dumps(name)}: {lines(item, depth + 1)}" for name, item in value.items()]
        return "{\n" + ",\n".join(items) + "\n" + pad[2:] + "}"
    if depth == 1 and isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(pad + json.dumps(item) for item in value) + "\n" + pad[2:] + "]"
    return json.dumps(value)


with open("still-life.gltf", "w") as file:
    file.write(lines(document) + "\n")
with open("still-life.bin", "wb") as file:
    file.write(buffer)
with open("leaf.png", "wb") as file:
    file.write(png(LEAF, LEAF, leaf))
