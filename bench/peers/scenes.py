"""The built-in scenes, and where others come from."""

from pathlib import Path

import gltf
import numpy as np
import pbrt
import sky
from scene import Camera, Material, Scene
from shapes import box, join, quad, sphere, terrain

ASSETS = Path(__file__).resolve().parents[3] / "shared/assets"
WHITE, RED, GREEN = (0.73, 0.73, 0.73), (0.6, 0.06, 0.05), (0.12, 0.42, 0.1)


def room(scene, size, height, depth):
    """Five walls around a floor, open toward the camera."""
    x, z = size / 2, depth / 2
    scene.materials |= {"white": Material("diffuse", WHITE), "red": Material("diffuse", RED),
                        "green": Material("diffuse", GREEN)}
    scene.meshes += [
        quad("white", (-x, 0, z), (2 * x, 0, 0), (0, 0, -2 * z)),
        quad("white", (-x, height, -z), (2 * x, 0, 0), (0, 0, 2 * z)),
        quad("white", (-x, 0, -z), (2 * x, 0, 0), (0, height, 0)),
        quad("red", (-x, 0, z), (0, 0, -2 * z), (0, height, 0)),
        quad("green", (x, 0, -z), (0, 0, 2 * z), (0, height, 0)),
    ]


def cornell(folder):
    """A box with a mirror, a glass ball and a small bright light: caustics."""
    scene = Scene("cornell", Camera((0, 1, 3.9), (0, 1, 0), 38))
    room(scene, 2, 2, 2)
    scene.materials |= {"mirror": Material("conductor", (1, 1, 1)), "glass": Material("dielectric", (1, 1, 1)),
                        "light": Material("diffuse", (0, 0, 0), emission=(17, 13, 8))}
    scene.meshes += [sphere("mirror", (-0.45, 0.4, -0.35), 0.4), sphere("glass", (0.45, 0.35, 0.3), 0.35),
                     quad("light", (-0.25, 1.999, -0.25), (0.5, 0, 0), (0, 0, 0.5))]
    return scene


def materials(folder):
    """One ball of each material under the sky."""
    scene = Scene("materials", Camera((0, 2.2, 6.5), (0, 0.4, 0), 32), environment=sky.write(folder))
    scene.materials |= {"ground": Material("diffuse", (0.4, 0.4, 0.4)), "diffuse": Material("diffuse", RED),
                        "metal": Material("conductor", (0.9, 0.9, 0.9), 0.4), "glass": Material("dielectric", (1, 1, 1)),
                        "frosted": Material("dielectric", (1, 1, 1), 0.3), "plastic": Material("plastic", GREEN, 0.3)}
    scene.meshes.append(quad("ground", (-20, -0.5, 20), (40, 0, 0), (0, 0, -40)))
    for number, name in enumerate(["diffuse", "metal", "glass", "frosted", "plastic"]):
        scene.meshes.append(sphere(name, (1.15 * (number - 2), 0, 0), 0.5))
    return scene


def helmet(folder):
    """A model with textures of colour, metal, roughness, normals and light."""
    return gltf.read(ASSETS / "gltf/DamagedHelmet/glTF-Binary/DamagedHelmet.glb", folder)


def dining_room(folder):
    """A hundred meshes of plastic, metal and stone, lit by a sun and a sky through windows."""
    return pbrt.read(ASSETS / "pbrt/dining-room/scene-v4.pbrt", folder)


def million(folder):
    """Hills of a million triangles, and rough balls of metal on them."""
    scene = Scene("million", Camera((0, 5, 11), (0, 0, 0), 38), environment=sky.write(folder))
    scene.materials |= {"hills": Material("diffuse", (0.45, 0.4, 0.3)), "metal": Material("conductor", (0.85, 0.85, 0.85), 0.4)}

    def heights(x, z):
        waves = [np.sin(2**octave * x + 1.7 * octave) * np.sin(2**octave * z + octave) / 1.9**octave for octave in range(8)]
        return 0.5 * sum(waves)

    scene.meshes.append(terrain("hills", 12, 708, heights))
    scene.meshes += [sphere("metal", (2.4 * column - 2.4, 1.3, 1.5 * row - 1.5), 0.5) for row in range(3) for column in range(3)]
    return scene


def lamps(folder):
    """A hall with a thousand small lamps of eight colours."""
    scene = Scene("lamps", Camera((0, 2.5, 19), (0, 1.8, 0), 50))
    room(scene, 20, 5, 40)
    random = np.random.default_rng(1)
    pillars = [box("white", (x - 0.3, 0, z - 0.3), (x + 0.3, 5, z + 0.3)) for x in (-5, 5) for z in (-14, -7, 0, 7)]
    scene.meshes.append(join("white", pillars))
    lights = [[] for _ in range(8)]
    for number in range(1000):
        x, y, z = random.uniform((-9.5, 0.5, -19), (9.5, 4.8, 12))
        lights[number % 8].append(quad("", (x, y, z), (0.06, 0, 0), (0, 0, 0.06)))  # faces down
    for number, lamps_of_a_color in enumerate(lights):
        name = f"lamp {number}"
        color = 30 * (0.2 + random.random(3)) * 2.0 ** (number % 4 - 1)
        scene.materials[name] = Material("diffuse", (0, 0, 0), emission=tuple(float(part) for part in color))
        scene.meshes.append(join(name, lamps_of_a_color))
    return scene


def fog(folder):
    """A room in fog that scatters forward, with a lamp in it and a box that throws a shadow."""
    scene = Scene("fog", Camera((0, 1, 3.9), (0, 1, 0), 38))
    room(scene, 2, 2, 2)
    scene.materials |= {"fog": Material("fog", scattering=0.8, absorption=0.1, anisotropy=0.5),
                        "light": Material("diffuse", (0, 0, 0), emission=(20, 18, 15))}
    scene.meshes += [box("white", (-0.5, 0.4, -0.3), (0.1, 1.0, 0.3)), box("fog", (-1.1, -0.1, -1.1), (1.1, 2.1, 1.1)),
                     quad("light", (-0.2, 1.9, -0.2), (0.4, 0, 0), (0, 0, 0.4))]
    return scene


BUILT_IN = {"cornell": cornell, "dining-room": dining_room, "helmet": helmet, "million": million, "lamps": lamps, "fog": fog,
            "materials": materials}
USUAL = ["cornell", "dining-room", "helmet", "million", "lamps", "fog"]


def unknown(names):
    """Those that are neither built-in scenes nor files to read."""
    return [name for name in names if name not in BUILT_IN and not (Path(name).suffix in (".glb", ".gltf") and Path(name).exists())]


def make(name, folder, environment):
    """The scene of that name or glTF file, its files in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    scene = BUILT_IN[name](folder) if name in BUILT_IN else gltf.read(Path(name), folder)
    if environment and scene.environment:
        scene.environment = sky.copy(environment, folder)
    scene.save(folder)
    return scene
