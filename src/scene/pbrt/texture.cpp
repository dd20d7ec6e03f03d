#include "scene/pbrt/texture.h"

#include "scene/checkerboard.h"
#include "scene/mean_color.h"

#include <algorithm>

namespace onde::pbrt {
namespace {

/// Of coordinates whose v runs downward, for a picture that pbrt puts upright.
UvTransform uv_transform(const Parameters& parameters) {
    const auto number = [&](std::string_view name, double absent) {
        return float(parameters.number(name).value_or(absent));
    };
    const glm::vec2 scale(number("uscale", 1.0), number("vscale", 1.0));
    const glm::vec2 step(number("udelta", 0.0), number("vdelta", 0.0));
    return {.offset = {step.x, 1.0f - scale.y - step.y}, .scale = scale};
}

Wrap wrap_of(const Parameters& parameters, Notes& notes) {
    const std::string word = parameters.text("wrap").value_or("repeat");
    if (word == "black") notes.add("Pictures that are black beyond their edges go on as at these");
    return word == "repeat" ? Wrap::repeat : Wrap::clamp;
}

} // namespace

void Textures::define(const std::string& name, const std::string& kind, Parameters parameters) {
    definitions_.insert_or_assign(name, Definition{kind, std::move(parameters)});
}

std::optional<Textured> Textures::named(const std::string& name) {
    constexpr size_t DEEPEST = 16;
    if (const auto known = converted_.find(name); known != converted_.end()) return known->second;
    const auto found = definitions_.find(name);
    if (found == definitions_.end()) {
        sources_.notes.wrong("Textures that are not defined are left out", name);
        return std::nullopt;
    }
    if (in_work_.size() == DEEPEST || !in_work_.insert(name).second) {
        sources_.notes.wrong("Textures that are made of themselves are left out", name);
        return std::nullopt;
    }
    converted_[name] = convert(found->second);
    for (const std::string& unused : found->second.parameters.unused())
        sources_.notes.add("Other parameters of textures are ignored", unused);
    in_work_.erase(name);
    return converted_[name];
}

Textured Textures::convert(const Definition& definition) {
    const Parameters& parameters = definition.parameters;
    const std::string mapping = parameters.text("mapping").value_or("uv");
    if (mapping != "uv") sources_.notes.add("Textures are placed by texture coordinates", mapping);
    if (definition.kind == "imagemap") return image_map(parameters);
    if (definition.kind == "constant") return {plain_color(parameters, "value", 1.0f)};
    if (definition.kind == "scale") return scaled(parameters);
    if (definition.kind == "mix") return mixed(parameters);
    if (definition.kind == "checkerboard") return checkerboard(parameters);
    sources_.notes.add("Textures of other kinds than imagemap, constant, scale, mix and "
                       "checkerboard are grey",
                       definition.kind);
    return {glm::vec3(0.5f)};
}

int32_t Textures::picture(const std::string& file, const TextureUse& use) {
    const auto path = sources_.find(file, "Pictures");
    if (!path) return NO_TEXTURE;
    try {
        return add_texture_file(scene_, sources_.context, sources_.files.folder(),
                                *sources_.files.find(file), use, file);
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError&) {
        sources_.notes.wrong("Pictures that can't be read are left out", file);
        return NO_TEXTURE;
    }
}

Textured Textures::image_map(const Parameters& parameters) {
    const Wrap wrap = wrap_of(parameters, sources_.notes);
    const std::string encoding = parameters.text("encoding").value_or("sRGB");
    if (encoding.starts_with("gamma")) sources_.notes.add("Pictures of other gammas are sRGB");
    if (parameters.flag("invert").value_or(false))
        sources_.notes.add("Pictures are not inverted", parameters.where());
    parameters.find("filter");
    parameters.find("maxanisotropy");
    const int32_t texture =
        picture(parameters.text("filename").value_or(""), {.srgb = encoding != "linear",
                                                           .wrap_u = wrap,
                                                           .wrap_v = wrap,
                                                           .transform = uv_transform(parameters)});
    const auto scale = float(parameters.number("scale").value_or(1.0));
    return {glm::vec3(texture == NO_TEXTURE ? 0.5f : scale), texture};
}

/// A colour without a picture.
glm::vec3 Textures::plain_color(const Parameters& parameters, std::string_view name, float absent) {
    const auto value = color(parameters, name);
    if (!value) return glm::vec3(absent);
    if (value->texture == NO_TEXTURE) return value->factor;
    sources_.notes.add("Pictures within other textures count as their mean", parameters.where());
    return value->factor * mean_color(scene_, value->texture);
}

Textured Textures::checkerboard(const Parameters& parameters) {
    const UvTransform use = uv_transform(parameters);
    const float step = 1.0f - use.offset.y; // pbrt's own v, upward: scale and delta
    const UvTransform halves{.offset = {0.5f * use.offset.x, 0.5f * step},
                             .scale = {0.5f * use.scale.x, -0.5f * use.scale.y}};
    return {glm::vec3(1.0f),
            add_checkerboard(scene_.textures, plain_color(parameters, "tex1", 1.0f),
                             plain_color(parameters, "tex2", 0.0f), halves)};
}

Textured Textures::scaled(const Parameters& parameters) {
    const Textured picture = color(parameters, "tex").value_or(Textured{});
    const Textured scale = color(parameters, "scale").value_or(Textured{});
    if (picture.texture == NO_TEXTURE) return {picture.factor * scale.factor, scale.texture};
    return {picture.factor * plain_color(parameters, "scale", 1.0f), picture.texture};
}

Textured Textures::mixed(const Parameters& parameters) {
    const float amount = plain_color(parameters, "amount", 0.5f).x;
    const Textured first = color(parameters, "tex1").value_or(Textured{glm::vec3(0.0f)});
    const Textured second = color(parameters, "tex2").value_or(Textured{glm::vec3(1.0f)});
    if (first.texture == NO_TEXTURE && second.texture == NO_TEXTURE)
        return {glm::mix(first.factor, second.factor, amount)};
    sources_.notes.add("Of mixed pictures the one that counts more is shown", parameters.where());
    return amount < 0.5f ? first : second;
}

std::optional<Textured> Textures::color(const Parameters& parameters, std::string_view name) {
    if (const auto texture = parameters.texture(name)) return named(*texture);
    const auto value = spectrum_of(parameters, name, sources_);
    if (!value) return std::nullopt;
    return Textured{surface_color(*value)};
}

std::optional<double> Textures::number(const Parameters& parameters, std::string_view name) {
    const auto texture = parameters.texture(name);
    if (!texture) return parameters.number(name);
    const auto value = named(*texture);
    if (!value) return std::nullopt;
    if (value->texture == NO_TEXTURE) return value->factor.x;
    sources_.notes.add("Textures of other values than colours count as their mean", *texture);
    return value->factor.x * mean_color(scene_, value->texture).x;
}

} // namespace onde::pbrt
