#!/usr/bin/env python3
"""Writes a cloud as a grid of densities, in Mitsuba's .vol format with a byte a cell.

usage: write_cloud.py FILE [cells along x]

The cloud is a heap of soft balls whose edges are eaten away by sums of value noise; nothing in it is
random but by its seed.
"""

import math
import random
import struct
import sys

BOX = ((-1.5, -0.6, -1.0), (1.5, 0.9, 1.0))
BALLS = 44


def lattice(seed, size=16):
    source = random.Random(seed)
    return [source.random() for _ in range(size**3)]


def noise(values, x, y, z, size=16):
    """Value noise, smooth between the points of a lattice that repeats."""
    cell = [math.floor(c) for c in (x, y, z)]
    part = [c - k for c, k in zip((x, y, z), cell)]
    part = [t * t * (3 - 2 * t) for t in part]
    sum_ = 0.0
    for corner in range(8):
        index, weight = 0, 1.0
        for axis in (2, 1, 0):
            step = corner >> axis & 1
            index = index * size + (cell[axis] + step) % size
            weight *= part[axis] if step else 1 - part[axis]
        sum_ += weight * values[index]
    return sum_


def turbulence(values, x, y, z):
    return sum(noise(values, x * 2**k, y * 2**k, z * 2**k) / 2**k for k in range(4)) / 1.875


def heap(seed):
    """Balls on a flat ground, larger in the middle."""
    source = random.Random(seed)
    balls = []
    for _ in range(BALLS):
        x, z = source.uniform(-1.1, 1.1), source.uniform(-0.6, 0.6)
        middle = math.exp(-1.4 * (x * x + 2 * z * z))
        radius = source.uniform(0.14, 0.26) + 0.16 * middle
        balls.append((x, source.uniform(-0.35, -0.2) + 0.75 * middle * source.random(), z, radius))
    return balls


def density(balls, values, x, y, z):
    far = min(math.dist((x, y, z), ball[:3]) / ball[3] for ball in balls)
    if far > 1.5:
        return 0.0
    eaten = 1.5 - far - 1.15 * turbulence(values, 4.3 * x + 7, 4.3 * y + 7, 4.3 * z + 7)
    ground = min(1.0, max(0.0, (y + 0.45) / 0.1))
    return min(1.0, max(0.0, 5.0 * eaten)) * ground


def main():
    path = sys.argv[1]
    along_x = int(sys.argv[2]) if len(sys.argv) > 2 else 64
    size = [high - low for low, high in zip(*BOX)]
    cells = [max(1, round(along_x * s / size[0])) for s in size]
    balls, values = heap(4), lattice(11)
    data = bytearray()
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                at = [low + (n + 0.5) / c * s for low, n, c, s in zip(BOX[0], (i, j, k), cells, size)]
                data.append(round(255 * density(balls, values, *at)))
    with open(path, "wb") as file:
        file.write(b"VOL\x03" + struct.pack("<5i6f", 3, *cells, 1, *BOX[0], *BOX[1]) + data)


if __name__ == "__main__":
    main()
