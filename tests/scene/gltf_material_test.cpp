// Materials, textures and images of glTF.
#include "gltf_quad.h"
#include "scene/phong.h"
#include "support/folders.h"

using namespace onde;
using namespace onde::test;
namespace fs = std::filesystem;

TEST_CASE(
    "glTF materials keep their factors, and a picture used for colour and data is stored once") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [{"name": "paint", "emissiveFactor": [0.5, 0.25, 0],
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.4,
      "roughnessFactor": 0.6, "baseColorTexture": {"index": 0},
      "metallicRoughnessTexture": {"index": 0}}}],
  "samplers": [{"wrapS": 33071, "wrapT": 33648}],
  "textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "blue.png"}])"));
    const Material& paint = scene.materials[scene.meshes[0].materials[0]];
    CHECK(paint.name == "paint");
    CHECK(paint.base_color == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(paint.metallic == 0.4f);
    CHECK(paint.roughness == 0.6f);
    CHECK(paint.emission == glm::vec3(2, 1, 0));
    REQUIRE(scene.textures.size() == 2);
    const Texture& color = scene.textures[size_t(paint.base_color_texture)];
    CHECK(color.srgb);
    const Texture& data = scene.textures[size_t(paint.metallic_roughness_texture)];
    CHECK_FALSE(data.srgb);
    CHECK(data.same_image_as == paint.base_color_texture);
    CHECK(data.image.rgba.empty());
    CHECK(color.wrap_u == Wrap::clamp);
    CHECK(color.wrap_v == Wrap::mirror);
    CHECK(color.image.rgba == std::vector<uint8_t>{64, 128, 255, 255});
}

TEST_CASE("of a texture's images the first that can be read counts") {
    for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp"}) {
        ScratchFolder folder;
        folder.write("quad.bin", quad_bytes());
        folder.write("blue.png", blue_png());
        folder.write("new.bin", "a format to come");
        const Scene scene = load_scene(
            folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)",
                                             R"(, "materials": [{"emissiveTexture": {"index": 0}}],
  "textures": [{"source": 1, "extensions": {")" + std::string(extension) +
                                                 R"(": {"source": 0}}}],
  "images": [{"uri": "new.bin"}, {"uri": "blue.png"}])")));
        REQUIRE(scene.textures.size() == 1);
        CHECK(scene.textures[0].image.rgba == std::vector<uint8_t>{64, 128, 255, 255});
        CHECK_FALSE(has_note(scene, "can't be read"));
    }
}

TEST_CASE("a file that several images name, by any spelling, is decoded once") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", blue_png());
    const auto path =
        folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "images": [{"uri": "blue.png"}, {"uri": "blue.png"}, {"uri": "./blue.png"}, {"uri": "%62lue.png"}],
  "textures": [{"source": 0}, {"source": 1}, {"source": 2}, {"source": 3}],
  "materials": [{"emissiveTexture": {"index": 0}, "normalTexture": {"index": 1},
                 "pbrMetallicRoughness": {"baseColorTexture": {"index": 2},
                                          "metallicRoughnessTexture": {"index": 3}}}])"));
    const Scene scene = load_scene(path);
    size_t decoded = 0;
    for (const Texture& texture : scene.textures) decoded += !texture.image.rgba.empty();
    CHECK(scene.textures.size() == 2); // of colours and of data
    CHECK(decoded == 1);
}

TEST_CASE("textures of materials that nothing in the scene shows are not read") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", blue_png());
    const std::string extra = R"(, "images": [{"uri": "blue.png"}, {"uri": "../no.png"}],
  "textures": [{"source": 0}, {"source": 1}],
  "materials": [{"name": "a", "emissiveTexture": {"index": 1}, "emissiveFactor": [1, 0, 0]},
                {"emissiveTexture": {"index": 0}}])";
    const Scene scene = load_scene(
        folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 1)", extra)));
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.textures[0].image.width == 1);
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].name == "a");
    CHECK(scene.materials[0].emission_texture == NO_TEXTURE);
    CHECK(scene.materials[1].emission_texture == 0);
    CHECK_THAT(load_error(folder.write("r.gltf",
                                       quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", extra))),
               Catch::Contains("leaves the scene's folder"));
}

TEST_CASE("of EXT_texture_webp's two images the WebP is taken, and the other where it can't be") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", blue_png());
    fs::copy(in_project("tests/data/fuzz/image/lossless.webp"), folder.path() / "a.webp");
    const auto width = [&](const char* image) {
        const Scene scene = load_scene(
            folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "extensionsUsed": ["EXT_texture_webp"], "materials": [{"emissiveTexture": {"index": 0}}],
  "textures": [{"source": 1, "extensions": {"EXT_texture_webp": {"source": 0}}}],
  "images": [{"uri": ")" + std::string(image) + R"("}, {"uri": "blue.png"}])")));
        REQUIRE(scene.textures.size() == 1);
        CHECK(scene.textures[0].name == image);
        CHECK_FALSE(has_note(scene, "EXT_texture_webp"));
        return scene.textures[0].image.width;
    };
    CHECK(width("a.webp") == 11);
    CHECK(width("missing.webp") == 1);
}

TEST_CASE("an image may not lie out of the folder, though it may be missing") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    CHECK_THAT(
        load_error(folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
  "images": [{"uri": "../other.png"}])"))),
        Catch::Contains("leaves the scene's folder"));
}

TEST_CASE("an image that no material uses is never decoded") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("bad.png", "this is no picture");
    const std::string extra = R"(, "textures": [{"source": 0}], "images": [{"uri": "bad.png"}])";
    CHECK(load_scene(folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", "", extra)))
              .textures.empty());
}

