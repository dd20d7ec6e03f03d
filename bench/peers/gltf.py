"""A glTF file as a scene: triangles, texture coordinates, and of materials what all renderers have."""

import base64
import io
import json
import math
import struct
from pathlib import Path

import numpy as np
import sky
from scene import Camera, Material, Mesh, Scene

TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
PARTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class File:
    def __init__(self, path):
        self.path, blob, self.chunk = path, path.read_bytes(), None
        if blob[:4] == b"glTF":
            length = struct.unpack_from("<I", blob, 12)[0]
            self.chunk = blob[28 + length :]
            blob = blob[20 : 20 + length]
        self.words = json.loads(blob)

    def bytes_of(self, thing):
        uri = thing.get("uri")
        if uri is None:
            return self.chunk
        return base64.b64decode(uri.split(",", 1)[1]) if uri.startswith("data:") else (self.path.parent / uri).read_bytes()

    def view(self, number):
        view = self.words["bufferViews"][number]
        start = view.get("byteOffset", 0)
        return self.bytes_of(self.words["buffers"][view["buffer"]])[start : start + view["byteLength"]], view.get("byteStride")

    def array(self, number):
        accessor = self.words["accessors"][number]
        kind, parts = np.dtype(TYPES[accessor["componentType"]]), PARTS[accessor["type"]]
        data, stride = self.view(accessor["bufferView"])
        strides = (stride or kind.itemsize * parts, kind.itemsize)
        array = np.ndarray((accessor["count"], parts), kind, data, accessor.get("byteOffset", 0), strides)
        return array / np.iinfo(kind).max if accessor.get("normalized") else array

    def image(self, texture):
        from PIL import Image

        image = self.words["images"][self.words["textures"][texture["index"]]["source"]]
        data = self.view(image["bufferView"])[0] if "bufferView" in image else self.bytes_of(image)
        return Image.open(io.BytesIO(data)).convert("RGB")


def matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"]).reshape(4, 4).T
    x, y, z, w = node.get("rotation", [0, 0, 0, 1])
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    result = np.eye(4)
    result[:3, :3] = turn * node.get("scale", [1, 1, 1])
    result[:3, 3] = node.get("translation", [0, 0, 0])
    return result


def material_of(file, words, number, folder):
    base = words.get("pbrMetallicRoughness", {})
    strength = words.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
    material = Material("gltf", tuple(base.get("baseColorFactor", [1, 1, 1])[:3]), base.get("roughnessFactor", 1.0),
                        base.get("metallicFactor", 1.0),
                        emission=tuple(strength * part for part in words.get("emissiveFactor", [0, 0, 0])))
    sources = {"color_texture": base.get("baseColorTexture"), "normal_texture": words.get("normalTexture"),
               "metallic_roughness_texture": base.get("metallicRoughnessTexture"), "emission_texture": words.get("emissiveTexture")}
    for name, source in sources.items():
        if source:
            setattr(material, name, f"{number}-{name}.png")
            file.image(source).save(folder / f"{number}-{name}.png", compress_level=1)
    return material


def add_node(file, number, above, scene):
    node = file.words["nodes"][number]
    place = above @ matrix(node)
    for part in file.words["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
        if part.get("mode", 4) != 4:
            continue
        read = {name: file.array(index).astype(float) for name, index in part["attributes"].items()}
        positions = read["POSITION"] @ place[:3, :3].T + place[:3, 3]
        triangles = file.array(part["indices"]).reshape(-1, 3) if "indices" in part else np.arange(len(positions)).reshape(-1, 3)
        normals = None
        if "NORMAL" in read:
            normals = read["NORMAL"] @ np.linalg.inv(place[:3, :3])
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-20)
        scene.meshes.append(Mesh(f"m{part.get('material', -1)}", positions, triangles.astype(int), normals, read.get("TEXCOORD_0")))
    for child in node.get("children", []):
        add_node(file, child, place, scene)


def around(meshes):
    """A camera that sees all of them, from the front, somewhat above."""
    positions = np.concatenate([mesh.positions for mesh in meshes])
    low, high = positions.min(0), positions.max(0)
    center, radius = (low + high) / 2, np.linalg.norm(high - low) / 2
    way = np.array([0.35, 0.2, 1.0]) / np.linalg.norm([0.35, 0.2, 1.0])
    distance = 0.62 * radius / math.sin(math.radians(20))
    return Camera(tuple(center + distance * way), tuple(center), 40)


def read(path, folder):
    """The file's scene under the sky."""
    file = File(Path(path))
    scene = Scene(Path(path).stem, None, environment=sky.write(folder))
    roots = file.words["scenes"][file.words.get("scene", 0)]["nodes"]
    for root in roots:
        add_node(file, root, np.eye(4), scene)
    materials = file.words.get("materials", [])
    for name in {mesh.material for mesh in scene.meshes}:
        number = int(name[1:])
        scene.materials[name] = material_of(file, materials[number] if number >= 0 else {}, number, folder)
    scene.camera = around(scene.meshes)
    return scene
