// What a PLY file says, in each encoding, is what the scene holds.
#include "scratch.h"

#include <algorithm>

using namespace onde;
using onde::test::ScratchFolder;

namespace {

const std::string POSITIONS = "property float x\nproperty float y\nproperty float z\n";
const std::string FACES = "element face 1\nproperty list uchar int vertex_indices\n";

std::string ascii(const std::string& declarations, const std::string& values) {
    return "ply\nformat ascii 1.0\n" + declarations + "end_header\n" + values;
}

Scene load_ply_bytes(const std::string& bytes) {
    ScratchFolder folder;
    return load_scene(folder.write("a.ply", bytes));
}

Mesh mesh_of(const std::string& bytes) {
    return load_ply_bytes(bytes).meshes.at(0);
}

/// A triangle with something to skip before, in and after everything that counts; `bytes` writes a
/// number in the file's order.
template <class Bytes>
std::string binary_triangle(const std::string& encoding, Bytes bytes) {
    std::string file = "ply\nformat " + encoding +
                       " 1.0\ncomment made by a test\nobj_info nothing\n"
                       "element material 2\nproperty list ushort double weights\n"
                       "property short id\nelement vertex 3\nproperty uchar red\n"
                       "property double x\nproperty short y\nproperty float z\n"
                       "element face 1\nproperty list uint8 uint32 neighbours\n"
                       "property list int32 ushort vertex_index\nproperty float quality\n"
                       "element edge 1\nproperty int a\nend_header\n";
    file += bytes(uint16_t(2)) + bytes(1.5) + bytes(2.5) + bytes(int16_t(7));
    file += bytes(uint16_t(0)) + bytes(int16_t(-7));
    for (int i = 0; i < 3; ++i)
        file += bytes(uint8_t(200)) + bytes(i == 1 ? -0.5 : 0.0) +
                bytes(int16_t(i == 2 ? -300 : 0)) + bytes(0.25f);
    file += bytes(uint8_t(1)) + bytes(uint32_t(99));
    file += bytes(int32_t(3)) + bytes(uint16_t(2)) + bytes(uint16_t(1)) + bytes(uint16_t(0));
    return file + bytes(1.0f) + bytes(int32_t(5));
}

const auto little_endian = [](auto value) { return test::bytes_of({value}); };
const auto big_endian = [](auto value) {
    std::string bytes = test::bytes_of({value});
    std::ranges::reverse(bytes);
    return bytes;
};

} // namespace

TEST_CASE("an ASCII quad is two triangles of diffuse grey") {
    const Scene scene = load_ply_bytes(
        ascii("element vertex 4\n" + POSITIONS + FACES, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.name == "a");
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)});
    CHECK(mesh.normals.empty());
    CHECK(scene.materials.at(mesh.materials[1]).kind == MaterialKind::diffuse);
    CHECK(scene.materials.at(mesh.materials[1]).base_color == glm::vec3(0.8f));
}

TEST_CASE("both byte orders hold the same triangle, and what we don't use is skipped with a note") {
    const std::string files[] = {binary_triangle("binary_little_endian", little_endian),
                                 binary_triangle("binary_big_endian", big_endian)};
    for (const std::string& file : files) {
        const Scene scene = load_ply_bytes(file);
        const Mesh& mesh = scene.meshes[0];
        CHECK(mesh.positions[0] == glm::vec3(0, 0, 0.25f));
        CHECK(mesh.positions[1] == glm::vec3(-0.5f, 0, 0.25f));
        CHECK(mesh.positions[2] == glm::vec3(0, -300, 0.25f));
        CHECK(mesh.triangles == std::vector{glm::uvec3(2, 1, 0)});
        REQUIRE(scene.notes.size() >= 2);
        CHECK_THAT(scene.notes[0], Catch::Contains("material and 1 more"));
        CHECK_THAT(scene.notes[1], Catch::Contains("red"));
    }
}

TEST_CASE("PLY normals are made unit and v is turned downward, by any of its names") {
    for (const auto& [u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}}) {
        const std::string uvs = std::string("property float ") + u + "\nproperty float " + v + "\n";
        const Mesh mesh = mesh_of(
            ascii("element vertex 3\n" + POSITIONS +
                      "property float nx\nproperty float ny\nproperty float nz\n" + uvs + FACES,
                  "0 0 0 0 0 2 0 0\n1 0 0 0 3 0 1 0.25\n0 1 0 1 0 0 0 1\n3 0 1 2\n"));
        CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
        CHECK(mesh.normals[1] == glm::vec3(0, 1, 0));
        CHECK(mesh.uvs[1] == glm::vec2(1, 0.75f));
    }
}

