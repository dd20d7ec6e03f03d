"""Cycles: Blender's Python module."""

import math
import time
from pathlib import Path

import numpy as np
import scene as scenes


def prepare(scene, folder):
    pass  # it takes the arrays


def z_up(vectors):
    vectors = np.asarray(vectors, float)
    return np.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], -1)


class Session:
    def __init__(self, folder, settings):
        import bpy
        import mathutils

        self.bpy, self.matrix, self.folder, self.settings = bpy, mathutils, Path(folder), settings
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = scenes.load(folder)
        self.materials = {name: self.material(name, material) for name, material in scene.materials.items()}
        for number, mesh in enumerate(scene.meshes):
            self.add_mesh(f"mesh {number}", mesh)
        self.set_camera(scene.camera)
        self.set_world(scene)
        self.set_options(scene)

    def render(self, samples, seed):
        view = self.bpy.context.scene
        view.cycles.samples, view.cycles.seed = samples, seed
        output = self.folder / "cycles.exr"
        view.render.filepath = str(output)
        start = time.monotonic()
        self.bpy.ops.render.render(write_still=True)
        seconds = time.monotonic() - start
        image = self.bpy.data.images.load(str(output))
        pixels = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(pixels)
        self.bpy.data.images.remove(image)
        size = self.settings["size"]
        return seconds, pixels.reshape(size, size, -1)[::-1, :, :3], samples

    def set_options(self, scene):
        view = self.bpy.context.scene
        view.render.engine = "CYCLES"
        view.render.resolution_x = view.render.resolution_y = self.settings["size"]
        view.render.resolution_percentage = 100
        view.render.use_persistent_data = True
        view.render.threads_mode, view.render.threads = "FIXED", self.settings["threads"]
        view.render.image_settings.file_format, view.render.image_settings.color_depth = "OPEN_EXR", "32"
        bounces = scene.depth - 2  # Cycles counts neither the first surface nor the last edge
        most = {f"{kind}_bounces": bounces for kind in ("max", "diffuse", "glossy", "transmission", "volume")}
        options = {**most, "transparent_max_bounces": 256, "device": "CPU", "use_adaptive_sampling": False,
                   "use_denoising": False, "pixel_filter_type": "BOX", "sample_clamp_direct": 0, "sample_clamp_indirect": 0,
                   "blur_glossy": 0, "caustics_reflective": True, "caustics_refractive": True, "light_sampling_threshold": 0}
        for name, value in options.items():
            setattr(view.cycles, name, value)

    def set_camera(self, camera):
        data = self.bpy.data.cameras.new("camera")
        data.sensor_fit, data.angle = "VERTICAL", math.radians(camera.vertical_fov)
        data.clip_start, data.clip_end = 1e-3, 1e5
        position, target = self.matrix.Vector(z_up(camera.position)), self.matrix.Vector(z_up(camera.look_at))
        thing = self.bpy.data.objects.new("camera", data)
        thing.location = position
        thing.rotation_euler = (target - position).to_track_quat("-Z", "Y").to_euler()
        self.add(thing)
        self.bpy.context.scene.camera = thing

    def add(self, thing):
        self.bpy.context.scene.collection.objects.link(thing)

    def add_mesh(self, name, mesh):
        data = self.bpy.data.meshes.new(name)
        corners = np.ascontiguousarray(mesh.triangles.reshape(-1), np.int32)
        data.vertices.add(len(mesh.positions))
        data.vertices.foreach_set("co", np.ascontiguousarray(z_up(mesh.positions), np.float32).reshape(-1))
        data.loops.add(len(corners))
        data.loops.foreach_set("vertex_index", corners)
        data.polygons.add(len(mesh.triangles))
        data.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
        data.update(calc_edges=True)
        if mesh.uvs is not None:
            uvs = (mesh.uvs * [1, -1] + [0, 1])[corners]
            data.uv_layers.new().uv.foreach_set("vector", np.ascontiguousarray(uvs, np.float32).reshape(-1))
        data.polygons.foreach_set("use_smooth", np.full(len(mesh.triangles), mesh.normals is not None))
        if mesh.normals is not None:
            data.normals_split_custom_set_from_vertices(z_up(mesh.normals).tolist())
        data.materials.append(self.materials[mesh.material])
        self.add(self.bpy.data.objects.new(name, data))

    def set_world(self, scene):
        world = self.bpy.data.worlds.new("world")
        self.bpy.context.scene.world = world
        world.use_nodes = True
        nodes = Nodes(world.node_tree)
        background, output = nodes.add("Background", Color=(0, 0, 0, 1)), nodes.add("OutputWorld")
        nodes.link(background.outputs[0], output.inputs["Surface"])
        if scene.environment:
            picture = nodes.add("TexEnvironment")
            picture.image = self.bpy.data.images.load(str(self.folder / scene.environment))
            turn = nodes.add("Mapping", Rotation=(0, 0, math.radians(-90)))
            nodes.link(nodes.add("TexCoord").outputs["Generated"], turn.inputs["Vector"])
            nodes.link(turn.outputs[0], picture.inputs[0])
            nodes.link(picture.outputs[0], background.inputs["Color"])
        if scene.sun:
            light = self.bpy.data.lights.new("sun", "SUN")
            light.angle, light.energy = 0, max(scene.sun.irradiance)
            light.color = [part / light.energy for part in scene.sun.irradiance]
            thing = self.bpy.data.objects.new("sun", light)
            thing.rotation_euler = self.matrix.Vector(z_up(scene.sun.to_light)).to_track_quat("Z", "Y").to_euler()
            self.add(thing)

    def material(self, name, material):
        made = self.bpy.data.materials.new(name)
        made.use_nodes = True
        nodes = Nodes(made.node_tree)
        output = nodes.add("OutputMaterial")
        if material.kind == "fog":
            nodes.link(self.volume(nodes, material), output.inputs["Volume"])
            return made
        surface = self.surface(nodes, material)
        if material.emits:
            surface = self.emitting(nodes, material, surface)
        nodes.link(surface, output.inputs["Surface"])
        return made

    def volume(self, nodes, material):
        scatter = nodes.add("VolumeScatter", Color=(1, 1, 1, 1), Density=material.scattering, Anisotropy=material.anisotropy)
        absorb = nodes.add("VolumeAbsorption", Color=(0, 0, 0, 1), Density=material.absorption)
        return nodes.sum(scatter.outputs[0], absorb.outputs[0])

    def emitting(self, nodes, material, surface):
        """With light of the front, added to what the surface scatters."""
        light = nodes.add("Emission", Color=(*material.emission, 1))
        if material.emission_texture:
            nodes.link(self.picture(nodes, material.emission_texture, "sRGB").outputs[0], light.inputs["Color"])
            light.inputs["Strength"].default_value = max(material.emission)
        front = nodes.add("MixShader")
        nodes.link(nodes.add("NewGeometry").outputs["Backfacing"], front.inputs[0])
        nodes.link(light.outputs[0], front.inputs[1])
        return nodes.sum(surface, front.outputs[0])

    def surface(self, nodes, material):
        if material.kind in ("plastic", "gltf"):
            return self.principled(nodes, material)
        kind = {"diffuse": "BsdfDiffuse", "conductor": "BsdfAnisotropic", "dielectric": "BsdfGlass"}[material.kind]
        node = nodes.add(kind, Color=(*material.color, 1), Roughness=material.roughness)
        if material.kind == "dielectric":
            node.inputs["IOR"].default_value = material.ior
        if material.kind != "diffuse":
            node.distribution = "MULTI_GGX"
        else:
            node.inputs["Roughness"].default_value = 0
        if material.color_texture:
            nodes.link(self.picture(nodes, material.color_texture, "sRGB").outputs[0], node.inputs["Color"])
        return node.outputs[0]

    def principled(self, nodes, material):
        inputs = {"Base Color": (*material.color, 1), "Roughness": material.roughness, "Metallic": material.metallic, "IOR": material.ior}
        node = nodes.add("BsdfPrincipled", **inputs)
        if material.color_texture:
            nodes.link(self.picture(nodes, material.color_texture, "sRGB").outputs[0], node.inputs["Base Color"])
        if material.metallic_roughness_texture:
            parts = nodes.add("SeparateColor")
            nodes.link(self.picture(nodes, material.metallic_roughness_texture, "Non-Color").outputs[0], parts.inputs[0])
            nodes.link(parts.outputs["Green"], node.inputs["Roughness"])
            nodes.link(parts.outputs["Blue"], node.inputs["Metallic"])
        if material.normal_texture:
            bent = nodes.add("NormalMap")
            nodes.link(self.picture(nodes, material.normal_texture, "Non-Color").outputs[0], bent.inputs["Color"])
            nodes.link(bent.outputs[0], node.inputs["Normal"])
        return node.outputs[0]

    def picture(self, nodes, file, space):
        node = nodes.add("TexImage")
        node.image = self.bpy.data.images.load(str(self.folder / file), check_existing=True)
        node.image.colorspace_settings.name = space
        return node


class Nodes:
    """A tree of shader nodes that is empty at first."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def add(self, kind, **inputs):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            node.inputs[name].default_value = value
        return node

    def link(self, output, input):
        self.tree.links.new(output, input)

    def sum(self, a, b):
        node = self.add("AddShader")
        self.link(a, node.inputs[0])
        self.link(b, node.inputs[1])
        return node.outputs[0]
