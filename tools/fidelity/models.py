"""Which models there are, how each is seen, and with what beside it: the cameras of a public
collection of reference pictures (config.json beside them says where from) where it has the model.
"""

import json
import math
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Model:
    name: str
    path: Path
    size: tuple[int, int]  # of the picture
    camera: dict | None  # position, look_at, vertical_fov; None: the one that Onde chooses
    references: dict[str, Path] = field(default_factory=dict)  # by renderer
    variant_of: str = ""  # the model whose picture it must have


WIDTH = 512  # of the reference pictures


def camera_on_orbit(scenario):
    target = [scenario["target"][axis] for axis in "xyz"]
    theta, phi = (math.radians(scenario["orbit"][angle]) for angle in ("theta", "phi"))
    way = (math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta))
    radius = scenario["orbit"]["radius"]
    position = [at + radius * part for at, part in zip(target, way)]
    ahead = [at - part for at, part in zip(position, way)]  # the radius may be 0
    return {"position": position, "look_at": ahead, "vertical_fov": scenario["verticalFoV"]}


def with_references(assets):
    """Those of the collection whose pictures show nothing but the model."""
    config = assets / "goldens" / "config.json"
    scenarios = json.loads(config.read_text())["scenarios"] if config.exists() else []
    for scenario in scenarios:
        path = assets / scenario["model"]
        size = scenario["dimensions"]
        folder = assets / "goldens" / scenario["name"]
        references = {name.split("-golden")[0]: folder / name for name in scenario["goldens"]}
        yield Model(
            scenario["name"].removeprefix("khronos-"),
            path,
            (WIDTH, round(WIDTH * size["height"] / size["width"])),
            camera_on_orbit(scenario),
            {} if scenario["renderSkybox"] else references,
        )


def models(assets):
    """Every glTF file under the assets. Variants come after the model that they are of."""
    known = {model.path: model for model in with_references(assets)}
    by_name = {model.name: model for model in known.values()}
    plain, variants = [], []
    for path in sorted((assets / "gltf").rglob("*")):
        if path.suffix not in (".gltf", ".glb"):
            continue
        of = by_name.get(path.stem.removesuffix("_meshopt"))
        if of and of.path != path:
            name = f"{of.name} ({path.parent.name.removeprefix('glTF-')})"
            variants.append(Model(name, path, of.size, of.camera, of.references, of.name))
        else:
            name = path.parent.name if path.stem == "scene" else path.stem
            plain.append(known.get(path) or Model(name, path, (WIDTH, WIDTH), None))
    return plain + variants
