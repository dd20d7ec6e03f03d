// The root of a glTF file: meshes, nodes and what stands on them.
#include "scene/gltf/document.h"

#include "scene/gltf/document_parts.h"

#include <algorithm>

namespace onde::gltf {

namespace {

std::vector<VariantMaterial> read_variant_materials(const JsonReader& primitive) {
    std::vector<VariantMaterial> result;
    const auto extension = primitive.extension("KHR_materials_variants");
    if (!extension) return result;
    for (const JsonReader& mapping : extension->objects("mappings"))
        for (uint32_t variant : mapping.indices("variants"))
            result.push_back({variant, required_index(mapping, "material")});
    return result;
}

Primitive read_primitive(const JsonReader& object) {
    Primitive primitive;
    primitive.attributes =
        read_attributes(object.require("attributes", object.object("attributes")));
    primitive.indices = object.index("indices");
    primitive.material = object.index("material");
    primitive.mode = uint32_t(object.integer("mode", 0, 6).value_or(4));
    for (const JsonReader& target : object.objects("targets"))
        primitive.targets.push_back(read_attributes(target));
    primitive.variants = read_variant_materials(object);
    if (const auto draco = object.extension("KHR_draco_mesh_compression"))
        primitive.draco = {
            required_index(*draco, "bufferView"),
            read_attributes(draco->require("attributes", draco->object("attributes")))};
    return primitive;
}

MeshSource read_mesh(const JsonReader& object) {
    MeshSource mesh;
    mesh.name = name_in(object);
    for (const JsonReader& primitive : object.objects("primitives"))
        mesh.primitives.push_back(read_primitive(primitive));
    mesh.weights = object.numbers("weights");
    return mesh;
}

Node read_node(const JsonReader& object) {
    Node node;
    node.name = name_in(object);
    node.children = object.indices("children");
    node.mesh = object.index("mesh");
    node.camera = object.index("camera");
    node.skin = object.index("skin");
    if (const auto light = object.extension("KHR_lights_punctual"))
        node.light = required_index(*light, "light");
    node.matrix = object.vector<16>("matrix");
    node.translation = object.vector<3>("translation").value_or(node.translation);
    node.rotation = object.vector<4>("rotation").value_or(node.rotation);
    node.scale = object.vector<3>("scale").value_or(node.scale);
    node.weights = object.numbers("weights");
    if (const auto visibility = object.extension("KHR_node_visibility"))
        node.visible = visibility->boolean("visible", true);
    if (const auto instancing = object.extension("EXT_mesh_gpu_instancing"))
        node.instancing =
            read_attributes(instancing->require("attributes", instancing->object("attributes")));
    return node;
}

CameraSource read_camera(const JsonReader& object) {
    CameraSource camera;
    camera.name = name_in(object);
    const std::string type = object.require("type", object.text("type"));
    camera.perspective = type == "perspective";
    if (!camera.perspective && type != "orthographic")
        object.fail("type", "is neither perspective nor orthographic");
    const JsonReader view = object.require(type, object.object(type));
    if (camera.perspective) {
        camera.yfov = view.require("yfov", view.number("yfov"));
        camera.aspect_ratio = view.number("aspectRatio");
    } else {
        camera.ymag = view.require("ymag", view.number("ymag"));
        camera.aspect_ratio = view.require("xmag", view.number("xmag")) / camera.ymag;
    }
    return camera;
}

LightSource read_light(const JsonReader& object) {
    LightSource light;
    light.name = name_in(object);
    light.type = object.require("type", object.text("type"));
    light.color = object.vector<3>("color").value_or(light.color);
    light.intensity = object.number("intensity", light.intensity);
    if (const auto spot = object.object("spot")) {
        light.inner_cone = spot->number("innerConeAngle", light.inner_cone);
        light.outer_cone = spot->number("outerConeAngle", light.outer_cone);
    }
    return light;
}

SceneSource read_scene(const JsonReader& object) {
    return {name_in(object), object.indices("nodes")};
}

} // namespace

Attributes read_attributes(const JsonReader& object) {
    Attributes attributes;
    for (const std::string& name : object.keys())
        attributes[name] = required_index(object, name.c_str());
    return attributes;
}

Document read_document(const JsonReader& root) {
    Document document;
    const JsonReader asset = root.require("asset", root.object("asset"));
    document.version = asset.require("version", asset.text("version"));
    document.extensions_used = root.texts("extensionsUsed");
    document.extensions_required = root.texts("extensionsRequired");
    if (!document.version.starts_with("2.")) return document; // its keys mean something else
    read_data(root, document);
    document.materials = root.objects("materials");
    document.meshes = read_list(root, "meshes", read_mesh);
    document.nodes = read_list(root, "nodes", read_node);
    document.cameras = read_list(root, "cameras", read_camera);
    if (const auto lights = root.extension("KHR_lights_punctual"))
        document.lights = read_list(*lights, "lights", read_light);
    document.scenes = read_list(root, "scenes", read_scene);
    document.scene = root.index("scene");
    if (const auto variants = root.extension("KHR_materials_variants"))
        document.variants = read_list(*variants, "variants", name_in);
    read_poses(root, document);
    return document;
}

} // namespace onde::gltf
