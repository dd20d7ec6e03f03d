#include "scene/gltf/old_materials.h"

#include "scene/gltf/numbers.h"
#include "scene/gltf/specular_glossiness.h"

#include <algorithm>

namespace onde::gltf {

int32_t OldMaterials::add(const Texture& like, TexelImage image, bool srgb) {
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
    const TexelImage white, &colors = diffuse == NO_TEXTURE ? white : of_diffuse.image;
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

} // namespace onde::gltf
