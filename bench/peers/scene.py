"""What all renderers are given: triangles, materials that they agree on, a camera, an environment, and
a folder that holds it. Right-handed, Y up; texture coordinates from the picture's upper left corner.
"""

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np


@dataclass
class Material:
    """`kind`: diffuse; conductor (`color` from all sides); dielectric (clear, of index `ior`); plastic
    (diffuse under a dielectric coat); gltf (metallic-roughness); fog (no surface, `medium` inside).
    Microfacets are GGX's, whose alpha is the square of `roughness`."""

    kind: str
    color: tuple = (0.8, 0.8, 0.8)
    roughness: float = 0.0
    metallic: float = 0.0
    ior: float = 1.5
    emission: tuple = (0.0, 0.0, 0.0)  # radiance of the front
    color_texture: str = ""  # files in the scene's folder; as glTF has them
    metallic_roughness_texture: str = ""
    normal_texture: str = ""
    emission_texture: str = ""
    scattering: float = 0.0  # of the medium, by unit of length
    absorption: float = 0.0
    anisotropy: float = 0.0  # mean cosine of Henyey and Greenstein's phase function

    @property
    def emits(self):
        return max(self.emission) > 0


@dataclass
class Mesh:
    material: str
    positions: np.ndarray  # (n, 3)
    triangles: np.ndarray  # (m, 3)
    normals: np.ndarray | None = None  # (n, 3)
    uvs: np.ndarray | None = None  # (n, 2)


@dataclass
class Camera:
    position: tuple
    look_at: tuple
    vertical_fov: float = 40.0  # degrees; pictures are square


@dataclass
class Sun:
    to_light: tuple
    irradiance: tuple


@dataclass
class Scene:
    name: str
    camera: Camera
    materials: dict = field(default_factory=dict)
    meshes: list = field(default_factory=list)
    environment: str = ""  # an equirectangular .exr or .hdr in the folder, its middle toward -Z
    sun: Sun | None = None
    depth: int = 8  # edges of a path

    @property
    def has_media(self):
        return any(material.kind == "fog" for material in self.materials.values())

    def save(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        words = asdict(self) | {"meshes": [mesh.material for mesh in self.meshes]}
        (folder / "scene.json").write_text(json.dumps(words, indent=1))
        for number, mesh in enumerate(self.meshes):
            arrays = {name: value for name, value in vars(mesh).items() if isinstance(value, np.ndarray)}
            np.savez(folder / f"mesh-{number}.npz", **arrays)


def load(folder):
    folder = Path(folder)
    words = json.loads((folder / "scene.json").read_text())
    words["camera"] = Camera(**words["camera"])
    words["sun"] = words["sun"] and Sun(**words["sun"])
    words["materials"] = {name: Material(**values) for name, values in words["materials"].items()}
    words["meshes"] = [Mesh(material, **np.load(folder / f"mesh-{number}.npz"))
                       for number, material in enumerate(words["meshes"])]
    return Scene(**words)


def write_ply(path, mesh, v_up=False):
    """Binary; `v_up`: texture coordinates from the lower left corner."""
    columns, names = [mesh.positions], ["x", "y", "z"]
    if mesh.normals is not None:
        columns, names = columns + [mesh.normals], names + ["nx", "ny", "nz"]
    if mesh.uvs is not None:
        uvs = mesh.uvs * [1, -1] + [0, 1] if v_up else mesh.uvs
        columns, names = columns + [uvs], names + ["s", "t"]
    vertices = np.concatenate(columns, axis=1).astype("<f4")
    faces = np.empty(len(mesh.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, mesh.triangles
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    Path(path).write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())
