// Compressed files hold the same geometry as plain ones.
#include "scene/gltf/meshopt.h"
#include "scratch.h"
#include "support/assets.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>

using namespace onde;
using onde::test::bytes_of;
using onde::test::ScratchFolder;

namespace {

/// What a compression that reorders and rounds must keep: integrals over the surface.
struct Surface {
    size_t triangles = 0;
    double area = 0.0;
    glm::dvec3 center{0.0}, normal{0.0}; ///< sums, weighted by area
    glm::dvec2 uv{0.0};
    SceneBounds bounds;
};

Surface surface_of(const Scene& scene) {
    Surface surface;
    surface.bounds = scene_bounds(scene);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        const glm::dmat4 to_world(instance.object_to_world);
        const glm::dmat3 of_normals = glm::transpose(glm::inverse(glm::dmat3(to_world)));
        for (const glm::uvec3& triangle : mesh.triangles) {
            glm::dvec3 p[3];
            for (size_t c = 0; c < 3; ++c)
                p[c] = glm::dvec3(to_world * glm::dvec4(mesh.positions[triangle[c]], 1.0));
            const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
            ++surface.triangles;
            surface.area += area;
            surface.center += area / 3.0 * (p[0] + p[1] + p[2]);
            for (size_t c = 0; c < 3; ++c) {
                if (!mesh.uvs.empty()) surface.uv += area / 3.0 * glm::dvec2(mesh.uvs[triangle[c]]);
                if (!mesh.normals.empty())
                    surface.normal += area / 3.0 *
                                      glm::abs(glm::normalize(
                                          of_normals * glm::dvec3(mesh.normals[triangle[c]])));
            }
        }
    }
    return surface;
}

/// Coordinates of textures that were quantised are those of the plain model only with the texture
/// transform that their material has.
void check_same(const Scene& plain, const Scene& compressed, bool same_uvs) {
    constexpr double tolerance = 1e-3;
    const Surface a = surface_of(plain), b = surface_of(compressed);
    const double size = glm::length(glm::dvec3(a.bounds.high - a.bounds.low));
    CHECK(a.triangles == b.triangles);
    CHECK(b.area == Approx(a.area).epsilon(4 * tolerance));
    CHECK(glm::length(a.center - b.center) < tolerance * size * a.area);
    CHECK(glm::length(a.normal - b.normal) < 10 * tolerance * a.area);
    if (same_uvs) CHECK(glm::length(a.uv - b.uv) < 2 * tolerance * a.area);
    CHECK(glm::length(a.bounds.low - b.bounds.low) < 2 * tolerance * size);
    CHECK(glm::length(a.bounds.high - b.bounds.high) < 2 * tolerance * size);
}

std::string gltf_of_view(const std::string& view, size_t compressed, size_t plain) {
    return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_meshopt_compression"],
  "extensionsRequired": ["KHR_meshopt_compression"],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "buffers": [{"uri": "c.bin", "byteLength": )" +
           std::to_string(compressed) + R"(}, {"byteLength": )" + std::to_string(plain) + R"(}],
  "bufferViews": [{"buffer": 1, "byteLength": )" +
           std::to_string(plain) + R"(, "extensions": {"KHR_meshopt_compression":
      {"buffer": 0, "byteLength": )" +
           std::to_string(compressed) + ", " + view + R"(}}}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": )" +
           std::to_string(plain / 12) + "}]}";
}

/// A wavy row of `count` points, three a triangle.
std::vector<float> wavy_points(size_t count) {
    std::vector<float> values;
    for (size_t i = 0; i < count; ++i)
        for (float value : {float(i) * 0.25f, float(i % 7), float(i % 3) - 1.0f})
            values.push_back(value);
    return values;
}

} // namespace

TEST_CASE("Draco, quantised and meshopt variants of sample models have the plain one's surface") {
    struct Case {
        const char *plain, *compressed;
        bool same_uvs = true;
    };
    const Case cases[] = {
        {"Box/glTF-Binary/Box.glb", "Box/glTF-Draco/Box.gltf"},
        {"Duck/glTF-Binary/Duck.glb", "Duck/glTF-Draco/Duck.gltf"},
        {"Duck/glTF-Binary/Duck.glb", "Duck/glTF-Quantized/Duck.gltf", false},
        {"CesiumMan/glTF-Binary/CesiumMan.glb", "CesiumMan/glTF-Draco/CesiumMan.gltf"},
        {"MorphPrimitivesTest/glTF-Binary/MorphPrimitivesTest.glb",
         "MorphPrimitivesTest/glTF-Draco/MorphPrimitivesTest.gltf"},
        {"BoxTextured/glTF-Binary/BoxTextured.glb", "loaders.gl/meshopt/BoxTextured_meshopt.glb",
         false},
    };
    for (const Case& c : cases) {
        const auto plain = test::find_asset(std::string("gltf/") + c.plain);
        const auto compressed = test::find_asset(std::string("gltf/") + c.compressed);
        if (!plain || !compressed) return;
        INFO(c.compressed);
        check_same(load_scene(*plain), load_scene(*compressed), c.same_uvs);
    }
}