TEST_CASE("PLY normals without nz are no normals") {
    const Mesh mesh = mesh_of(
        ascii("element vertex 3\n" + POSITIONS + "property float nx\nproperty float ny\n" + FACES,
              "0 0 0 0 0\n1 0 0 0 3\n0 1 0 1 0\n3 0 1 2\n"));
    CHECK(mesh.normals.empty());
}

TEST_CASE("a concave PLY polygon is cut into ears and a line into nothing") {
    const Scene scene = load_ply_bytes(ascii("element vertex 4\n" + POSITIONS +
                                                 "element face 2\nproperty list uchar int "
                                                 "vertex_indices\n",
                                             "0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 1 2 3 0\n2 0 1\n"));
    CHECK(scene.meshes[0].triangles.size() == 2);
    for (const glm::uvec3& t : scene.meshes[0].triangles) {
        const auto& p = scene.meshes[0].positions;
        CHECK(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).z > 0.0f);
    }
    CHECK_THAT(scene.notes.at(0), Catch::Contains("lines are skipped"));
}

TEST_CASE("a PLY polygon may have any number of corners, and colours of bytes") {
    std::string values, corners = "400";
    for (int i = 0; i < 400; ++i) {
        const double angle = 6.283185307179586 * i / 400;
        values += fmt::format("{} {} 0 255 0 0\n", std::cos(angle), std::sin(angle));
        corners += " " + std::to_string(i);
    }
    const Scene scene = load_ply_bytes(
        ascii("element vertex 400\n" + POSITIONS +
                  "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                  "property list ushort int vertex_indices\n",
              values + corners + "\n"));
    CHECK(scene.meshes[0].triangles.size() == 398);
    CHECK(scene.meshes[0].colors.at(399) == glm::vec4(1, 0, 0, 1));
    CHECK(scene.materials[0].base_color == glm::vec3(1));
    CHECK(scene.materials[0].alpha_mode == AlphaMode::opaque);
}

TEST_CASE("colours of PLY vertices are sRGB, and their alpha lets rays pass") {
    const Scene scene = load_ply_bytes(
        ascii("element vertex 3\n" + POSITIONS +
                  "property float red\nproperty float green\nproperty ushort blue\n"
                  "property uchar alpha\n" +
                  FACES,
              "0 0 0 0.5 0 65535 51\n1 0 0 nan 0 0 255\n0 1 0 2 -1 0 255\n3 0 1 2\n"));
    const std::vector<glm::vec4>& colors = scene.meshes[0].colors;
    CHECK(colors.at(0).x == Approx(0.2140f).margin(1e-3));
    CHECK(colors.at(0).z == 1.0f);
    CHECK(colors.at(0).w == Approx(0.2f));
    CHECK(colors.at(1) == glm::vec4(1));
    CHECK(colors.at(2) == glm::vec4(1, 0, 0, 1));
    CHECK(scene.materials[0].alpha_mode == AlphaMode::blend);
}

