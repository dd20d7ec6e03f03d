// Of a glTF document what moves nodes and vertices.
#include "scene/gltf/document_parts.h"

namespace onde::gltf {

namespace {

Skin read_skin(const JsonReader& object) {
    return {name_in(object), object.indices("joints"), object.index("inverseBindMatrices")};
}

AnimationSampler read_sampler(const JsonReader& object) {
    constexpr std::array WORDS{"LINEAR", "STEP", "CUBICSPLINE"};
    return {required_index(object, "input"), required_index(object, "output"),
            word_in<Interpolation>(object, "interpolation", WORDS,
                                   object.text("interpolation").value_or("LINEAR"))};
}

Channel read_channel(const JsonReader& object) {
    constexpr std::array WORDS{"translation", "rotation", "scale", "weights", "pointer"};
    const JsonReader target = object.require("target", object.object("target"));
    return {required_index(object, "sampler"), target.index("node"),
            word_in<AnimatedPath>(target, "path", WORDS, target.text("path"))};
}

Animation read_animation(const JsonReader& object) {
    return {name_in(object), read_list(object, "samplers", read_sampler),
            read_list(object, "channels", read_channel)};
}

} // namespace

void read_poses(const JsonReader& root, Document& document) {
    document.skins = read_list(root, "skins", read_skin);
    document.animations = read_list(root, "animations", read_animation);
}

} // namespace onde::gltf
