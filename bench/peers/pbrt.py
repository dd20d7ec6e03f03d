"""As much of pbrt's files as the dining room of the assets needs, in its way of writing them."""

import re
from pathlib import Path

import numpy as np
import sky
from scene import Camera, Material, Mesh, Scene, Sun

DIRECTIVES = {"Transform", "Texture", "MakeNamedMaterial", "NamedMaterial", "Shape", "TransformBegin", "TransformEnd",
              "LightSource", "Camera", "AttributeBegin", "AttributeEnd", "Rotate", "ConcatTransform", "WorldBegin",
              "Integrator", "Sampler", "PixelFilter", "Film"}


def directives(path):
    """(name, words before the parameters, parameters by name) one by one."""
    text = re.sub(r"#.*", "", path.read_text())
    words = re.findall(r'"[^"]*"|\[|\]|[^\s\[\]"]+', text)
    starts = [at for at, word in enumerate(words) if word in DIRECTIVES] + [len(words)]
    for at, end in zip(starts, starts[1:]):
        plain, parameters, name = [], {}, None
        for word in words[at + 1 : end]:
            quoted = word.strip('"')
            if word.startswith('"') and " " in quoted:
                name = quoted.split()[1]
                parameters[name] = []
            elif word not in "[]":
                (plain if name is None else parameters[name]).append(quoted)
        yield words[at], plain, parameters


def numbers(words):
    return np.array([float(word) for word in words])


def ply_mesh(path, material):
    """Of binary little-endian files whose faces are triangles or quadrilaterals."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    lines = header.decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    names = [line.split()[2] for line in lines if line.startswith("property float")]
    vertices = np.frombuffer(data, "<f4", counts["vertex"] * len(names)).reshape(-1, len(names)).astype(float)
    at, triangles = vertices.size * 4, []
    for _ in range(counts["face"]):
        corners = np.frombuffer(data, "<i4", data[at], at + 1)
        triangles += [(corners[0], corners[k], corners[k + 1]) for k in range(1, len(corners) - 1)]
        at += 1 + 4 * len(corners)
    column = {name: vertices[:, k] for k, name in enumerate(names)}
    stack = lambda *wanted: np.stack([column[name] for name in wanted], -1) if wanted[0] in column else None
    uvs = stack("u", "v")
    return Mesh(material, stack("x", "y", "z"), np.array(triangles), stack("nx", "ny", "nz"),
                None if uvs is None else uvs * [1, -1] + [0, 1])


def placed(mesh, place):
    mesh.positions = mesh.positions @ place[:3, :3].T + place[:3, 3]
    if mesh.normals is not None:
        mesh.normals = mesh.normals @ np.linalg.inv(place[:3, :3])
    return mesh


def reflectance(eta, k):
    """Of metal, head on."""
    return ((eta - 1) ** 2 + k**2) / ((eta + 1) ** 2 + k**2)


def as_png(picture, folder, name):
    from PIL import Image

    Image.open(picture).convert("RGB").save(folder / name)
    return name


def material_of(parameters, textures):
    kind = parameters["type"][0]
    roughness = float(parameters.get("uroughness", ["0"])[0]) ** 0.5  # which is GGX's alpha there
    if kind == "conductor":
        color = reflectance(numbers(parameters["eta"]), numbers(parameters["k"]))
        return Material("conductor", tuple(color), roughness)
    texture = ""
    color = parameters["reflectance"]
    if color[0] in textures:
        texture, color = textures[color[0]], ["1"] * 3
    return Material("plastic" if kind == "coateddiffuse" else "diffuse", tuple(numbers(color)), roughness, color_texture=texture)


def read(path, folder):
    """The scene, under its own sun and a sky of ours."""
    path = Path(path)
    scene = Scene(path.parent.name, None, environment=sky.write(folder))
    textures, places, material, fov = {}, [np.eye(4)], "", 40.0
    for name, plain, parameters in directives(path):
        if name == "Camera":
            fov = float(parameters["fov"][0])
            to_world = np.linalg.inv(places[-1])  # pbrt's cameras look along +Z
            position, ahead = to_world[:3, 3], to_world[:3, 2]
            scene.camera = Camera(tuple(position), tuple(position + ahead), fov)
            places = [np.eye(4)]
        elif name == "Transform":
            places[-1] = numbers(plain).reshape(4, 4).T
        elif name == "TransformBegin":
            places.append(places[-1])
        elif name == "TransformEnd":
            places.pop()
        elif name == "Texture":
            textures[plain[0]] = as_png(path.parent / parameters["filename"][0], folder, f"{plain[0]}.png")
        elif name == "MakeNamedMaterial":
            scene.materials[plain[0]] = material_of(parameters, textures)
        elif name == "NamedMaterial":
            material = plain[0]
        elif name == "Shape" and plain[0] == "plymesh":
            scene.meshes.append(placed(ply_mesh(path.parent / parameters["filename"][0], material), places[-1]))
        elif name == "Shape":
            lists = [numbers(parameters[key]).reshape(-1, width) for key, width in (("P", 3), ("indices", 3), ("N", 3), ("uv", 2))]
            lists[1] = lists[1].astype(int)
            scene.meshes.append(placed(Mesh(material, *lists), places[-1]))
        elif name == "LightSource" and plain[0] == "distant":
            way = numbers(parameters["from"]) - numbers(parameters["to"])
            scene.sun = Sun(tuple(way / np.linalg.norm(way)), tuple(numbers(parameters["L"])))
    return scene