TEST_CASE("what transmits is a sheet, or with a volume a solid that absorbs") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [
    {"pbrMetallicRoughness": {"metallicFactor": 0},
     "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.75},
                    "KHR_materials_ior": {"ior": 1.33}}},
    {"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                    "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 3,
                                             "attenuationColor": [0.5, 0.25, 1]}}},
    {"extensions": {"KHR_materials_ior": {"ior": 0}}}, {}])"));
    const Material& sheet = scene.materials[0];
    CHECK(sheet.kind == MaterialKind::metallic_roughness);
    CHECK(sheet.ior == Approx(1.33f));
    CHECK(sheet.transmission == 0.75f);
    CHECK(sheet.thin_walled);
    CHECK_FALSE(sheet.attenuation_distance);
    CHECK(phong_of(scene, 0).transmission == 0.75f);
    const Material& solid = scene.materials[1];
    CHECK_FALSE(solid.thin_walled);
    CHECK(solid.attenuation_distance == 3.0f);
    CHECK(solid.attenuation_color == glm::vec3(0.5f, 0.25f, 1));
    CHECK(scene.materials[2].ior == 100); // stands for an index without end
    CHECK(scene.materials[3].transmission == 0);
}

TEST_CASE("layers and reflectances of glTF's extensions are read, and held to their ranges") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [{"extensions": {
    "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 0.5, 0]},
    "KHR_materials_clearcoat": {"clearcoatFactor": 0.75, "clearcoatRoughnessFactor": 0.25},
    "KHR_materials_sheen": {"sheenColorFactor": [0.5, 7, 1], "sheenRoughnessFactor": 0.5},
    "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5,
                                  "iridescenceThicknessMinimum": 50,
                                  "iridescenceThicknessMaximum": 800},
    "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 1.25},
    "KHR_materials_dispersion": {"dispersion": 0.75},
    "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 2,
                                           "diffuseTransmissionColorFactor": [1, 0.5, 0.25]}}}])"));
    const Material& m = scene.materials[0];
    CHECK(m.specular == 0.5f);
    CHECK(m.specular_color == glm::vec3(2, 0.5f, 0));
    CHECK(m.clearcoat == 0.75f);
    CHECK(m.clearcoat_roughness == 0.25f);
    CHECK(m.sheen_color == glm::vec3(0.5f, 1, 1));
    CHECK(m.sheen_roughness == 0.5f);
    CHECK(m.iridescence == 1);
    CHECK(m.iridescence_ior == 1.5f);
    CHECK(m.iridescence_thickness_minimum == 50);
    CHECK(m.iridescence_thickness == 800);
    CHECK(m.anisotropy == 0.5f);
    CHECK(m.anisotropy_rotation == 1.25f);
    CHECK(m.dispersion == 0.75f);
    CHECK(m.diffuse_transmission == 1);
    CHECK(m.diffuse_transmission_color == glm::vec3(1, 0.5f, 0.25f));
}

TEST_CASE("alpha modes, sides and unlit materials of glTF are kept") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [
    {"alphaMode": "BLEND", "doubleSided": true,
     "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.25]}},
    {"alphaMode": "MASK", "alphaCutoff": 0.75},
    {"alphaMode": "MASK", "emissiveFactor": [1, 1, 1],
     "extensions": {"KHR_materials_unlit": {}}}])"));
    CHECK(scene.materials[0].alpha_mode == AlphaMode::blend);
    CHECK(scene.materials[0].alpha == 0.25f);
    CHECK(scene.materials[0].double_sided);
    CHECK(scene.materials[1].alpha_mode == AlphaMode::mask);
    CHECK(scene.materials[1].alpha_cutoff == 0.75f);
    CHECK_FALSE(scene.materials[1].double_sided);
    CHECK(scene.materials[2].alpha_cutoff == 0.5f);
    CHECK(scene.materials[2].kind == MaterialKind::unlit);
    CHECK(scene.materials[2].emission == glm::vec3(0));
}

TEST_CASE("a glTF texture has the filter, the set and the transform of its use") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "extensionsRequired": ["KHR_texture_transform"],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 3,
      "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "scale": [2, 3],
                                               "rotation": 1.5707963267948966, "texCoord": 1}}}},
    "emissiveTexture": {"index": 0, "texCoord": 2}}],
  "samplers": [{"magFilter": 9728}],
  "textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "blue.png"}])"));
    REQUIRE(scene.textures.size() == 2);
    const Texture& base = scene.textures[size_t(scene.materials[0].base_color_texture)];
    CHECK(base.filter == TextureFilter::nearest);
    CHECK(base.uv_set == 1);
    // Scaled to (2, 6), turned to (6, -2), moved.
    CHECK(glm::length(base.transform({1, 2}) - glm::vec2(6.5f, -2)) < 1e-5f);
    const Texture& glow = scene.textures[size_t(scene.materials[0].emission_texture)];
    CHECK(glow.uv_set == 2);
    CHECK(glow.transform == UvTransform{});
    CHECK(glow.same_image_as == 0);
}

TEST_CASE("sets of texture coordinates are read where a texture uses them") {
    const auto uvs = [](const std::string& material) {
        std::string gltf = quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)",
                                     R"(,
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0)" +
                                         material + R"(}}}],
  "textures": [{"source": 0}], "images": [{"uri": "blue.png"}])");
        gltf.replace(gltf.find("\"TEXCOORD_0\""), 12, "\"TEXCOORD_2\": 2, \"TEXCOORD_0\"");
        return load_quad(gltf).meshes[0].more_uvs;
    };
    CHECK(uvs("").empty());
    REQUIRE(uvs(R"(, "texCoord": 2)").size() == 2);
    CHECK(uvs(R"(, "texCoord": 2)")[1][1] == glm::vec2(1, 1));
}
