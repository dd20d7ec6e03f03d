#include "scene/gltf/textures.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/references.h"

#include <fmt/format.h>

namespace onde::gltf {

namespace {

constexpr uint32_t MOST_UV_SETS = 256;

Wrap wrap_mode(uint32_t mode) {
    constexpr uint32_t CLAMP_TO_EDGE = 33071, MIRRORED_REPEAT = 33648;
    if (mode == CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

UvTransform read_transform(const JsonReader& source) {
    UvTransform transform;
    if (const auto offset = source.vector<2>("offset"))
        transform.offset = glm::vec2((*offset)[0], (*offset)[1]);
    if (const auto scale = source.vector<2>("scale"))
        transform.scale = glm::vec2((*scale)[0], (*scale)[1]);
    transform.rotation = float(source.number("rotation", 0.0));
    return transform;
}

std::string label_of(const ImageSource& image) {
    return shown(image.name.empty() ? image.uri.value_or("") : image.name);
}

std::string name_of(const ImageSource& image, uint32_t index) {
    return fmt::format("image {} '{}'", index, label_of(image));
}

} // namespace

/// The image's file, read or decoded once; nothing where there is none.
std::optional<std::span<const uint8_t>> TextureLoader::encoded(uint32_t index,
                                                               const std::string& user) {
    const auto [found, is_new] = encoded_.try_emplace(index);
    if (!is_new) return found->second;
    const ImageSource& image = at(file_, file_.document.images, index, "image", user);
    const std::string name = name_of(image, index);
    if (image.view)
        found->second = view_bytes(file_, *image.view, name);
    else if (image.uri)
        found->second = uri_bytes(file_, *image.uri, file_.where(name));
    return found->second;
}

/// Nothing for an image that can't be read.
std::optional<TexelImage> TextureLoader::decode(uint32_t index, const std::string& user) {
    const auto bytes = encoded(index, user);
    if (!bytes) return std::nullopt;
    try {
        const ImageSource& image = file_.document.images[index];
        return decode_within(file_.context, *bytes, file_.where(name_of(image, index)));
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// The first image of the same text or of the same bytes.
uint32_t TextureLoader::first_of_file(uint32_t index, const std::string& user) {
    const ImageSource& image = at(file_, file_.document.images, index, "image", user);
    const std::string_view uri = image.uri && !image.view ? *image.uri : std::string_view();
    if (const auto found = first_of_uri_.find(uri); found != first_of_uri_.end())
        return found->second;
    uint32_t first = index;
    if (const auto bytes = encoded(index, user))
        first = first_of_bytes_.try_emplace({bytes->data(), bytes->size()}, index).first->second;
    if (!uri.empty()) first_of_uri_[uri] = first;
    return first;
}

/// The first of the texture's images that can be read; nothing, with a note, if there is none.
std::optional<TexelImage> TextureLoader::decode_any(const TextureSource& texture,
                                                    const std::string& user) {
    std::vector<uint32_t> candidates{*texture.image};
    candidates.insert(candidates.end(), texture.fallbacks.begin(), texture.fallbacks.end());
    std::string tried;
    for (uint32_t index : candidates) {
        if (auto pixels = decode(index, user)) return pixels;
        if (tried.empty()) tried = name_of(file_.document.images[index], index);
    }
    file_.notes.wrong("Images that are missing or can't be read are left out", tried);
    return std::nullopt;
}

int32_t TextureLoader::load(const std::optional<JsonReader>& part, std::string_view key, bool srgb,
                            const std::string& user) {
    const std::optional<JsonReader> info = part ? part->object(key) : std::nullopt;
    if (!info || !is_shown) return NO_TEXTURE;
    const uint32_t index = info->require("index", info->index("index"));
    TextureUse use{.srgb = srgb, .uv_set = info->index("texCoord").value_or(0)};
    if (const auto transform = info->extension("KHR_texture_transform")) {
        use.uv_set = transform->index("texCoord").value_or(use.uv_set);
        use.transform = read_transform(*transform);
    }
    if (use.uv_set >= MOST_UV_SETS) {
        file_.notes.wrong("Textures on sets of texture coordinates above 255 are dropped", user);
        return NO_TEXTURE;
    }
    const TextureSource& texture = at(file_, file_.document.textures, index, "texture", user);
    if (!texture.image) {
        file_.notes.add("Textures without a PNG or JPEG image are dropped", user);
        return NO_TEXTURE;
    }
    Sampler sampler;
    if (texture.sampler)
        sampler = at(file_, file_.document.samplers, *texture.sampler, "sampler", user);
    use.wrap_u = wrap_mode(sampler.wrap_u);
    use.wrap_v = wrap_mode(sampler.wrap_v);
    constexpr uint32_t NEAREST = 9728;
    if (sampler.magnify == NEAREST) use.filter = TextureFilter::nearest;
    const uint32_t first = first_of_file(*texture.image, user);
    std::vector<int32_t>& loaded = loaded_[first];
    for (const int32_t known : loaded)
        if (use_of(scene_.textures[size_t(known)]) == use) return known;
    const ImageSource& image = at(file_, file_.document.images, *texture.image, "image", user);
    if (!loaded.empty()) {
        const int32_t known = loaded.front();
        const Texture& other = scene_.textures[size_t(known)];
        const int32_t owner = other.same_image_as == NO_TEXTURE ? known : other.same_image_as;
        loaded.push_back(add_texture(scene_.textures, label_of(image), {}, use, owner));
        return loaded.back();
    }
    if (missing_.contains(first)) return NO_TEXTURE;
    auto pixels = decode_any(texture, user);
    if (!pixels) {
        missing_.insert(first);
        return NO_TEXTURE;
    }
    loaded.push_back(add_texture(scene_.textures, label_of(image), std::move(*pixels), use));
    return loaded.back();
}

} // namespace onde::gltf
