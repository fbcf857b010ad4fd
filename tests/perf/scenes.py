#!/usr/bin/env python3
"""Writes the reference scenes: Mitsuba 3's XML with the meshes and images it names.

usage: scenes.py FOLDER [--triangles N] [--lights N]

FOLDER/NAME/scene.xml for every NAME of `SCENES`. --triangles is the size of the mesh of `surface`, --lights the number of emitting
triangles of `lights`. All are seen through a box filter; `$size`, `$spp` and `$depth` are parameters of the files.
"""
import argparse
import os

import numpy as np

import meshes
import pictures

WHITE = '<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.7, 0.7"/></bsdf></bsdf>'


def document(eye, target, field_of_view, body):
    eye, target = (", ".join(f"{x:.6g}" for x in place) for place in (eye, target))
    return f"""<scene version="3.0.0">
  <default name="size" value="256"/>
  <default name="spp" value="16"/>
  <default name="depth" value="-1"/>
  <integrator type="path">
    <integer name="max_depth" value="$depth"/>
  </integrator>
  <sensor type="perspective">
    <float name="fov" value="{field_of_view}"/>
    <transform name="to_world"><lookat origin="{eye}" target="{target}" up="0, 0, 1"/></transform>
    <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="$size"/>
      <integer name="height" value="$size"/>
      <string name="pixel_format" value="rgb"/>
      <rfilter type="box"/>
    </film>
  </sensor>
{body}
</scene>
"""


def diffuse(reflectance):
    return f'<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{reflectance}"/></bsdf></bsdf>'


def glow(radiance):
    return f'<emitter type="area"><rgb name="radiance" value="{radiance}"/></emitter>'


def bitmap(name, filename):
    return f'<texture type="bitmap" name="{name}"><string name="filename" value="{filename}"/></texture>'


def rectangle(centre, towards, half, inside, up="0, 1, 0"):
    """Centred, facing `towards`, with these half lengths across and along `up`."""
    centre, towards = np.array(centre, float), np.array(towards, float)
    places = [", ".join(f"{x:.6g}" for x in place) for place in (centre, centre + towards)]
    return (
        f'  <shape type="rectangle"><transform name="to_world"><scale x="{half[0]}" y="{half[1]}"/>'
        f'<lookat origin="{places[0]}" target="{places[1]}" up="{up}"/></transform>{inside}</shape>'
    )


def slab(low, high, inside, turned=0):
    """A cuboid between two corners, turned about the vertical through its middle."""
    low, high = np.array(low, float), np.array(high, float)
    (x, y, z), (a, b, c) = (low + high) / 2, (high - low) / 2
    return (
        f'  <shape type="cube"><transform name="to_world"><scale x="{a:.6g}" y="{b:.6g}" z="{c:.6g}"/><rotate z="1" angle="{turned}"/>'
        f'<translate x="{x:.6g}" y="{y:.6g}" z="{z:.6g}"/></transform>{inside}</shape>'
    )


def sphere(centre, radius, inside):
    centre = ", ".join(f"{x:.6g}" for x in centre)
    return f'  <shape type="sphere"><point name="center" value="{centre}"/><float name="radius" value="{radius}"/>{inside}</shape>'


def mesh(filename, inside, scale=1, centre=(0, 0, 0), facets=False):
    x, y, z = centre
    return (
        f'  <shape type="ply"><string name="filename" value="{filename}"/><boolean name="face_normals" value="{str(facets).lower()}"/>'
        f'<transform name="to_world"><scale value="{scale}"/><translate x="{x}" y="{y}" z="{z}"/></transform>{inside}</shape>'
    )


def box(folder, options):
    """Two blocks in a matte box under a rectangular lamp."""
    return document((0, -3.9, 1), (0, 0, 1), 38, "\n".join([
        rectangle((0, 0, 0), (0, 0, 1), (1, 1), WHITE),
        rectangle((0, 0, 2), (0, 0, -1), (1, 1), WHITE),
        rectangle((0, 1, 1), (0, -1, 0), (1, 1), WHITE, up="0, 0, 1"),
        rectangle((-1, 0, 1), (1, 0, 0), (1, 1), diffuse("0.6, 0.06, 0.05"), up="0, 0, 1"),
        rectangle((1, 0, 1), (-1, 0, 0), (1, 1), diffuse("0.12, 0.45, 0.1"), up="0, 0, 1"),
        slab((-0.65, 0, 0), (-0.05, 0.6, 1.2), WHITE, turned=20),
        slab((0.1, -0.65, 0), (0.7, -0.05, 0.6), WHITE, turned=-17),
        rectangle((0, 0, 1.995), (0, 0, -1), (0.25, 0.2), glow("17, 12, 5")),
    ]))


