#include "scene/gltf/specular_glossiness.h"
#include "scratch.h"

using namespace onde;
using namespace onde::gltf;
using onde::test::bytes_of;
using onde::test::ScratchFolder;

TEST_CASE("specular-glossiness materials reflect as much when they are converted") {
    // Diffuse and specular reflectance of the result: base (1 - m) (1 - 0.04), mix (0.04, base, m).
    for (const float specular : {0.0f, 0.02f, 0.04f, 0.1f, 0.5f, 0.9f})
        for (const float diffuse : {0.0f, 0.2f, 0.8f}) {
            INFO("diffuse " << diffuse << ", specular " << specular);
            const MetallicRoughness converted =
                to_metallic_roughness({glm::vec3(diffuse), glm::vec3(specular), 0.25f});
            CHECK(converted.roughness == 0.75f);
            if (specular <= 0.04f) CHECK(converted.metallic == Approx(0.0f).margin(1e-5));
            if (specular < 0.04f || converted.base_color.r >= 1.0f) continue;
            const float m = converted.metallic, base = converted.base_color.r;
            CHECK(0.04f + m * (base - 0.04f) == Approx(specular).margin(0.01));
        }
    const MetallicRoughness gold =
        to_metallic_roughness({glm::vec3(0.0f), glm::vec3(1.0f, 0.7f, 0.3f), 1.0f});
    CHECK(gold.metallic == Approx(1.0f).margin(1e-3));
    CHECK(glm::length(gold.base_color - glm::vec3(1.0f, 0.7f, 0.3f)) < 0.01f);
}

TEST_CASE("textures of specular and glossiness are converted texel by texel") {
    const TexelImage diffuse{1, 1, {128, 0, 0, 77}};
    const TexelImage specular{2, 1, {0, 0, 0, 255, 255, 255, 255, 51}};
    const ConvertedTextures converted =
        convert_textures({glm::vec3(1.0f), glm::vec3(1.0f), 1.0f}, diffuse, specular);
    REQUIRE(converted.base_color.width == 2);
    CHECK(int(converted.base_color.rgba[0]) == Approx(130).margin(1)); // 128 / 0.96 in linear
    CHECK(int(converted.base_color.rgba[3]) == 77);
    CHECK(int(converted.metallic_roughness.rgba[1]) == 0);
    CHECK(int(converted.metallic_roughness.rgba[2]) == 0);
    CHECK(int(converted.base_color.rgba[4]) == 255);
    CHECK(int(converted.metallic_roughness.rgba[5]) == 204);
    CHECK(int(converted.metallic_roughness.rgba[6]) == 255);
}

TEST_CASE("a glTF file of specular-glossiness materials is converted, with a note") {
    ScratchFolder folder;
    folder.write("t.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    folder.write("blue.png", test::blue_png());
    const auto load = [&](const std::string& extension) {
        return load_scene(folder.write("s.gltf", R"({"asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"],
  "extensionsRequired": ["KHR_materials_pbrSpecularGlossiness"],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "materials": [{"extensions": {"KHR_materials_pbrSpecularGlossiness": {)" +
                                                     extension + R"(}}}],
  "textures": [{"source": 0}], "images": [{"uri": "blue.png"}],
  "buffers": [{"uri": "t.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}]})"));
    };
    const Scene plain = load(
        R"("diffuseFactor": [0.5, 0.25, 0, 1], "specularFactor": [0, 0, 0], "glossinessFactor": 0.25,
           "diffuseTexture": {"index": 0})");
    const Material& m = plain.materials.at(0);
    CHECK(m.base_color.r == Approx(0.5f / 0.96f));
    CHECK(m.metallic == 0.0f);
    CHECK(m.roughness == 0.75f);
    CHECK(m.base_color_texture == 0);
    CHECK_THAT(plain.notes.at(0), Catch::Contains("converted"));

    const Scene textured = load(R"("specularGlossinessTexture": {"index": 0})");
    const Material& t = textured.materials.at(0);
    CHECK(t.base_color == glm::vec3(1.0f));
    REQUIRE(t.metallic_roughness_texture != NO_TEXTURE);
    const Texture& other = textured.textures.at(size_t(t.metallic_roughness_texture));
    CHECK_FALSE(other.srgb);
    CHECK(int(other.image.rgba[1]) == 0); // glossiness is the alpha, 255
    CHECK(textured.textures.at(size_t(t.base_color_texture)).srgb);
}
