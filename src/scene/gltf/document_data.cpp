// Of a glTF document what holds bytes, and windows into them.
#include "scene/gltf/document_parts.h"

#include <string_view>

namespace onde::gltf {

namespace {

uint64_t size_in(const JsonReader& object, const char* key) {
    return object.integer(key, 0, MAX_SIZE).value_or(0);
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
    TextureSource texture{std::nullopt, object.index("sampler"), {}};
    const auto add = [&](Index image) {
        if (texture.image && image) texture.fallbacks.push_back(*image);
        if (!texture.image) texture.image = image;
    };
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp"})
        if (const auto extension = object.extension(name)) add(extension->index("source"));
    add(object.index("source"));
    return texture;
}

} // namespace

void read_data(const JsonReader& root, Document& document) {
    document.buffers = read_list(root, "buffers", read_buffer);
    document.views = read_list(root, "bufferViews", read_view);
    document.accessors = read_list(root, "accessors", read_accessor);
    document.images = read_list(root, "images", read_image);
    document.samplers = read_list(root, "samplers", read_sampler);
    document.textures = read_list(root, "textures", read_texture);
}

} // namespace onde::gltf
