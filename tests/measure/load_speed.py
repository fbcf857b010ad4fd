#!/usr/bin/env python3
"""Times the loading of meshes of about 100 MB beside Mitsuba 3's, and asks the system for the memory it takes.

usage: load_speed.py [--program target/release/examples/load_mesh] [--megabytes 100] [--rounds 7] [--document docs/loading.md]

    cargo build --release -p etendue-scene --example load_mesh
    python tests/measure/load_speed.py --document docs/loading.md

Needs Mitsuba 3 and numpy; Linux. Both sides load each file in a fresh process per round, in turn, the file being in the system's
cache. Timed is the loading alone: for Mitsuba `mi.load_dict({'type': …, 'filename': …})` of a shape, variant scalar_rgb; here what
crates/scene/examples/load_mesh.rs says. Neither builds a hierarchy, both make smooth normals where the file has none. Memory is
what a process has at most while it loads and what it has afterwards, less what it has before. The table is printed, and with
--document written between its lines `<!-- begin load speed -->` and `<!-- end load speed -->`.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile

import numpy as np

# What a line, a vertex and a triangle take in bytes decides how fine a grid is.
GRIDS = {
    "PLY, little endian": ("ply", "<", True, 58),
    "PLY, big endian": ("ply", ">", True, 58),
    "PLY without normals and uvs": ("ply", "<", False, 38),
    "OBJ": ("obj", "", True, 232),
    "OBJ without normals and uvs": ("obj", "", False, 82),
}

MITSUBA = """
import sys, time
import mitsuba as mi
mi.set_variant("scalar_rgb")
print("ready", flush=True)
sys.stdin.readline()
start = time.perf_counter()
mesh = mi.load_dict({"type": sys.argv[1].rsplit(".", 1)[1], "filename": sys.argv[1]})
print(time.perf_counter() - start, mesh.face_count(), flush=True)
sys.stdin.readline()
"""


def grid(side):
    """Positions, normals, texture coordinates and triangles of a wavy square of side × side vertices."""
    line = np.linspace(0, 1, side, dtype=np.float32)
    u, v = (x.ravel() for x in np.meshgrid(line, line))
    height = 0.1 * np.sin(9 * u) * np.cos(7 * v)
    slopes = [-0.9 * np.cos(9 * u) * np.cos(7 * v), 0.7 * np.sin(9 * u) * np.sin(7 * v)]
    normals = np.stack([*slopes, np.ones_like(u)], 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    index = np.arange(side * side, dtype=np.int32).reshape(side, side)
    a, b, c, d = (x.ravel() for x in (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]))
    triangles = np.stack([a, b, c, a, c, d], 1).reshape(-1, 3)
    return np.stack([u, v, height], 1), normals, np.stack([u, v], 1), triangles


def write_ply(file, order, attributes, triangles):
    names = ["x", "y", "z", "nx", "ny", "nz", "u", "v"]
    vertices = np.concatenate(attributes, 1).astype(order + "f4")
    faces = np.zeros(len(triangles), dtype=[("length", "u1"), ("vertices", order + "i4", 3)])
    faces["length"], faces["vertices"] = 3, triangles
    properties = "".join(f"property float {name}\n" for name in names[: vertices.shape[1]])
    file.write(
        (
            f"ply\nformat binary_{'big' if order == '>' else 'little'}_endian 1.0\nelement vertex {len(vertices)}\n"
            f"{properties}element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        ).encode()
    )
    vertices.tofile(file)
    faces.tofile(file)


def write_obj(file, attributes, triangles):
    for name, values in zip(["v", "vn", "vt"], attributes):
        line = name + " %.9g" * values.shape[1] + "\n"
        file.write("".join(line % tuple(value) for value in values.tolist()).encode())
    corner = "%d/%d/%d" if len(attributes) > 1 else "%d"
    line = f"f {corner} {corner} {corner}\n"
    repeated = np.repeat(triangles + 1, 3 if len(attributes) > 1 else 1, axis=1)
    file.write("".join(line % tuple(triangle) for triangle in repeated.tolist()).encode())


def write_mesh(folder, number, megabytes):
    kind, order, full, per_vertex = list(GRIDS.values())[number]
    positions, normals, uvs, triangles = grid(int((megabytes * 1e6 / per_vertex) ** 0.5))
    attributes = [positions, normals, uvs] if full else [positions]
    path = os.path.join(folder, f"{number}.{kind}")
    with open(path, "wb") as file:
        write_ply(file, order, attributes, triangles) if kind == "ply" else write_obj(file, attributes, triangles)
    return path


def memory(process):
    """Most and present resident bytes of a process."""
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        fields = dict(line.split(":", 1) for line in file)
    return [int(fields[name].split()[0]) * 1024 for name in ("VmHWM", "VmRSS")]


def work(process):
    """Seconds that processors have spent for a process."""
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def load(command):
    """Seconds, those of processors, bytes per triangle at most and afterwards, of one loading in a process of its own."""
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    with open(f"/proc/{process.pid}/clear_refs", "w", encoding="ascii") as file:
        file.write("5")  # forget what was used most until now
    _, before = memory(process)
    worked = work(process)
    process.stdin.write("\n")
    process.stdin.flush()
    seconds, triangles = process.stdout.readline().split()
    most, after = memory(process)
    worked = work(process) - worked
    process.communicate("\n")
    return float(seconds), worked, (most - before) / int(triangles), (after - before) / int(triangles), int(triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", default="target/release/examples/load_mesh")
    parser.add_argument("--megabytes", type=float, default=100)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--document")
    options = parser.parse_args()

    lines = [
        "| file | MB | million triangles | here, s | Mitsuba, s | ratio | here, processor s | Mitsuba, processor s "
        "| bytes per triangle, most | afterwards | Mitsuba, most | afterwards |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |",
    ]
    with tempfile.TemporaryDirectory() as folder:
        for number, name in enumerate(GRIDS):
            path = write_mesh(folder, number, options.megabytes)
            commands = [[options.program, path], [sys.executable, "-c", MITSUBA, path]]
            rounds = [[load(command) for command in commands] for _ in range(options.rounds)]
            ratio = statistics.median(here[0] / there[0] for here, there in rounds)
            (here, here_work, here_most, here_after, triangles), (there, there_work, there_most, there_after, _) = (
                [statistics.median(column) for column in zip(*side)] for side in zip(*rounds)
            )
            lines.append(
                f"| {name} | {os.path.getsize(path) / 1e6:.0f} | {triangles / 1e6:.2f} | {here:.3f} | {there:.3f} "
                f"| {ratio:.2f} | {here_work:.2f} | {there_work:.2f} | {here_most:.0f} | {here_after:.0f} | {there_most:.0f} | {there_after:.0f} |"
            )
            os.remove(path)
    print("\n".join(lines))
    if options.document:
        with open(options.document, encoding="utf-8") as file:
            text = file.read()
        begin, end = "<!-- begin load speed -->\n", "<!-- end load speed -->\n"
        before, rest = text.split(begin)
        text = f"{before}{begin}\n" + "\n".join(lines) + f"\n\n{end}" + rest.split(end)[1]
        with open(options.document, "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    main()
