"""LuxCore: properties, with a PLY file for each mesh."""

import os
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import scene as scenes
from cycles_scene import z_up


def prepare(scene, folder):
    for number, mesh in enumerate(scene.meshes):
        turned = replace(mesh, positions=z_up(mesh.positions), normals=None if mesh.normals is None else z_up(mesh.normals))
        scenes.write_ply(folder / f"luxcore-{number}.ply", turned)


class Session:
    def __init__(self, folder, settings):
        os.environ["OCL_ICD_VENDORS"] = "/nonexistent"  # it aborts where it looks for devices on PoCL
        import pyluxcore

        self.lux, self.folder, self.settings = pyluxcore, Path(folder), settings
        pyluxcore.Init(lambda text: None)
        self.depth = scenes.load(folder).depth
        self.scene = pyluxcore.Scene()
        self.scene.Parse(self.properties(description(scenes.load(folder), self.folder)))

    def properties(self, words):
        made = self.lux.Properties()
        for name, value in words.items():
            made.Set(self.lux.Property(name, list(value) if isinstance(value, (tuple, list, np.ndarray)) else value))
        return made

    def options(self, samples, seed):
        size, depth = self.settings["size"], self.depth - 1
        return {
            "renderengine.type": "PATHCPU", "renderengine.seed": seed + 1, "native.threads.count": self.settings["threads"],
            "sampler.type": "SOBOL", "sampler.sobol.adaptive.strength": 0.0,
            "film.width": size, "film.height": size, "film.filter.type": "NONE", "film.noiseestimation.warmup": 0,
            "path.pathdepth.total": depth, "path.pathdepth.diffuse": depth, "path.pathdepth.glossy": depth,
            "path.pathdepth.specular": depth, "path.clamping.variance.maxvalue": 0.0, "path.hybridbackforward.enable": False,
            "lightstrategy.type": "LOG_POWER", "batch.haltspp": samples,
        }

    def render(self, samples, seed):
        size = self.settings["size"]
        config = self.lux.RenderConfig(self.properties(self.options(samples, seed)), self.scene)
        session = self.lux.RenderSession(config)
        session.Start()
        start = time.monotonic()
        while not session.HasDone():
            time.sleep(0.005)
            session.UpdateStats()
        seconds = time.monotonic() - start
        counted = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat() / size**2
        pixels = np.zeros(size * size * 3, np.float32)
        session.GetFilm().GetOutputFloat(self.lux.FilmOutputType.RGB, pixels)
        session.Stop()
        return seconds, pixels.reshape(size, size, 3)[::-1], counted


def description(scene, folder):
    camera = scene.camera
    words = {
        "scene.camera.type": "perspective", "scene.camera.lookat.orig": z_up(camera.position).tolist(),
        "scene.camera.lookat.target": z_up(camera.look_at).tolist(), "scene.camera.up": [0, 0, 1],
        "scene.camera.fieldofview": camera.vertical_fov, "scene.camera.autofocus.enable": False,
    }
    for name, material in scene.materials.items():
        words |= material_of(name.replace(" ", "_"), material, folder)
    for number, mesh in enumerate(scene.meshes):
        words[f"scene.shapes.s{number}.type"] = "mesh"
        words[f"scene.shapes.s{number}.ply"] = str(folder / f"luxcore-{number}.ply")
        words[f"scene.objects.o{number}.shape"] = f"s{number}"
        words[f"scene.objects.o{number}.material"] = mesh.material.replace(" ", "_")
    if scene.environment:
        words |= under("scene.lights.sky", {"type": "infinite", "file": str(folder / scene.environment), "gamma": 1.0,
                                            "transformation": TURN})
    if scene.sun:
        strength = max(scene.sun.irradiance)
        words |= under("scene.lights.sun", {"type": "sharpdistant", "direction": (-z_up(scene.sun.to_light)).tolist(),
                                            "color": [part / strength for part in scene.sun.irradiance], "gain": [strength] * 3})
    return words


# From how LuxCore lays maps around us, mirrored, to how ours lie.
TURN = [0, -1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


def under(prefix, words):
    return {f"{prefix}.{name}": value for name, value in words.items()}


def material_of(name, material, folder):
    words, made = {}, {}

    def texture(kind, file, **more):
        words.update(under(f"scene.textures.{name}_{kind}", {"type": "imagemap", "file": str(folder / file), **more}))
        return f"{name}_{kind}"

    alpha = material.roughness**2
    color = texture("color", material.color_texture, gamma=2.2) if material.color_texture else list(material.color)
    if material.kind == "diffuse":
        made = {"type": "matte", "kd": color}
    elif material.kind == "conductor" and alpha == 0:
        made = {"type": "mirror", "kr": color}
    elif material.kind == "conductor":
        words |= under(f"scene.textures.{name}_fresnel", {"type": "fresnelcolor", "kr": color})
        made = {"type": "metal2", "fresnel": f"{name}_fresnel", "uroughness": alpha, "vroughness": alpha}
    elif material.kind == "dielectric":
        made = {"type": "glass" if alpha == 0 else "roughglass", "kr": [1, 1, 1], "kt": [1, 1, 1],
                "interiorior": material.ior, "exteriorior": 1.0, "uroughness": alpha, "vroughness": alpha}
    elif material.kind == "plastic":
        made = {"type": "glossy2", "kd": color, "ks": [((material.ior - 1) / (material.ior + 1)) ** 2] * 3,
                "uroughness": alpha, "vroughness": alpha, "multibounce": False}
    elif material.kind == "gltf":
        rough, metal = material.roughness, material.metallic
        if file := material.metallic_roughness_texture:
            rough = texture("roughness", file, gamma=1.0, channel="green")
            metal = texture("metallic", file, gamma=1.0, channel="blue")
        made = {"type": "disney", "basecolor": color, "roughness": rough, "metallic": metal, "specular": 0.5}
        if file := material.normal_texture:
            picture = texture("normals", file, gamma=1.0)
            words |= under(f"scene.textures.{name}_bump", {"type": "normalmap", "texture": picture})
            made["bumptex"] = f"{name}_bump"
    elif material.kind == "fog":
        made = {"type": "null", "volume.interior": f"{name}_inside"}
        words |= under(f"scene.volumes.{name}_inside", {
            "type": "homogeneous", "absorption": [material.absorption] * 3, "scattering": [material.scattering] * 3,
            "asymmetry": [material.anisotropy] * 3, "multiscattering": True})
    if material.emits:
        made["emission"] = list(material.emission)
        if material.emission_texture:
            made["emission"] = texture("emission", material.emission_texture, gamma=2.2)
            made["emission.gain"] = list(material.emission)
    return words | under(f"scene.materials.{name}", made)
