"""Triangle meshes: arrays of positions and triangles, and the PLY files that hold them."""
import numpy as np


def displaced_square(triangles):
    """A hilly square of about so many triangles over [-1, 1]², z up: waves of six lengths, the shortest a sixtieth of it."""
    side = max(int((triangles / 2) ** 0.5 + 0.5), 1)
    line = np.linspace(-1, 1, side + 1)
    x, y = (a.ravel() for a in np.meshgrid(line, line))
    height = np.zeros_like(x)
    for octave in range(6):
        frequency = 3.0 * 2**octave
        turn = 1.3 * octave
        along = np.cos(turn) * x + np.sin(turn) * y
        across = np.cos(turn) * y - np.sin(turn) * x
        height += 0.12 * 0.55**octave * np.sin(frequency * along + octave) * np.cos(1.7 * frequency * across)
    return np.stack([x, y, height], 1), rows_of_quads(side, side, side + 1)


def torus_knot(around, along):
    """A closed tube of 2 · around · along triangles that winds three times round an axis and twice round a ring."""
    t = 2 * np.pi * np.arange(along) / along

    def centre(t):
        r = 1 + 0.4 * np.cos(3 * t)
        return np.stack([r * np.cos(2 * t), r * np.sin(2 * t), 0.4 * np.sin(3 * t)], 1)

    tangent = centre(t + 1e-4) - centre(t - 1e-4)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    side = np.cross(tangent, [0, 0, 1])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    up = np.cross(side, tangent)
    angle = (2 * np.pi * np.arange(around) / around)[None, :, None]
    positions = centre(t)[:, None] + 0.22 * (np.cos(angle) * side[:, None] + np.sin(angle) * up[:, None])
    i, j = (a.ravel() for a in np.meshgrid(np.arange(along), np.arange(around), indexing="ij"))
    next_i, next_j = (i + 1) % along, (j + 1) % around
    a, b, c, d = i * around + j, i * around + next_j, next_i * around + next_j, next_i * around + j
    return positions.reshape(-1, 3), np.concatenate([np.stack([a, c, b], 1), np.stack([a, d, c], 1)])


def scattered_triangles(count, low, high, area):
    """So many triangles turned at random in a box, of sizes 1 to 9 and the given area together."""
    random = np.random.default_rng(1)
    centres = random.uniform(low, high, (count, 1, 3))
    corners = random.normal(size=(count, 3, 3))
    corners -= corners.mean(axis=1, keepdims=True)
    edges = corners[:, 1:] - corners[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1) / 2
    wanted = random.uniform(1, 9, count)
    wanted *= area / wanted.sum()
    corners *= np.sqrt(wanted / areas)[:, None, None]
    return (centres + corners).reshape(-1, 3), np.arange(3 * count).reshape(-1, 3)


def rows_of_quads(rows, columns, stride):
    """The triangles of a grid of vertices, stored by rows of `stride`."""
    index = (np.arange(rows)[:, None] * stride + np.arange(columns)).ravel()
    a, b, c, d = index, index + 1, index + stride + 1, index + stride
    return np.stack([a, b, c, a, c, d], 1).reshape(-1, 3)


def write_ply(path, mesh):
    positions, triangles = mesh
    faces = np.zeros(len(triangles), dtype=[("length", "u1"), ("vertices", "<i4", 3)])
    faces["length"], faces["vertices"] = 3, triangles
    with open(path, "wb") as file:
        file.write(
            (
                f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions)}\n"
                "property float x\nproperty float y\nproperty float z\n"
                f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
            ).encode()
        )
        positions.astype("<f4").tofile(file)
        faces.tofile(file)
