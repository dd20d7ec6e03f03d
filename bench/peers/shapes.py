"""Meshes by formula, for the built-in scenes."""

import numpy as np
from scene import Mesh


def quad(material, corner, edge1, edge2):
    """Its front is where edge1 x edge2 points."""
    corner, edge1, edge2 = (np.array(vector, float) for vector in (corner, edge1, edge2))
    corners = np.array([corner, corner + edge1, corner + edge1 + edge2, corner + edge2])
    uvs = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], float)
    return Mesh(material, corners, np.array([[0, 1, 2], [0, 2, 3]]), None, uvs)


def join(material, meshes):
    """One mesh of several that have neither normals nor texture coordinates, or lose them."""
    firsts = np.cumsum([0] + [len(mesh.positions) for mesh in meshes])
    triangles = [mesh.triangles + first for mesh, first in zip(meshes, firsts)]
    return Mesh(material, np.concatenate([mesh.positions for mesh in meshes]), np.concatenate(triangles))


def box(material, low, high):
    low, high = np.array(low, float), np.array(high, float)
    x, y, z = np.diag(high - low)
    faces = [(low, y, x), (low, z, y), (low, x, z), (high, -x, -y), (high, -y, -z), (high, -z, -x)]
    return join(material, [quad(material, *face) for face in faces])


def sphere(material, center, radius, rings=96):
    theta, phi = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij")
    normals = np.stack([np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)], -1).reshape(-1, 3)
    uvs = np.stack([phi / (2 * np.pi), theta / np.pi], -1).reshape(-1, 2)
    triangles = grid_triangles(rings, 2 * rings)
    corners = normals[triangles]
    has_area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) > 1e-12
    return Mesh(material, np.array(center) + radius * normals, triangles[has_area], normals, uvs)


def grid_triangles(rows, columns):
    """Of (rows + 1) x (columns + 1) vertices, row by row."""
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1)
    across, along = columns + 1, 1
    return np.concatenate([np.stack([first, first + across, first + across + along], -1),
                           np.stack([first, first + across + along, first + along], -1)])


def terrain(material, size, side, heights):
    """A square of `size` around the origin with 2 `side`^2 triangles; `heights (x, z)`."""
    steps = np.linspace(-size / 2, size / 2, side + 1)
    z, x = np.meshgrid(steps, steps, indexing="ij")
    positions = np.stack([x, heights(x, z), z], -1).reshape(-1, 3)
    return Mesh(material, positions, grid_triangles(side, side))