TEST_CASE("all modes, filters and versions of meshopt make the same cube of a test model") {
    const auto path = test::find_asset(
        "gltf/loaders.gl/meshopt/MeshoptCubeTest/glTF-Meshopt/MeshoptCubeTest.gltf");
    if (!path) return;
    const Scene scene = load_scene(*path);
    const auto is_cube = [](const Mesh& mesh) { return mesh.name.starts_with("Cube_"); };
    const auto first = std::ranges::find_if(scene.meshes, is_cube);
    REQUIRE(std::ranges::count_if(scene.meshes, is_cube) == 25);
    for (const Mesh& mesh : scene.meshes) {
        if (!is_cube(mesh)) continue;
        INFO(mesh.name);
        REQUIRE(mesh.positions.size() == 24);
        REQUIRE(mesh.triangles.size() == 12);
        std::vector<float> corners[2];
        const Mesh* pair[2] = {&*first, &mesh};
        for (size_t m = 0; m < 2; ++m)
            for (const glm::uvec3& t : pair[m]->triangles)
                for (size_t c = 0; c < 3; ++c)
                    for (size_t k = 0; k < 3; ++k) {
                        corners[m].push_back(pair[m]->positions[t[c]][k]);
                        corners[m].push_back(pair[m]->normals[t[c]][k]);
                    }
        for (auto& list : corners) std::ranges::sort(list);
        for (size_t i = 0; i < corners[0].size(); ++i)
            REQUIRE(corners[1][i] == Approx(corners[0][i]).margin(0.02));
    }
}

TEST_CASE("a view that meshopt compressed is read, whatever its fallback buffer holds") {
    const std::vector<float> points = wavy_points(300);
    const size_t count = points.size() / 3;
    std::string bytes(meshopt_encodeVertexBufferBound(count, 12), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                            bytes.size(), points.data(), count, 12));
    const std::string view = R"("byteStride": 12, "mode": "ATTRIBUTES", "count": 300)";
    ScratchFolder folder;
    folder.write("c.bin", bytes);
    const auto path = folder.write("c.gltf", gltf_of_view(view, bytes.size(), 3600));
    const Scene scene = load_scene(path);
    REQUIRE(scene.meshes.at(0).positions.size() == 300);
    for (size_t i = 0; i < count; ++i)
        REQUIRE(scene.meshes[0].positions[i] ==
                glm::vec3(points[3 * i], points[3 * i + 1], points[3 * i + 2]));

    for (size_t size : {size_t(0), size_t(1), size_t(40), bytes.size() - 1}) {
        folder.write("c.bin", bytes.substr(0, size));
        CHECK_THAT(test::load_error(folder.write("w.gltf", gltf_of_view(view, size, 3600))),
                   Catch::Contains("buffer view 0") &&
                       Catch::Contains("meshopt compression is damaged"));
    }
    folder.write("c.bin", bytes);
    for (const char* wrong :
         {R"("byteStride": 10, "mode": "ATTRIBUTES", "count": 300)",
          R"("byteStride": 12, "mode": "TRIANGLES", "count": 300)",
          R"("byteStride": 12, "mode": "INDICES", "count": 300)",
          R"("byteStride": 12, "mode": "ATTRIBUTES", "filter": "QUATERNION", "count": 300)"})
        CHECK_THAT(
            test::load_error(folder.write("w.gltf", gltf_of_view(wrong, bytes.size(), 3600))),
            Catch::Contains("damaged"));
    const std::string huge = R"("byteStride": 12, "mode": "ATTRIBUTES", "count": 4000000000000)";
    CHECK_THAT(test::load_error(folder.write("w.gltf", gltf_of_view(huge, bytes.size(), 3600))),
               Catch::Contains("--load-limit"));
}

