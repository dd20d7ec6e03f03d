#include "scene/load.h"
#include "scene/phong.h"
#include "scratch.h"

#include <cmath>

using namespace onde;
using onde::test::bytes_of;
using onde::test::ScratchFolder;
namespace fs = std::filesystem;

namespace {

/// A quad of 4 positions (48 bytes), then 6 16-bit indices (12 bytes), then 4 uvs (32 bytes).
std::string quad_bytes() {
    return bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
           bytes_of<uint16_t>({0, 1, 2, 0, 2, 3}) + bytes_of<float>({0, 1, 1, 1, 1, 0, 0, 0});
}

/// A glTF file of that quad; `extra` goes into the root, `primitive` into its primitive, `nodes` is
/// the list of nodes, all of them roots.
std::string quad_gltf(const std::string& nodes = R"([{"mesh": 0}])",
                      const std::string& primitive = "", const std::string& extra = "",
                      const std::string& roots = "[0]") {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": )" + roots +
           R"(}], "nodes": )" + nodes + R"(, "meshes": [{"primitives": [{"indices": 1)" +
           primitive +
           R"(, "attributes": {"POSITION": 0, "TEXCOORD_0": 2}}]}],
  "buffers": [{"uri": "quad.bin", "byteLength": 92}],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                  {"buffer": 0, "byteOffset": 60, "byteLength": 32}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}])" +
           extra + "}";
}

Scene load_quad(const std::string& gltf) {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", test::blue_png());
    return load_scene(folder.write("quad.gltf", gltf));
}

bool has_note(const Scene& scene, const std::string& text) {
    for (const std::string& note : scene.notes)
        if (note.find(text) != std::string::npos) return true;
    return false;
}

/// A mesh of the given floats as non-indexed positions in that primitive mode.
Scene load_positions(std::initializer_list<float> positions, int mode) {
    ScratchFolder folder;
    folder.write("p.bin", bytes_of<float>(positions));
    const std::string bytes = std::to_string(positions.size() * 4);
    return load_scene(
        folder.write("p.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" +
                                   std::to_string(mode) + R"(}]}],
  "buffers": [{"uri": "p.bin", "byteLength": )" +
                                   bytes + R"(}],
  "bufferViews": [{"buffer": 0, "byteLength": )" +
                                   bytes + R"(}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
                                   std::to_string(positions.size() / 3) + "}]}"));
}

} // namespace

TEST_CASE("an indexed glTF quad becomes two triangles with its positions and uvs") {
    const Scene scene = load_quad(quad_gltf());
    REQUIRE(scene.meshes.size() == 1);
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)});
    CHECK(mesh.positions[2] == glm::vec3(1, 1, 0));
    CHECK(mesh.uvs[3] == glm::vec2(0, 0));
    CHECK(mesh.normals.empty());
    CHECK(scene.materials[mesh.materials[0]].kind == MaterialKind::metallic_roughness);
}

TEST_CASE("children inherit their parents' translation, rotation and scale") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"children": [1], "translation": [10, 0, 0]},
            {"mesh": 0, "rotation": [0, 0, 0.70710678, 0.70710678], "scale": [2, 3, 4]}])"));
    REQUIRE(scene.instances.size() == 1);
    // Scale first: (1, 1, 1) -> (2, 3, 4); a quarter turn about Z: (-3, 2, 4); then moved.
    const glm::vec3 moved(scene.instances[0].object_to_world * glm::vec4(1, 1, 1, 1));
    CHECK(glm::length(moved - glm::vec3(7, 2, 4)) < 1e-5f);
}

TEST_CASE("two nodes with one mesh are two instances of it") {
    const Scene scene = load_quad(
        quad_gltf(R"([{"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]}])", "", "", "[0, 1]"));
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 2);
    CHECK(glm::determinant(scene.instances[1].object_to_world) == Approx(-1.0));
}

TEST_CASE("triangle strips turn every second triangle and fans share their first vertex") {
    const auto points = {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f};
    const Scene strip = load_positions(points, 5), fan = load_positions(points, 6);
    CHECK(strip.meshes[0].triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(1, 3, 2)});
    CHECK(fan.meshes[0].triangles == std::vector{glm::uvec3(1, 2, 0), glm::uvec3(2, 3, 0)});
}

