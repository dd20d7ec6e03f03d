#include "scene/gltf_document.h"

#include <algorithm>
#include <limits>
#include <string_view>

namespace onde::gltf {

namespace {

constexpr uint64_t MAX_SIZE = std::numeric_limits<uint64_t>::max();

std::string name_in(const JsonReader& object) {
    return object.text("name").value_or("");
}

uint64_t size_in(const JsonReader& object, const char* key) {
    return object.integer(key, 0, MAX_SIZE).value_or(0);
}

uint32_t required_index(const JsonReader& object, const char* key) {
    return object.require(key, object.index(key));
}

/// One of the numbers by which glTF names things.
std::optional<uint32_t> code(const JsonReader& object, const char* key,
                             std::initializer_list<uint32_t> known) {
    const auto value = object.integer(key, 0, std::numeric_limits<uint32_t>::max());
    if (!value) return std::nullopt;
    if (std::ranges::find(known, *value) == known.end())
        object.fail(key, "is " + std::to_string(*value) + ", which glTF does not know");
    return uint32_t(*value);
}

ComponentType component_type(const JsonReader& object) {
    return ComponentType(object.require(
        "componentType", code(object, "componentType", {5120, 5121, 5122, 5123, 5125, 5126})));
}

/// The words of accessor.type; 0 for others.
uint32_t component_count(std::string_view type) {
    constexpr std::pair<std::string_view, uint32_t> TYPES[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
        {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [word, count] : TYPES)
        if (word == type) return count;
    return 0;
}

Buffer read_buffer(const JsonReader& object) {
    return {object.text("uri"),
            object.require("byteLength", object.integer("byteLength", 0, MAX_SIZE))};
}

template <class Enum, size_t N>
Enum word_in(const JsonReader& object, const char* key, const std::array<const char*, N>& words,
             std::optional<std::string> word) {
    const std::string given = object.require(key, std::move(word));
    const auto found = std::ranges::find(words, given);
    if (found == words.end()) object.fail(key, "is a word that glTF does not know");
    return Enum(found - words.begin());
}

std::optional<Meshopt> read_meshopt(const JsonReader& view) {
    constexpr std::array MODES{"ATTRIBUTES", "TRIANGLES", "INDICES"};
    constexpr std::array FILTERS{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"};
    auto object = view.extension("KHR_meshopt_compression");
    if (!object) object = view.extension("EXT_meshopt_compression");
    if (!object) return std::nullopt;
    Meshopt meshopt;
    meshopt.buffer = required_index(*object, "buffer");
    meshopt.offset = size_in(*object, "byteOffset");
    meshopt.length = object->require("byteLength", object->integer("byteLength", 0, MAX_SIZE));
    meshopt.stride = uint32_t(object->require("byteStride", object->integer("byteStride", 1, 256)));
    meshopt.count = object->require("count", object->integer("count", 0, MAX_SIZE));
    meshopt.mode = word_in<MeshoptMode>(*object, "mode", MODES, object->text("mode"));
    meshopt.filter =
        word_in<MeshoptFilter>(*object, "filter", FILTERS, object->text("filter").value_or("NONE"));
    return meshopt;
}

BufferView read_view(const JsonReader& object) {
    BufferView view;
    view.buffer = required_index(object, "buffer");
    view.offset = size_in(object, "byteOffset");
    view.length = object.require("byteLength", object.integer("byteLength", 0, MAX_SIZE));
    view.stride = object.integer("byteStride", 0, 252).value_or(0);
    view.meshopt = read_meshopt(object);
    return view;
}

Sparse read_sparse(const JsonReader& object) {
    Sparse sparse;
    sparse.count = object.require("count", object.integer("count", 0, MAX_SIZE));
    const JsonReader indices = object.require("indices", object.object("indices"));
    const JsonReader values = object.require("values", object.object("values"));
    sparse.indices_view = required_index(indices, "bufferView");
    sparse.indices_offset = size_in(indices, "byteOffset");
    sparse.indices_type = component_type(indices);
    sparse.values_view = required_index(values, "bufferView");
    sparse.values_offset = size_in(values, "byteOffset");
    return sparse;
}

Accessor read_accessor(const JsonReader& object) {
    Accessor accessor;
    accessor.view = object.index("bufferView");
    accessor.offset = size_in(object, "byteOffset");
    accessor.count = object.require("count", object.integer("count", 0, MAX_SIZE));
    accessor.type = component_type(object);
    accessor.components = component_count(object.require("type", object.text("type")));
    if (accessor.components == 0) object.fail("type", "is none of SCALAR, VEC2, ..., MAT4");
    accessor.normalized = object.boolean("normalized", false);
    if (const auto sparse = object.object("sparse")) accessor.sparse = read_sparse(*sparse);
    return accessor;
}

ImageSource read_image(const JsonReader& object) {
    return {name_in(object), object.text("uri"), object.index("bufferView")};
}

Sampler read_sampler(const JsonReader& object) {
    Sampler sampler;
    sampler.wrap_u = code(object, "wrapS", {33071, 33648, 10497}).value_or(sampler.wrap_u);
    sampler.wrap_v = code(object, "wrapT", {33071, 33648, 10497}).value_or(sampler.wrap_v);
    sampler.magnify = code(object, "magFilter", {9728, 9729});
    sampler.minify = code(object, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    return sampler;
}

TextureSource read_texture(const JsonReader& object) {
    return {object.index("source"), object.index("sampler")};
}

Attributes read_attributes(const JsonReader& object) {
    Attributes attributes;
    for (const std::string& name : object.keys())
        attributes[name] = required_index(object, name.c_str());
    return attributes;
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
    if (camera.perspective)
        camera.yfov = view.require("yfov", view.number("yfov"));
    else
        camera.ymag = view.require("ymag", view.number("ymag"));
    return camera;
}

LightSource read_light(const JsonReader& object) {
    LightSource light;
    light.name = name_in(object);
    light.type = object.require("type", object.text("type"));
    light.color = object.vector<3>("color").value_or(light.color);
    light.intensity = object.number("intensity", light.intensity);
    return light;
}

SceneSource read_scene(const JsonReader& object) {
    return {name_in(object), object.indices("nodes")};
}

template <class T>
std::vector<T> read_list(const JsonReader& root, const char* key, T (*read)(const JsonReader&)) {
    std::vector<T> list;
    for (const JsonReader& object : root.objects(key)) list.push_back(read(object));
    return list;
}

} // namespace

Document read_document(const JsonReader& root) {
    Document document;
    const JsonReader asset = root.require("asset", root.object("asset"));
    document.version = asset.require("version", asset.text("version"));
    document.extensions_used = root.texts("extensionsUsed");
    document.extensions_required = root.texts("extensionsRequired");
    if (!document.version.starts_with("2.")) return document; // its keys mean something else
    document.buffers = read_list(root, "buffers", read_buffer);
    document.views = read_list(root, "bufferViews", read_view);
    document.accessors = read_list(root, "accessors", read_accessor);
    document.images = read_list(root, "images", read_image);
    document.samplers = read_list(root, "samplers", read_sampler);
    document.textures = read_list(root, "textures", read_texture);
    document.materials = root.objects("materials");
    document.meshes = read_list(root, "meshes", read_mesh);
    document.nodes = read_list(root, "nodes", read_node);
    document.cameras = read_list(root, "cameras", read_camera);
    if (const auto lights = root.extension("KHR_lights_punctual"))
        document.lights = read_list(*lights, "lights", read_light);
    document.scenes = read_list(root, "scenes", read_scene);
    document.scene = root.index("scene");
    document.animated = root.has("animations");
    document.skinned = root.has("skins");
    return document;
}

} // namespace onde::gltf