TEST_CASE("meshopt's attribute streams of version 1 are decoded as specified") {
    // One channel of 20 elements: byte 0 in 1-bit deltas, byte 1 literally, byte 2 in 4-bit deltas
    // of the specification's example, byte 3 without deltas.
    const uint8_t control = 1 << 0 | 3 << 2 | 1 << 4 | 2 << 6;
    std::vector<uint8_t> stream{0xa1, control};
    const auto add = [&](std::initializer_list<int> bytes) {
        for (int byte : bytes) stream.push_back(uint8_t(byte));
    };
    add({0x00});                           // byte 0: both groups in 1 bit
    add({0x02, 0x00, 6});                  // element 1: 6, which is +3
    add({0x00, 0x00});                     // no more
    for (int i = 0; i < 20; ++i) add({2}); // byte 1: +1 each
    add({0x2 | 0x0 << 2});                 // byte 2: 4-bit deltas, then 1-bit ones
    add({0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5, 0x00, 0x00});
    for (int i = 0; i < 24 - 5; ++i) add({0}); // padding
    add({10, 20, 30, 40, 0});                  // the baseline, and the channel's mode
    std::vector<uint8_t> result(80);
    REQUIRE(gltf::decode_meshopt_attributes(stream, 20, 4, result.data()));
    const int deltas[20] = {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0, 0, 0, 0, 0};
    int third = 30;
    for (int i = 0; i < 20; ++i) {
        third += deltas[i];
        CHECK(int(result[size_t(4 * i)]) == (i < 1 ? 10 : 13));
        CHECK(int(result[size_t(4 * i + 1)]) == 21 + i);
        CHECK(int(result[size_t(4 * i + 2)]) == (third & 255));
        CHECK(int(result[size_t(4 * i + 3)]) == 40);
    }
    CHECK_FALSE(gltf::decode_meshopt_attributes(stream, 40, 4, result.data()));
    for (size_t cut = 0; cut < stream.size(); ++cut)
        CHECK_FALSE(
            gltf::decode_meshopt_attributes(std::span(stream).first(cut), 20, 4, result.data()));
    stream.back() = 3; // no such mode
    CHECK_FALSE(gltf::decode_meshopt_attributes(stream, 20, 4, result.data()));
}

TEST_CASE("meshopt's words of 16 and 32 bits are decoded as specified") {
    const auto decode = [](std::initializer_list<int> literal, uint8_t mode) {
        std::vector<uint8_t> stream{0xa1, 0xff};
        for (int byte : literal) stream.push_back(uint8_t(byte));
        stream.resize(stream.size() + 19);
        stream.insert(stream.end(), {0x00, 0x01, 0x00, 0x00});
        stream.push_back(mode);
        std::vector<uint8_t> result(8);
        REQUIRE(gltf::decode_meshopt_attributes(stream, 2, 4, result.data()));
        return result;
    };
    // Bytes lie by position: both elements' first, then both's second, ...
    // 16 bits: 256 - 1, then + 256; 0 + 0, then 0 - 2.
    CHECK(decode({1, 0, 0, 2, 0, 3, 0, 0}, 1) ==
          std::vector<uint8_t>{0xff, 0, 0, 0, 0xff, 1, 0xfe, 0xff});
    // 32 bits: 0x100 ^ (0x120 rotated back by 4), then unchanged.
    CHECK(decode({0x20, 0, 0x01, 0, 0, 0, 0, 0}, 0x42) ==
          std::vector<uint8_t>{0x12, 0x01, 0, 0, 0x12, 0x01, 0, 0});
}

TEST_CASE("a primitive that Draco compressed is read, and damaged ones are refused") {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const float p[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 5}};
    for (int f = 0; f < 2; ++f)
        builder.SetAttributeValuesForFace(positions, draco::FaceIndex(uint32_t(f)), p[3 * f],
                                          p[3 * f + 1], p[3 * f + 2]);
    const auto mesh = builder.Finalize();
    const auto write = [&](int speed, std::string& bytes) {
        draco::Encoder encoder;
        encoder.SetSpeedOptions(speed, speed);
        draco::EncoderBuffer buffer;
        REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
        bytes.assign(buffer.data(), buffer.size());
    };
    const auto gltf = [](size_t size) {
        return R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_draco_mesh_compression"],
  "extensionsRequired": ["KHR_draco_mesh_compression"], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "extensions":
    {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]}],
  "buffers": [{"uri": "d.bin", "byteLength": )" +
               std::to_string(size) + R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" +
               std::to_string(size) + R"(}],
  "accessors": [{"componentType": 5126, "type": "VEC3", "count": 4},
                {"componentType": 5125, "type": "SCALAR", "count": 6}]})";
    };
    for (int speed : {0, 10}) { // by edges, and in sequence
        std::string bytes;
        write(speed, bytes);
        ScratchFolder folder;
        folder.write("d.bin", bytes);
        const auto path = folder.write("d.gltf", gltf(bytes.size()));
        const Scene scene = load_scene(path);
        CHECK(scene.meshes.at(0).triangles.size() == 2);
        CHECK(scene_bounds(scene).high == glm::vec3(1, 1, 5));
        CHECK(surface_of(scene).area == Approx(0.5 + 0.5 * std::sqrt(51.0)));
        for (size_t cut : {size_t(0), size_t(9), size_t(12), bytes.size() - 1}) {
            folder.write("d.bin", bytes.substr(0, cut));
            const std::string error = test::load_error(folder.write("cut.gltf", gltf(cut)));
            CHECK_THAT(error, Catch::Contains("cut.gltf: mesh 0 primitive 0") &&
                                  Catch::Contains("Draco compression is damaged"));
        }
        std::string claims = bytes; // 2^28 faces in a few bytes
        claims.replace(speed ? 11 : 12, 2, "\xff\xff\xff\x7f");
        folder.write("d.bin", claims);
        CHECK_THAT(test::load_error(folder.write("lie.gltf", gltf(claims.size()))),
                   Catch::Contains("damaged"));
    }
}