def plates(folder, options):
    """Veach's experiment: four plates from nearly mirrors to rough, each reflecting four spherical lamps from small to large."""
    eye, lamps = np.array([0, -12, 2.5]), np.array([0, 3, 6])
    parts = [
        rectangle((0, 0, -3), (0, 0, 1), (12, 12), diffuse("0.3, 0.3, 0.3")),
        rectangle((0, 5, 0), (0, -1, 0), (12, 12), diffuse("0.3, 0.3, 0.3"), up="0, 0, 1"),
    ]
    for alpha, centre in zip([0.005, 0.02, 0.06, 0.15], [(0, 2.2, 2.2), (0, 1, 0.6), (0, -0.7, -0.7), (0, -2.8, -1.7)]):
        centre = np.array(centre, float)
        halfway = sum((place - centre) / np.linalg.norm(place - centre) for place in (eye, lamps))
        metal = (
            f'<bsdf type="twosided"><bsdf type="roughconductor"><string name="material" value="Al"/>'
            f'<string name="distribution" value="ggx"/><float name="alpha" value="{alpha}"/></bsdf></bsdf>'
        )
        parts.append(rectangle(centre, halfway, (4, 0.7), metal, up="0, 0, 1"))
    for x, radius, power in zip([-3.6, -1.2, 1.2, 3.6], [0.05, 0.17, 0.45, 0.9], ["3, 1, 1", "3, 2.5, 1", "1, 3, 1.5", "1, 1.6, 3"]):
        radiance = ", ".join(f"{float(c) / radius**2:.6g}" for c in power.split(", "))
        parts.append(sphere((x, lamps[1], lamps[2]), radius, glow(radiance)))
    return document(tuple(eye), (0, 0, 1.6), 40, "\n".join(parts))


def glass(folder, options):
    """A smooth ball and a rough knot of glass on a checkerboard, under a lamp and a grey sky."""
    meshes.write_ply(os.path.join(folder, "knot.ply"), meshes.torus_knot(48, 480))
    board = (
        '<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><rgb name="color0" value="0.7, 0.65, 0.6"/>'
        '<rgb name="color1" value="0.1, 0.12, 0.2"/><transform name="to_uv"><scale x="16" y="16"/></transform></texture></bsdf>'
    )
    rough = '<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.1"/></bsdf>'
    return document((0, -6, 3), (0, 0, 0.6), 42, "\n".join([
        rectangle((0, 0, 0), (0, 0, 1), (8, 8), board),
        sphere((-1.2, 0, 0.9), 0.9, '<bsdf type="dielectric"/>'),
        mesh("knot.ply", rough, scale=0.7, centre=(1.2, 0, 0.5)),
        rectangle((0, 1, 5), (0, -0.2, -1), (0.8, 0.8), glow("20, 18, 15")),
        '  <emitter type="constant"><rgb name="radiance" value="0.2, 0.25, 0.3"/></emitter>',
    ]))


def surface(folder, options):
    """A hilly surface of many triangles in sun and sky."""
    meshes.write_ply(os.path.join(folder, "surface.ply"), meshes.displaced_square(options.triangles))
    up = np.cos(np.pi * (np.arange(64) + 0.5) / 64)[:, None]
    sky = np.where(up > 0, 0.25 + 0.75 * (1 - np.abs(up)) ** 3, 0.1)[..., None] * np.array([0.5, 0.7, 1.0])
    pictures.write_pfm(os.path.join(folder, "sky.pfm"), np.broadcast_to(sky, (64, 128, 3)))
    return document((0.2, -2.1, 1.5), (0, -0.1, 0), 45, "\n".join([
        mesh("surface.ply", diffuse("0.5, 0.42, 0.3")),
        '  <emitter type="directional"><vector name="direction" value="0.6, 0.5, -0.6"/><rgb name="irradiance" value="3, 2.7, 2.2"/></emitter>',
        '  <emitter type="envmap"><string name="filename" value="sky.pfm"/>'
        '<transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>',
    ]))


def lights(folder, options):
    """Many small lamps, all triangles of one mesh, between blocks."""
    lamps = meshes.scattered_triangles(options.lights, (-2, -2, 0.2), (2, 2, 1.4), 0.1)
    meshes.write_ply(os.path.join(folder, "lamps.ply"), lamps)
    random = np.random.default_rng(2)
    blocks = [
        slab((x - 0.25, y - 0.25, 0), (x + 0.25, y + 0.25, height), WHITE, turned=round(turn))
        for x, y, height, turn in zip(
            np.repeat(np.linspace(-1.6, 1.6, 5), 5), np.tile(np.linspace(-1.6, 1.6, 5), 5),
            random.uniform(0.1, 1.0, 25), random.uniform(-40, 40, 25),
        )
    ]
    return document((0, -4.5, 3), (0, 0, 0.3), 45, "\n".join([
        rectangle((0, 0, 0), (0, 0, 1), (3, 3), WHITE),
        *blocks,
        mesh("lamps.ply", glow("150, 120, 80"), facets=True),
    ]))


