"""Pictures as arrays of rows, columns and channels: files of them, and how far two are apart."""
import struct
import zlib

import numpy as np


def write_pfm(path, picture):
    height, width, _ = picture.shape
    with open(path, "wb") as file:
        file.write(f"PF\n{width} {height}\n-1.0\n".encode())
        picture[::-1].astype("<f4").tofile(file)


def read_pfm(path):
    with open(path, "rb") as file:
        kind, size, scale = (file.readline().split() for _ in range(3))
        width, height = map(int, size)
        channels = {b"PF": 3, b"Pf": 1}[kind[0]]
        order = "<" if float(scale[0]) < 0 else ">"
        return np.fromfile(file, order + "f4").reshape(height, width, channels)[::-1].astype(np.float64)


def write_png(path, picture):
    """Eight bits per channel, from numbers in [0, 1]."""
    height, width, _ = picture.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)  # every row begins with its filter, none
    rows[:, 1:] = (255 * picture.clip(0, 1) + 0.5).astype(np.uint8).reshape(height, -1)
    chunks = [
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(rows.tobytes(), 9)),
        (b"IEND", b""),
    ]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, data in chunks:
            file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))


class Reference:
    """A picture to compare with, the mean of two of equally many samples, from whose difference its own error is known."""

    def __init__(self, first, second):
        self.picture = (first + second) / 2
        self.error = float(np.mean((first - second) ** 2 / 4 / self._scale()))

    def _scale(self):
        return self.picture**2 + 0.01

    def relative_mse(self, picture):
        """mean((x − r)² / (r² + 0.01)), over pixels and channels, less that of the reference itself."""
        if not np.isfinite(picture).all():
            raise SystemExit("a picture has pixels that are not finite")
        squares = (picture - self.picture) ** 2 / self._scale()
        return max(float(np.mean(squares)) - self.error, 1e-9)