TEST_CASE("normalised integer texture coordinates become fractions") {
    ScratchFolder folder;
    folder.write("m.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                              bytes_of<uint8_t>({0, 255, 0, 0, 51, 0, 0, 0, 255, 255, 0, 0}));
    const Scene scene = load_scene(folder.write("m.gltf", R"({"asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
  "buffers": [{"uri": "m.bin", "byteLength": 48}],
  "bufferViews": [{"buffer": 0, "byteLength": 36},
                  {"buffer": 0, "byteOffset": 36, "byteLength": 12, "byteStride": 4}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC2",
                 "normalized": true}]})"));
    CHECK(scene.meshes[0].uvs[0] == glm::vec2(0, 1));
    CHECK(scene.meshes[0].uvs[1].x == Approx(0.2f));
    CHECK(scene.meshes[0].uvs[2] == glm::vec2(1, 1));
}

TEST_CASE("a sparse accessor replaces the elements that it names") {
    std::string gltf = quad_gltf();
    const std::string view =
        R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3")";
    // Index 2 (the third 16-bit index of the file) gets the second position (1, 0, 0).
    gltf.replace(gltf.find(view), view.size(), view + R"(, "sparse": {"count": 1,
        "indices": {"bufferView": 1, "byteOffset": 4, "componentType": 5123},
        "values": {"bufferView": 0, "byteOffset": 12}})");
    const Scene scene = load_quad(gltf);
    CHECK(scene.meshes[0].positions[2] == glm::vec3(1, 0, 0));
    CHECK(scene.meshes[0].positions[3] == glm::vec3(0, 1, 0));
}

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
        folder.write("blue.png", test::blue_png());
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
    folder.write("blue.png", test::blue_png());
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
    folder.write("blue.png", test::blue_png());
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
    CHECK_THAT(test::load_error(folder.write(
                   "r.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", extra))),
               Catch::Contains("leaves the scene's folder"));
}

TEST_CASE("of EXT_texture_webp's two images the WebP is taken, and the other where it can't be") {
    ScratchFolder folder;
    folder.write("quad.bin", quad_bytes());
    folder.write("blue.png", test::blue_png());
    fs::copy(std::string(ONDE_SOURCE_DIR) + "/tests/data/fuzz/image/lossless.webp",
             folder.path() / "a.webp");
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
    CHECK_THAT(test::load_error(
                   folder.write("q.gltf", quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
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

TEST_CASE("untextured transmission above one half becomes glass with its index of refraction") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0}])", R"(, "material": 0)", R"(,
  "materials": [{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                "KHR_materials_ior": {"ior": 1.33}}}])"));
    CHECK(scene.materials[0].kind == MaterialKind::dielectric);
    CHECK(scene.materials[0].ior == Approx(1.33f));
    CHECK(phong_of(scene, 0).transmission == 1);
    CHECK(has_note(scene, "glass"));
}

TEST_CASE("unknown optional extensions are reported in notes") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}])", "", R"(, "extensionsUsed": ["EXT_shiny"])"));
    CHECK(has_note(scene, "EXT_shiny"));
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

/// A triangle with an attribute of four elements a vertex, of that component type.
static Mesh with_attribute(const std::string& name, const std::string& bytes, int type,
                           const std::string& elements, const std::string& normalized) {
    ScratchFolder folder;
    folder.write("a.bin",
                 bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}) + bytes);
    return load_scene(folder.write("a.gltf", R"({"asset": {"version": "2.0"},
  "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, ")" +
                                                 name + R"(": 2}}]}],
  "buffers": [{"uri": "a.bin", "byteLength": )" + std::to_string(72 + bytes.size()) +
                                                 R"(}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
                  {"buffer": 0, "byteOffset": 72, "byteLength": )" +
                                                 std::to_string(bytes.size()) +
                                                 R"(}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
                {"bufferView": 2, "componentType": )" +
                                                 std::to_string(type) +
                                                 R"(, "count": 3, "type": ")" + elements + "\"" +
                                                 normalized + "}]}"))
        .meshes[0];
}

