// Materials, textures and images of glTF (sections 3.8 and 3.9).
#include "core/error.h"
#include "core/files.h"
#include "image/image_io.h"
#include "scene/gltf_scene.h"
#include "scene/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace onde::gltf {

namespace {

/// Decodes each texture when it is first used, once for each way of using it.
class TextureLoader {
  public:
    TextureLoader(File& file, Scene& scene) : file_(file), scene_(scene) {}

    /// The scene's index of a glTF texture, or NO_TEXTURE where there is none or we can't use it.
    int32_t load(const tinygltf::TextureInfo& info, bool srgb, const std::string& user) {
        return load(info.index, info.texCoord, info.extensions, srgb, user);
    }
    int32_t load(const tinygltf::NormalTextureInfo& info, const std::string& user) {
        return load(info.index, info.texCoord, info.extensions, false, user);
    }

  private:
    int32_t load(int index, int uv_set, const tinygltf::ExtensionMap& extensions, bool srgb,
                 const std::string& user);
    ByteImage decode(const tinygltf::Image& image, const std::string& name) const;

    File& file_;
    Scene& scene_;
    std::map<std::tuple<int, bool, Wrap, Wrap>, int32_t> loaded_;
};

Wrap wrap_mode(int mode) {
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

ByteImage TextureLoader::decode(const tinygltf::Image& image, const std::string& name) const {
    if (image.bufferView >= 0)
        return decode_byte_image(view_bytes(file_, image.bufferView, name), file_.where(name));
    if (!image.image.empty()) return decode_byte_image(image.image, file_.where(name));
    // tinygltf drops what it can't find; look again and say what is wrong.
    const auto path = resolve_inside(file_.folder, decode_uri(image.uri), file_.where(name));
    const std::string bytes = read_file(path);
    return decode_byte_image({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()},
                             file_.where(name));
}

int32_t TextureLoader::load(int index, int uv_set, const tinygltf::ExtensionMap& extensions,
                            bool srgb, const std::string& user) {
    if (index < 0) return NO_TEXTURE;
    if (uv_set != 0) {
        file_.notes.add("Textures on a second set of texture coordinates are dropped", user);
        return NO_TEXTURE;
    }
    if (extensions.contains("KHR_texture_transform"))
        file_.notes.add("KHR_texture_transform is ignored", user);
    const tinygltf::Texture& texture = at(file_, file_.model.textures, index, "texture", user);
    if (texture.source < 0) {
        file_.notes.add("Textures without a PNG or JPEG image are dropped", user);
        return NO_TEXTURE;
    }
    tinygltf::Sampler sampler;
    if (texture.sampler >= 0)
        sampler = at(file_, file_.model.samplers, texture.sampler, "sampler", user);
    const Wrap u = wrap_mode(sampler.wrapS), v = wrap_mode(sampler.wrapT);
    const auto [found, is_new] = loaded_.try_emplace({texture.source, srgb, u, v}, NO_TEXTURE);
    if (!is_new) return found->second;
    const tinygltf::Image& image = at(file_, file_.model.images, texture.source, "image", user);
    const std::string label = image.name.empty() ? image.uri : image.name;
    const std::string name = fmt::format("image {} '{}'", texture.source, label);
    found->second = int32_t(scene_.textures.size());
    scene_.textures.push_back({label, decode(image, name), srgb, u, v});
    return found->second;
}

float unit(double value) {
    return float(std::clamp(value, 0.0, 1.0));
}

/// Numbers of a factor, the missing ones as `fallback`; throws unless finite.
glm::dvec3 factor(const File& file, const std::vector<double>& values, double fallback,
                  const std::string& user) {
    glm::dvec3 result(fallback);
    for (size_t i = 0; i < std::min<size_t>(3, values.size()); ++i) result[i] = values[i];
    if (!std::isfinite(result.x + result.y + result.z))
        throw InputError("{}: {}: a factor is not finite; export it again", file.path.string(),
                         user);
    return result;
}

const tinygltf::Value* extension(const tinygltf::Material& material, const char* name) {
    const auto found = material.extensions.find(name);
    return found == material.extensions.end() ? nullptr : &found->second;
}

void apply_emissive_strength(const tinygltf::Material& source, Material& material) {
    const tinygltf::Value* extended = extension(source, "KHR_materials_emissive_strength");
    if (extended)
        material.emission *= float(std::max(0.0, number_in(*extended, "emissiveStrength", 1.0)));
}

/// Clear glass is a dielectric; what else transmits stays opaque.
void apply_transmission(File& file, const tinygltf::Material& source, Material& material) {
    const tinygltf::Value* extended = extension(source, "KHR_materials_transmission");
    if (!extended || number_in(*extended, "transmissionFactor", 0.0) <= 0.0) return;
    const bool textured = extended->Has("transmissionTexture");
    if (textured || number_in(*extended, "transmissionFactor", 0.0) <= 0.5) {
        file.notes.add("Partial transmission is rendered opaque", material.name);
        return;
    }
    const tinygltf::Value* ior = extension(source, "KHR_materials_ior");
    material.kind = MaterialKind::dielectric;
    material.ior = ior ? float(std::clamp(number_in(*ior, "ior", 1.5), 0.01, 100.0)) : 1.5f;
    file.notes.add("Transmission is rendered as solid glass", material.name);
}

Material convert(File& file, TextureLoader& textures, const tinygltf::Material& source,
                 const std::string& user) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = source.name;
    material.kind = MaterialKind::metallic_roughness;
    material.base_color = glm::clamp(factor(file, pbr.baseColorFactor, 1.0, user), 0.0, 1.0);
    material.metallic = unit(pbr.metallicFactor);
    material.roughness = unit(pbr.roughnessFactor);
    material.emission = glm::max(factor(file, source.emissiveFactor, 0.0, user), 0.0);
    material.two_sided = source.doubleSided;
    material.normal_scale = float(source.normalTexture.scale);
    material.base_color_texture = textures.load(pbr.baseColorTexture, true, user);
    material.metallic_roughness_texture = textures.load(pbr.metallicRoughnessTexture, false, user);
    material.emission_texture = textures.load(source.emissiveTexture, true, user);
    material.normal_texture = textures.load(source.normalTexture, user);
    if (source.alphaMode == "MASK" || source.alphaMode == "BLEND")
        file.notes.add("Alpha MASK and BLEND are rendered opaque", user);
    apply_emissive_strength(source, material);
    apply_transmission(file, source, material);
    return material;
}

} // namespace

void add_materials(File& file, Scene& scene) {
    TextureLoader textures(file, scene);
    for (size_t i = 0; i < file.model.materials.size(); ++i) {
        const tinygltf::Material& source = file.model.materials[i];
        const std::string user = source.name.empty()
                                     ? fmt::format("material {}", i)
                                     : fmt::format("material {} '{}'", i, source.name);
        scene.materials.push_back(convert(file, textures, source, user));
    }
    Material& none = scene.materials.emplace_back();
    none.name = "default";
    none.kind = MaterialKind::metallic_roughness;
    none.base_color = glm::vec3(1.0f);
    none.metallic = 1.0f;
    scene.chapter.phong[uint32_t(scene.materials.size() - 1)] = {}; // white, and no mirror
}

} // namespace onde::gltf
