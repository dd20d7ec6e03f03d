"""A sky by formula, and maps that are given, in the folder of a scene."""

import shutil

import numpy as np

WIDTH, HEIGHT = 1024, 512
TO_SUN = np.array([0.5, 0.6, 0.6]) / np.linalg.norm([0.5, 0.6, 0.6])


def radiance():
    """Blue above, brown below, a sun of 3 degrees: rows from the top, the middle toward -Z, +X to the right of it."""
    v, u = np.meshgrid((np.arange(HEIGHT) + 0.5) / HEIGHT, (np.arange(WIDTH) + 0.5) / WIDTH, indexing="ij")
    theta, phi = np.pi * v, 2 * np.pi * (u - 0.5)
    direction = np.stack([np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)], -1)
    up = direction[..., 1:2]
    zenith, horizon, ground = np.array([0.15, 0.3, 0.7]), np.array([0.7, 0.75, 0.8]), np.array([0.15, 0.1, 0.07])
    heaven = horizon + (zenith - horizon) * np.clip(up, 0, 1) ** 0.5
    sun = np.exp(3000 * (direction @ TO_SUN - 1))[..., None] * np.array([1500.0, 1350.0, 1100.0])
    return np.where(up > 0, heaven + sun, ground).astype(np.float32)


def write(folder):
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {"RGB": radiance()}).write(str(folder / "sky.exr"))
    return "sky.exr"


def copy(path, folder):
    shutil.copyfile(path, folder / path.name)
    return path.name