TEST_CASE("vertex colours of glTF have three or four numbers, of any normalised type") {
    const auto mesh =
        with_attribute("COLOR_0", bytes_of<uint8_t>({0, 51, 255, 51, 0, 0, 0, 0, 0, 0, 0, 0}), 5121,
                       "VEC4", R"(, "normalized": true)");
    REQUIRE(mesh.colors.size() == 3);
    CHECK(mesh.colors[0] == glm::vec4(0, 0.2f, 1, 0.2f));
    const auto floats = with_attribute(
        "COLOR_0", bytes_of<float>({0.5f, 0.25f, 1, 0, 0, 0, 0, 0, 0}), 5126, "VEC3", "");
    CHECK(floats.colors[0] == glm::vec4(0.5f, 0.25f, 1, 1));
    // An exporter that forgot to say that they are normalised.
    const auto forgot = with_attribute(
        "COLOR_0", bytes_of<uint16_t>({65535, 0, 13107, 65535, 0, 0, 0, 0, 0, 0, 0, 0}), 5123,
        "VEC4", "");
    CHECK(glm::length(forgot.colors[0] - glm::vec4(1, 0, 0.2f, 1)) < 1e-6f);
}

TEST_CASE("tangents of glTF are read, and those that are none are left to be computed") {
    const float nan = std::nanf("");
    const auto mesh = with_attribute(
        "TANGENT", bytes_of<float>({0, 1, 0, -1, 0, 0, 0, 1, nan, 0, 0, 1}), 5126, "VEC4", "");
    REQUIRE(mesh.tangents.size() == 3);
    CHECK(mesh.tangents[0] == glm::vec4(0, 1, 0, -1));
    CHECK(mesh.tangents[1] == glm::vec4(0));
    CHECK(mesh.tangents[2] == glm::vec4(0));
}

TEST_CASE("a glTF camera keeps its field of view and loses its node's scale") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"mesh": 0}, {"camera": 0, "translation": [1, 2, 3], "scale": [5, 5, 5]}])", "",
        R"(, "cameras": [{"type": "perspective", "name": "front",
                          "perspective": {"yfov": 0.5, "znear": 0.1}}])",
        "[0, 1]"));
    REQUIRE(scene.cameras.size() == 1);
    CHECK(scene.cameras[0].name == "front");
    CHECK(scene.cameras[0].vertical_fov == 0.5f);
    CHECK(scene.cameras[0].camera_to_world[0] == glm::vec4(1, 0, 0, 0));
    CHECK(scene.cameras[0].camera_to_world[3] == glm::vec4(1, 2, 3, 1));
}

TEST_CASE("punctual lights shine from their nodes, directional ones along -Z") {
    const Scene scene = load_quad(quad_gltf(
        R"([{"mesh": 0},
            {"translation": [0, 5, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"extensions": {"KHR_lights_punctual": {"light": 1}}},
            {"translation": [0, 7, 0], "extensions": {"KHR_lights_punctual": {"light": 2}}}])",
        "", R"(, "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual":
            {"lights": [{"type": "point", "color": [1, 0.5, 0], "intensity": 8},
                        {"type": "directional", "intensity": 2},
                        {"type": "spot", "intensity": 3, "spot": {"innerConeAngle": 0.1,
                         "outerConeAngle": 0.5}}]}})",
        "[0, 1, 2, 3]"));
    REQUIRE(scene.spot_lights.size() == 1);
    CHECK(scene.spot_lights[0].position == glm::vec3(0, 7, 0));
    CHECK(scene.spot_lights[0].back == glm::vec3(0, 0, 1));
    CHECK(scene.spot_lights[0].intensity == glm::vec3(3));
    CHECK(scene.spot_lights[0].inner_angle == 0.1f);
    CHECK(scene.spot_lights[0].half_angle == 0.5f);
    REQUIRE(scene.point_lights.size() == 1);
    CHECK(scene.point_lights[0].position == glm::vec3(0, 5, 0));
    CHECK(scene.point_lights[0].intensity == glm::vec3(8, 4, 0));
    REQUIRE(scene.directional_lights.size() == 1);
    CHECK(scene.directional_lights[0].to_light == glm::vec3(0, 0, 1));
    CHECK(scene.directional_lights[0].irradiance == glm::vec3(2));
    CHECK(scene.environment.map); // the studio, since the file has no camera
}