TEST_CASE("triangle strips keep their winding, and -1 begins a new one") {
    const Mesh mesh =
        mesh_of(ascii("element vertex 5\n" + POSITIONS +
                          "element tristrips 1\nproperty list int int vertex_indices\n",
                      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n12 0 1 2 3 4 -1 1 3 2 2 4 -1\n"));
    const auto t = [](uint32_t a, uint32_t b, uint32_t c) { return glm::uvec3(a, b, c); };
    CHECK(mesh.triangles == std::vector{t(0, 1, 2), t(2, 1, 3), t(2, 3, 4), t(1, 3, 2)});
}

TEST_CASE("bad numbers of a PLY vertex cost its faces, its normal or its texture coordinates") {
    const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
    const Scene scene = load_ply_bytes(
        ascii("element vertex 5\n" + POSITIONS + normals +
                  "property float u\nproperty float v\nelement face 2\n"
                  "property list uchar int vertex_indices\n",
              "0 0 0 0 0 1 0 0\n1 0 0 nan 0 1 0 0\n0 1 0 0 0 1 inf 0\nnan 0 0 0 0 1 0 0\n"
              "-nan(ind) 1.#INF 0 0 0 1 0 0\n3 0 1 2\n3 0 1 3\n"));
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.triangles == std::vector{glm::uvec3(0, 1, 2)});
    CHECK(mesh.normals[1] == glm::vec3(0, 0, 1));
    CHECK(mesh.uvs[2] == glm::vec2(0));
    CHECK(std::ranges::count_if(scene.notes, [](const std::string& note) {
              return note.find("no finite numbers") != std::string::npos;
          }) == 3);
    CHECK(scene_bounds(scene).low == glm::vec3(0));
    CHECK(scene_bounds(scene).high == glm::vec3(1, 1, 0));
}

TEST_CASE("a PLY file may name a texture and give each face its own texture coordinates") {
    ScratchFolder folder;
    folder.write("my texture.png", test::blue_png());
    const std::string header = "comment TextureFile my texture.png\nelement vertex 4\n" +
                               POSITIONS +
                               "element face 2\nproperty list uchar int vertex_indices\n"
                               "property list uchar float texcoord\n";
    const std::string values = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 6 0 0 1 0 0 1\n"
                               "3 2 1 3 6 0 1 0.5 0 nan 1\n";
    const Scene scene = load_scene(folder.write("a.ply", ascii(header, values)));
    const Mesh& mesh = scene.meshes[0];
    const auto uv = [&](size_t triangle, size_t corner) {
        return mesh.uvs.at(mesh.triangles.at(triangle)[corner]);
    };
    CHECK(uv(0, 1) == glm::vec2(1, 1));
    CHECK(uv(1, 1) == glm::vec2(0.5f, 1));
    CHECK(uv(1, 2) == glm::vec2(0));
    CHECK(mesh.triangles[0].z == mesh.triangles[1].x); // of equal position and coordinates
    CHECK(mesh.positions.at(mesh.triangles[1].y) == glm::vec3(1, 0, 0));
    CHECK(scene.materials[0].base_color_texture == 0);
    CHECK(scene.materials[0].base_color == glm::vec3(1));
    const Scene without = load_ply_bytes(ascii(header, values));
    CHECK(without.materials[0].base_color == glm::vec3(0.8f));
    CHECK_THAT(without.notes.at(1), Catch::Contains("missing are left out (my texture.png)"));
}

TEST_CASE("the lines of a PLY header may end in CR LF or CR, and numbers stand anywhere") {
    std::string file =
        ascii("element vertex 3\n" + POSITIONS + FACES, "0 0 0 +1 -0 0e0\n\n0\t1.0 0\n 3 0\n1 2");
    CHECK(mesh_of(file).positions[1] == glm::vec3(1, 0, 0));
    std::string crlf;
    for (const char c : file) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    CHECK(mesh_of(crlf).positions[2] == glm::vec3(0, 1, 0));
    std::ranges::replace(file, '\n', '\r');
    CHECK(mesh_of(file).positions[2] == glm::vec3(0, 1, 0));
}

TEST_CASE("after lines that end in CR, a first byte of 10 is a value's") {
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
                         "property uchar x\nproperty uchar y\nproperty uchar z\n" +
                         FACES + "end_header\n";
    std::ranges::replace(header, '\n', '\r');
    const Mesh mesh = mesh_of(header + std::string("\n\0\0\1\0\0\0\1\0\3", 10) +
                              test::bytes_of<int32_t>({0, 1, 2}));
    CHECK(mesh.positions[0] == glm::vec3(10, 0, 0));
}

TEST_CASE("a TOML scene takes PLY files as shapes and as includes") {
    ScratchFolder folder;
    folder.write("t.ply",
                 ascii("element vertex 3\n" + POSITIONS + FACES, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    const Scene scene = load_scene(folder.write(
        "s.toml", "include = [\"t.ply\"]\n[[material]]\nname = \"red\"\nbase_color = [1, 0, 0]\n"
                  "[[shape]]\ntype = \"mesh\"\nfile = \"t.ply\"\nmaterial = \"red\"\n"
                  "position = [0, 0, 1]\n"));
    REQUIRE(scene.instances.size() == 2);
    std::vector<glm::vec3> colors;
    for (const Instance& instance : scene.instances)
        colors.push_back(scene.materials[scene.meshes[instance.mesh].materials[0]].base_color);
    CHECK(std::ranges::count(colors, glm::vec3(0.8f)) == 1);
    CHECK(std::ranges::count(colors, glm::vec3(1, 0, 0)) == 1);
}
