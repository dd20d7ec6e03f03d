// Textures of Mitsuba's files.
#include "scene/checkerboard.h"
#include "scene/mitsuba/material.h"
#include "scene/references.h"

namespace onde::mitsuba {
namespace {

/// Scale and translation of a transform of texture coordinates, whose v runs downward as ours.
UvTransform uv_transform(const glm::dmat4& to_uv, const Element& texture, Notes& notes) {
    if (to_uv[0].y != 0.0 || to_uv[1].x != 0.0)
        notes.add("Rotations of textures are left out", texture.where);
    return {.offset = glm::vec2(to_uv[3].x, to_uv[3].y),
            .scale = glm::vec2(to_uv[0].x, to_uv[1].y)};
}

} // namespace

Materials::Textured Materials::color(const Element& of, std::string_view name,
                                     const glm::dvec3& absent) {
    const Element* found = document_.property(of, name);
    if (found && found->tag == "texture")
        if (const auto textured = texture(*found, true)) return *textured;
    return {glm::vec3(glm::max(Values(document_, of).color(name).value_or(absent), 0.0))};
}

std::optional<Materials::Textured> Materials::texture(const Element& texture, bool is_color) {
    const std::string& type = texture["type"];
    if (type == "bitmap") return bitmap(texture, is_color);
    if (type == "checkerboard") return checkerboard(texture);
    if (type == "rawconstant" || type == "uniform" || type == "srgb")
        return Textured{
            glm::vec3(Values(document_, texture)
                          .vector(type == "srgb" ? "color" : "value", glm::dvec3(0.5)))};
    document_.notes().add("Textures of other kinds than bitmap and checkerboard are left out",
                          type);
    return std::nullopt;
}

std::optional<Materials::Textured> Materials::bitmap(const Element& texture, bool is_color) {
    const Values values(document_, texture);
    const std::string file = values.text("filename"),
                      wrap_mode = values.text("wrap_mode", "repeat");
    const auto path = document_.find(file, "Pictures");
    if (!path) return std::nullopt;
    const Wrap wrap = value_of<Wrap>(wrap_mode).value_or(Wrap::repeat);
    const TextureUse use{.srgb = is_color && !values.flag("raw", false),
                         .wrap_u = wrap,
                         .wrap_v = wrap,
                         .filter = values.text("filter_type") == "nearest" ? TextureFilter::nearest
                                                                           : TextureFilter::linear,
                         .transform =
                             uv_transform(values.transform("to_uv"), texture, document_.notes())};
    try {
        return Textured{glm::vec3(1.0f),
                        add_texture_file(scene_, document_.context(), path->parent_path(),
                                         path->filename().string(), use, texture.where)};
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError&) {
        document_.notes().wrong("Pictures that can't be read are left out", file);
        return std::nullopt;
    }
}

Materials::Textured Materials::checkerboard(const Element& texture) {
    const Values values(document_, texture);
    const auto plain = [&](std::string_view name, double absent) {
        return glm::vec3(glm::clamp(values.color(name).value_or(glm::dvec3(absent)), 0.0, 1.0));
    };
    return {glm::vec3(1.0f),
            add_checkerboard(scene_.textures, plain("color0", 0.4), plain("color1", 0.2),
                             uv_transform(values.transform("to_uv"), texture, document_.notes()))};
}

} // namespace onde::mitsuba
