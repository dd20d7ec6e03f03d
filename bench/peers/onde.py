"""Onde: its own TOML, and a PLY file for each mesh."""

import json

import scene as scenes


def edge_tint(color):
    """That makes the reflectance the same at 82 degrees as head on."""
    rise = (1 - 0.139173) ** 5
    return [part / (part + (1 - part) * rise) for part in color]


def material_of(name, material):
    kinds = {"fog": "dielectric", "plastic": "metallic-roughness", "gltf": "metallic-roughness"}
    keys = {"name": name, "kind": kinds.get(material.kind, material.kind), "base_color": list(material.color)}
    if material.kind != "diffuse":
        keys["roughness"] = material.roughness
    if material.kind == "conductor":
        keys["edge_tint"] = edge_tint(material.color)
    if material.kind == "fog":
        keys |= {"base_color": 1, "ior": 1, "medium": {
            "scattering": material.scattering, "absorption": material.absorption, "anisotropy": material.anisotropy}}
    if material.kind in ("dielectric", "plastic"):
        keys["ior"] = material.ior
    if material.kind == "gltf":
        keys["metallic"] = material.metallic
    if material.emits:
        keys |= {"emission": list(material.emission), "two_sided": False}
    for texture in ("color_texture", "metallic_roughness_texture", "normal_texture", "emission_texture"):
        if getattr(material, texture):
            keys[texture.replace("color", "base_color")] = getattr(material, texture)
    return keys


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + " }"
    return json.dumps(value)


def table(head, keys):
    return "\n".join([head, *(f"{key} = {toml(value)}" for key, value in keys.items()), ""])


def prepare(scene, folder):
    """Writes onde.toml and its meshes into the scene's folder."""
    camera = scene.camera
    texts = [table("[camera]", {"position": list(camera.position), "look_at": list(camera.look_at),
                                "vertical_fov": camera.vertical_fov})]
    # Onde counts the way into fog as a surface.
    texts.append(table("[render]", {"depth": scene.depth + scene.has_media, "filter": "box"}))
    texts += [table("[[material]]", material_of(name, material)) for name, material in scene.materials.items()]
    for number, mesh in enumerate(scene.meshes):
        scenes.write_ply(folder / f"onde-{number}.ply", mesh, v_up=True)
        texts.append(table("[[shape]]", {"type": "mesh", "file": f"onde-{number}.ply", "material": mesh.material}))
    if scene.environment:
        texts.append(table("[environment]", {"map": scene.environment}))
    if scene.sun:
        texts.append(table("[[light]]", {"type": "directional", "direction": [-part for part in scene.sun.to_light],
                                         "irradiance": list(scene.sun.irradiance)}))
    (folder / "onde.toml").write_text("\n".join(texts))


def command(program, folder, settings, samples, seed, output):
    size = f"{settings['size']}x{settings['size']}"
    return [program, "render", folder / "onde.toml", "-o", output, "--float", "--size", size, "--spp", samples, "--seed", seed,
            "--studio", "off", "--ground", "off", "--json", f"{output}.json", "--quiet"]
