// Materials, textures and images of glTF (sections 3.8 and 3.9).
#include "core/error.h"
#include "core/shown.h"
#include "scene/gltf_reachable.h"
#include "scene/gltf_scene.h"
#include "scene/gltf_specular_glossiness.h"
#include "scene/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace onde::gltf {

namespace {

/// Decodes each texture when it is first used, once for each way of using it.
class TextureLoader {
  public:
    TextureLoader(File& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The scene's index of the texture that `key` of a material's part names, or NO_TEXTURE where
    /// there is none or we can't use it.
    int32_t load(const std::optional<JsonReader>& part, std::string_view key, bool srgb,
                 const std::string& user);

    bool is_shown = true; ///< whether the material in work is; else it goes without textures

  private:
    std::optional<std::span<const uint8_t>> encoded(uint32_t index, const std::string& user);
    std::optional<ByteImage> decode(uint32_t index, const std::string& user);
    uint32_t first_of_file(uint32_t index, const std::string& user);
    std::optional<ByteImage> decode_any(const TextureSource& texture, const std::string& user);

    File& file_;
    Scene& scene_;
    std::map<uint32_t, std::vector<int32_t>> loaded_;   ///< the textures of an image
    std::map<std::string_view, uint32_t> first_of_uri_; ///< images
    std::map<std::pair<const uint8_t*, size_t>, uint32_t> first_of_bytes_;
    std::map<uint32_t, std::optional<std::span<const uint8_t>>> encoded_; ///< by image
    std::set<uint32_t> missing_;                                          ///< images
};

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
std::optional<ByteImage> TextureLoader::decode(uint32_t index, const std::string& user) {
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
std::optional<ByteImage> TextureLoader::decode_any(const TextureSource& texture,
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
        loaded.push_back(add_texture(scene_.textures, label_of(image), {}, use, loaded.front()));
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

float unit(double value) {
    return float(std::clamp(value, 0.0, 1.0));
}

template <size_t N>
glm::vec3 rgb(const std::array<double, N>& values) {
    return glm::vec3(values[0], values[1], values[2]);
}

/// A number of an optional part of a material.
double number_in(const std::optional<JsonReader>& part, const char* key, double fallback) {
    return part ? part->number(key, fallback) : fallback;
}

void apply_emissive_strength(const JsonReader& source, Material& material) {
    const auto extended = source.extension("KHR_materials_emissive_strength");
    material.emission *= float(std::max(0.0, number_in(extended, "emissiveStrength", 1.0)));
}

/// Clear glass is a dielectric; what else transmits stays opaque.
void apply_transmission(File& file, const JsonReader& source, Material& material) {
    const auto extended = source.extension("KHR_materials_transmission");
    const double factor = number_in(extended, "transmissionFactor", 0.0);
    if (factor <= 0.0) return;
    if (extended->has("transmissionTexture") || factor <= 0.5) {
        file.notes.add("Partial transmission is rendered opaque", material.name);
        return;
    }
    const double ior = number_in(source.extension("KHR_materials_ior"), "ior", 1.5);
    material.kind = MaterialKind::dielectric;
    material.ior = float(std::clamp(ior, 0.01, 100.0));
    file.notes.add("Transmission is rendered as solid glass", material.name);
}

void apply_metallic_roughness(TextureLoader& textures, const JsonReader& source,
                              const std::string& user, Material& material) {
    const std::optional<JsonReader> pbr = source.object("pbrMetallicRoughness");
    material.base_color = glm::vec3(1.0f);
    if (pbr)
        if (const auto factor = pbr->vector<4>("baseColorFactor")) {
            material.base_color = glm::clamp(rgb(*factor), 0.0f, 1.0f);
            material.alpha = unit((*factor)[3]);
        }
    material.metallic = unit(number_in(pbr, "metallicFactor", 1.0));
    material.roughness = unit(number_in(pbr, "roughnessFactor", 1.0));
    material.base_color_texture = textures.load(pbr, "baseColorTexture", true, user);
    material.metallic_roughness_texture =
        textures.load(pbr, "metallicRoughnessTexture", false, user);
}

void apply_alpha(File& file, const JsonReader& source, const std::string& user,
                 Material& material) {
    const std::string mode = source.text("alphaMode").value_or("OPAQUE");
    if (mode == "MASK")
        material.alpha_mode = AlphaMode::mask;
    else if (mode == "BLEND")
        material.alpha_mode = AlphaMode::blend;
    else if (mode != "OPAQUE")
        file.notes.wrong("Unknown alpha modes are taken as OPAQUE", user);
    material.alpha_cutoff = float(std::max(0.0, source.number("alphaCutoff", 0.5)));
}

/// Materials of the older model, whose textures are made anew where it has one of reflectances.
class OldMaterials {
  public:
    OldMaterials(File& file, Scene& scene, TextureLoader& textures)
        : file_(file), scene_(scene), textures_(textures) {}

    void apply(const JsonReader& source, const std::string& user, Material& material);
    /// Frees what no material uses any more.
    void release_textures();

  private:
    int32_t add(const Texture& like, ByteImage image, bool srgb);

    File& file_;
    Scene& scene_;
    TextureLoader& textures_;
    std::vector<int32_t> replaced_;
};

int32_t OldMaterials::add(const Texture& like, ByteImage image, bool srgb) {
    Texture texture = like;
    texture.image = std::move(image);
    texture.srgb = srgb;
    texture.same_image_as = NO_TEXTURE;
    scene_.textures.push_back(std::move(texture));
    return int32_t(scene_.textures.size() - 1);
}

void OldMaterials::apply(const JsonReader& source, const std::string& user, Material& material) {
    const auto old = source.extension("KHR_materials_pbrSpecularGlossiness");
    if (!old) return;
    file_.notes.add("Specular-glossiness materials are converted to metallic-roughness", user);
    SpecularGlossiness factors;
    if (const auto diffuse = old->vector<4>("diffuseFactor")) {
        factors.diffuse = glm::clamp(rgb(*diffuse), 0.0f, 1.0f);
        material.alpha = unit((*diffuse)[3]);
    }
    if (const auto specular = old->vector<3>("specularFactor"))
        factors.specular = glm::clamp(rgb(*specular), 0.0f, 1.0f);
    factors.glossiness = unit(old->number("glossinessFactor", 1.0));
    const int32_t diffuse = textures_.load(old, "diffuseTexture", true, user);
    const int32_t specular = textures_.load(old, "specularGlossinessTexture", true, user);
    material.base_color_texture = diffuse;
    material.metallic_roughness_texture = NO_TEXTURE;
    if (specular == NO_TEXTURE) {
        const MetallicRoughness converted = to_metallic_roughness(factors);
        material.base_color = converted.base_color;
        material.metallic = converted.metallic;
        material.roughness = converted.roughness;
        return;
    }
    const auto with_image = [&](int32_t index) {
        Texture texture = scene_.textures[size_t(index)];
        texture.image = image_of(scene_.textures, texture);
        return texture;
    };
    const Texture of_specular = with_image(specular);
    const Texture of_diffuse = with_image(diffuse == NO_TEXTURE ? specular : diffuse);
    const ByteImage white, &colors = diffuse == NO_TEXTURE ? white : of_diffuse.image;
    const uint64_t texels = uint64_t(std::max(colors.width, of_specular.image.width)) *
                            std::max(colors.height, of_specular.image.height);
    file_.context.spend(texels, 2 * 4, file_.where(user));
    ConvertedTextures converted = convert_textures(factors, colors, of_specular.image);
    material.base_color_texture = add(of_diffuse, std::move(converted.base_color), true);
    material.metallic_roughness_texture =
        add(of_specular, std::move(converted.metallic_roughness), false);
    material.base_color = glm::vec3(1.0f);
    material.metallic = material.roughness = 1.0f;
    replaced_.insert(replaced_.end(), {diffuse, specular});
}

void OldMaterials::release_textures() {
    std::vector<bool> used(scene_.textures.size(), false);
    for (const Material& material : scene_.materials)
        for_each_texture(material, [&](const auto&, int32_t texture) {
            if (texture != NO_TEXTURE) used[size_t(texture)] = true;
        });
    for (size_t i = 0; i < used.size(); ++i)
        if (const int32_t owner = scene_.textures[i].same_image_as; owner != NO_TEXTURE)
            used[size_t(owner)] = used[size_t(owner)] || used[i];
    for (int32_t texture : replaced_)
        if (texture != NO_TEXTURE && !used[size_t(texture)])
            scene_.textures[size_t(texture)].image = {1, 1, {255, 255, 255, 255}};
}

Material convert(File& file, TextureLoader& textures, OldMaterials& old_materials,
                 const JsonReader& source, const std::string& user) {
    Material material;
    material.name = shown(source.text("name").value_or(""));
    material.kind = MaterialKind::metallic_roughness;
    apply_metallic_roughness(textures, source, user, material);
    old_materials.apply(source, user, material);
    material.emission = glm::vec3(0.0f);
    if (const auto factor = source.vector<3>("emissiveFactor"))
        material.emission = glm::max(rgb(*factor), 0.0f);
    material.two_sided = material.double_sided = source.boolean("doubleSided", false);
    material.emission_texture = textures.load(source, "emissiveTexture", true, user);
    material.normal_scale = float(number_in(source.object("normalTexture"), "scale", 1.0));
    material.normal_texture = textures.load(source, "normalTexture", false, user);
    apply_alpha(file, source, user, material);
    if (source.extension("KHR_materials_unlit")) {
        material.kind = MaterialKind::unlit;
        material.emission = glm::vec3(0.0f);
        return material;
    }
    apply_emissive_strength(source, material);
    apply_transmission(file, source, material);
    return material;
}

} // namespace

void add_materials(File& file, Scene& scene) {
    TextureLoader textures(file, scene);
    OldMaterials old_materials(file, scene, textures);
    const std::vector<JsonReader>& materials = file.document.materials;
    const std::vector<bool> used = shown_materials(file);
    for (size_t i = 0; i < materials.size(); ++i) {
        const std::string name = materials[i].text("name").value_or("");
        textures.is_shown = used[i];
        const std::string user = name.empty() ? fmt::format("material {}", i)
                                              : fmt::format("material {} '{}'", i, shown(name));
        scene.materials.push_back(convert(file, textures, old_materials, materials[i], user));
    }
    old_materials.release_textures();
    Material& none = scene.materials.emplace_back();
    none.name = "default";
    none.kind = MaterialKind::metallic_roughness;
    none.base_color = glm::vec3(1.0f);
    none.metallic = 1.0f;
    scene.chapter.phong[uint32_t(scene.materials.size() - 1)] = {}; // white, and no mirror
}

} // namespace onde::gltf
