"""Mitsuba 3: a dictionary, with a PLY file for each mesh."""

import math
import time
from pathlib import Path

import scene as scenes


def prepare(scene, folder):
    for number, mesh in enumerate(scene.meshes):
        scenes.write_ply(folder / f"mitsuba-{number}.ply", mesh)


class Session:
    """`sampler`: independent or multijitter."""

    def __init__(self, folder, settings, sampler="independent"):
        import drjit
        import mitsuba

        self.mi, self.folder, self.settings = mitsuba, Path(folder), settings
        mitsuba.set_variant(settings["mitsuba_variant"])
        if "llvm" in settings["mitsuba_variant"]:
            drjit.set_thread_count(settings["threads"])
        scene = scenes.load(folder)
        self.materials = scene.materials
        self.scene = mitsuba.load_dict(self.description(scene, sampler))

    def render(self, samples, seed):
        start = time.monotonic()
        image = self.mi.render(self.scene, spp=samples, seed=seed).numpy()
        return time.monotonic() - start, image[..., :3], samples

    def description(self, scene, sampler):
        to_world = self.mi.ScalarTransform4f
        camera, size = scene.camera, self.settings["size"]
        words = {
            "type": "scene",
            "integrator": {"type": "volpath" if scene.has_media else "path", "max_depth": scene.depth},
            "sensor": {
                "type": "perspective", "fov": camera.vertical_fov, "fov_axis": "y",
                "to_world": to_world().look_at(camera.position, camera.look_at, [0, 1, 0]),
                "film": {"type": "hdrfilm", "width": size, "height": size, "pixel_format": "rgb", "rfilter": {"type": "box"}},
                "sampler": {"type": sampler},
            },
        }
        for number, mesh in enumerate(scene.meshes):
            words[f"mesh{number}"] = self.shape(number, scene.materials[mesh.material], mesh.normals is None)
        if scene.environment:
            words["sky"] = {"type": "envmap", "filename": str(self.folder / scene.environment),
                            "to_world": to_world().rotate([0, 1, 0], 180)}
        if scene.sun:
            words["sun"] = {"type": "directional", "direction": [-part for part in scene.sun.to_light],
                            "irradiance": rgb(scene.sun.irradiance)}
        return words

    def shape(self, number, material, is_flat):
        words = {"type": "ply", "filename": str(self.folder / f"mitsuba-{number}.ply"), "face_normals": is_flat}
        words["bsdf"] = self.bsdf(material)
        if material.kind == "fog":
            rate = material.scattering + material.absorption
            words["interior"] = {"type": "homogeneous", "sigma_t": rate, "albedo": material.scattering / rate,
                                 "phase": {"type": "hg", "g": material.anisotropy}}
        if material.emits:
            words["emitter"] = {"type": "area", "radiance": self.emission(material)}
        return words

    def bsdf(self, material):
        alpha = {"distribution": "ggx", "alpha": material.roughness**2} if material.roughness > 0 else {}
        rough = "rough" if alpha else ""
        if material.kind == "fog":
            return {"type": "null"}
        if material.kind == "dielectric":
            return {"type": rough + "dielectric", "int_ior": material.ior, "ext_ior": 1.0, **alpha}
        if material.kind == "gltf":
            return self.principled(material)
        color = self.texture(material.color_texture, material.color)
        inner = {
            "diffuse": {"type": "diffuse", "reflectance": color},
            "conductor": {"type": rough + "conductor", "material": "none", "specular_reflectance": color, **alpha},
            "plastic": {"type": rough + "plastic", "diffuse_reflectance": color, "int_ior": material.ior, "ext_ior": 1.0, **alpha},
        }[material.kind]
        return {"type": "twosided", "bsdf": inner}

    def principled(self, material):
        words = {"type": "principled", "specular": 0.5, "base_color": self.texture(material.color_texture, material.color)}
        for number, name in (1, "roughness"), (2, "metallic"):
            words[name] = self.channel(material.metallic_roughness_texture, number, getattr(material, name))
        if not material.normal_texture:
            return words
        picture = {"type": "bitmap", "raw": True, "filename": str(self.folder / material.normal_texture)}
        return {"type": "normalmap", "normalmap": picture, "bsdf": words}

    def linear(self, file, srgb):
        bitmap = self.mi.Bitmap(str(self.folder / file))
        bitmap.set_srgb_gamma(srgb)
        return bitmap.convert(self.mi.Bitmap.PixelFormat.RGB, self.mi.Struct.Type.Float32, False)

    def picture(self, pixels):
        return {"type": "bitmap", "raw": True, "bitmap": self.mi.Bitmap(pixels)}

    def texture(self, file, factor):
        if not file:
            return rgb(factor)
        return self.picture(self.mi.TensorXf(self.linear(file, True)).numpy() * [list(factor)])

    def channel(self, file, number, factor):
        if not file:
            return factor
        pixels = self.mi.TensorXf(self.linear(file, False)).numpy()
        return self.picture((pixels[..., number : number + 1] * factor).copy())

    def emission(self, material):
        return self.texture(material.emission_texture, material.emission)


def rgb(color):
    return {"type": "rgb", "value": [part if math.isfinite(part) else 0 for part in color]}