def door(folder, options):
    """A room lit through a door that stands ajar: all light is indirect."""
    wood = diffuse("0.4, 0.25, 0.12")
    shiny = (
        '<bsdf type="roughconductor"><string name="material" value="Cu"/><string name="distribution" value="ggx"/>'
        '<float name="alpha" value="0.15"/></bsdf>'
    )
    return document((3.8, 0.3, 1.6), (0.4, 2.6, 1), 75, "\n".join([
        slab((-4, 0, -0.1), (4, 4, 0), WHITE),
        slab((-4, 0, 2.8), (4, 4, 2.9), WHITE),
        slab((-4, -0.1, 0), (4, 0, 2.8), WHITE),
        slab((-4, 4, 0), (4, 4.1, 2.8), diffuse("0.3, 0.4, 0.6")),
        slab((-4.1, 0, 0), (-4, 4, 2.8), WHITE),
        slab((4, 0, 0), (4.1, 4, 2.8), WHITE),
        slab((-0.1, 0, 0), (0, 1.6, 2.8), WHITE),
        slab((-0.1, 2.5, 0), (0, 4, 2.8), WHITE),
        slab((-0.1, 1.6, 2), (0, 2.5, 2.8), WHITE),
        slab((0.05, 2, 0), (0.1, 2.9, 2), wood, turned=-35),
        sphere((1.3, 2.9, 0.4), 0.4, shiny),
        slab((1.6, 1.2, 0), (2.2, 1.8, 0.6), diffuse("0.6, 0.2, 0.15"), turned=25),
        rectangle((-2, 1, 2.79), (0, 0, -1), (0.6, 0.6), glow("60, 54, 45")),
    ]))


def interior(folder, options):
    """A furnished room with images on floor, walls and furniture, lit by a window and two lamps."""
    x, y = np.meshgrid(np.arange(512) / 512, np.arange(512) / 512)
    grain = 0.5 + 0.5 * np.sin(90 * x + 3 * np.sin(12 * y) + 9 * np.floor(8 * y))
    joint = (np.mod(8 * y, 1) > 0.04)[..., None]
    boards = (0.25 + 0.2 * grain[..., None]) * np.array([1.4, 1.0, 0.6]) * joint
    paper = 0.6 + 0.25 * (np.sin(40 * np.pi * x) * np.sin(40 * np.pi * y) > 0.2)[..., None] * np.array([0.6, 0.8, 1.0])
    pictures.write_png(os.path.join(folder, "boards.png"), boards)
    pictures.write_png(os.path.join(folder, "paper.png"), paper)
    meshes.write_ply(os.path.join(folder, "knot.ply"), meshes.torus_knot(32, 320))
    matte, varnish = '<ref id="matte"/>', '<ref id="varnish"/>'
    materials = [
        f'  <bsdf type="twosided" id="matte"><bsdf type="diffuse">{bitmap("reflectance", "paper.png")}</bsdf></bsdf>',
        f'  <bsdf type="twosided" id="varnish"><bsdf type="roughplastic">{bitmap("diffuse_reflectance", "boards.png")}'
        '<string name="distribution" value="ggx"/><float name="alpha" value="0.1"/></bsdf></bsdf>',
    ]
    gilded = (
        '<bsdf type="principled"><rgb name="base_color" value="0.9, 0.6, 0.2"/><float name="metallic" value="0.8"/>'
        '<float name="roughness" value="0.3"/></bsdf>'
    )
    legs = [slab((a, b, 0), (a + 0.1, b + 0.1, 0.7), varnish) for a in (-0.8, 0.7) for b in (0.6, 1.5)]
    return document((-1.7, -1.8, 1.5), (0.2, 1, 0.8), 65, "\n".join([
        *materials,
        rectangle((0, 0, 0), (0, 0, 1), (2, 2), varnish),
        rectangle((0, 0, 2.6), (0, 0, -1), (2, 2), WHITE),
        rectangle((0, 2, 1.3), (0, -1, 0), (2, 1.3), matte, up="0, 0, 1"),
        rectangle((0, -2, 1.3), (0, 1, 0), (2, 1.3), matte, up="0, 0, 1"),
        rectangle((-2, 0, 1.3), (1, 0, 0), (2, 1.3), matte, up="0, 0, 1"),
        rectangle((2, 0, 1.3), (-1, 0, 0), (2, 1.3), matte, up="0, 0, 1"),
        slab((-0.9, 0.5, 0.7), (0.9, 1.7, 0.78), varnish),
        *legs,
        mesh("knot.ply", gilded, scale=0.22, centre=(0.3, 1, 0.92)),
        sphere((-0.4, 1.1, 1.0), 0.22, '<bsdf type="dielectric"/>'),
        rectangle((1.99, 0.4, 1.5), (-1, 0, 0), (0.6, 0.5), glow("9, 10, 12"), up="0, 0, 1"),
        sphere((-0.8, 0, 2.3), 0.1, glow("20, 15, 9")),
        sphere((0.8, 0, 2.3), 0.1, glow("20, 15, 9")),
    ]))


SCENES = {scene.__name__: scene for scene in [box, plates, glass, surface, lights, door, interior]}


def add_options(parser, triangles=300_000, lights=1024):
    parser.add_argument("--triangles", type=int, default=triangles)
    parser.add_argument("--lights", type=int, default=lights)


def write(folder, name, options):
    """The path of the scene, written into a folder of its own."""
    folder = os.path.join(folder, name)
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, "scene.xml")
    text = SCENES[name](folder, options)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder")
    add_options(parser)
    options = parser.parse_args()
    for name in SCENES:
        print(write(options.folder, name, options))


if __name__ == "__main__":
    main()