TEST_CASE("triangles without area load with a note") {
    const Scene scene = load_positions({0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 4);
    CHECK(scene.meshes[0].triangles.size() == 2);
    CHECK(has_note(scene, "without area"));
}

TEST_CASE("an object that is scaled to nothing is skipped with a note") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0]}])", "", "", "[0, 1]"));
    CHECK(scene.instances.size() == 1);
    CHECK(has_note(scene, "skipped"));
}

TEST_CASE("an orthographic glTF camera keeps the height of its view") {
    const Scene scene =
        load_quad(quad_gltf(R"([{"mesh": 0}, {"camera": 0}])", "",
                            R"(, "cameras": [{"type": "orthographic", "orthographic":
                     {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}}])",
                            "[0, 1]"));
    REQUIRE(scene.cameras.size() == 1);
    CHECK(scene.cameras[0].orthographic_height == 4.0f);
}

TEST_CASE("a matrix whose last row is rounded is taken as affine") {
    const Scene scene = load_quad(quad_gltf(R"([{"mesh": 0, "matrix":
        [2, 0, 0, 1e-7, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 0.999999]}])"));
    const glm::mat4& m = scene.instances.at(0).object_to_world;
    CHECK(m[0] == glm::vec4(2, 0, 0, 0));
    CHECK(m[3] == glm::vec4(1, 2, 3, 1));
}

TEST_CASE("a plus in a URI is a plus, and a file may be longer than its buffer") {
    ScratchFolder folder;
    folder.write("a+b#c.bin", quad_bytes() + "spare");
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("quad.bin"), 8, "a+b%23c.bin");
    CHECK(load_scene(folder.write("q.gltf", gltf)).instances.size() == 1);
}

TEST_CASE("data URIs may have any media type, parameters and either coding") {
    // A triangle (0 0 0), (1 0 0), (0 1 0).
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    std::string escaped;
    for (unsigned char c : bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0})) {
        char text[4];
        std::snprintf(text, sizeof(text), "%%%02x", unsigned(c));
        escaped += text;
    }
    for (const std::string& uri :
         {"data:application/octet-stream;base64," + base64, "data:;base64," + base64,
          "data:model/x;charset=utf-8;x=\\\"1\\\";base64," + base64,
          "data:application/gltf-buffer," + escaped, "data:," + escaped}) {
        INFO(uri);
        ScratchFolder folder;
        const Scene scene = load_scene(folder.write("d.gltf", R"({"asset": {"version": "2.0"},
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "buffers": [{"byteLength": 36, "uri": ")" + uri + R"("}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}]})"));
        CHECK(scene.meshes.at(0).positions.at(2) == glm::vec3(0, 1, 0));
    }
}

TEST_CASE("whole numbers may be written with a fraction of zero") {
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("\"count\": 4"), 10, "\"count\": 4.0");
    CHECK(load_quad(gltf).meshes.at(0).positions.size() == 4);
}

TEST_CASE("what nothing uses may be missing") {
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("\"buffers\": ["), 12, "\"buffers\": [");
    const size_t end = gltf.find("}],\n  \"bufferViews\"");
    gltf.insert(end + 1, R"(, {"uri": "nowhere.bin", "byteLength": 4})");
    CHECK(load_quad(gltf).instances.size() == 1);
}

TEST_CASE("names with spaces and percent signs are decoded") {
    ScratchFolder folder;
    folder.write("my quad+.bin", quad_bytes());
    std::string gltf = quad_gltf();
    gltf.replace(gltf.find("quad.bin"), 8, "my%20quad%2B.bin");
    CHECK(load_scene(folder.write("q.gltf", gltf)).instances.size() == 1);
}
