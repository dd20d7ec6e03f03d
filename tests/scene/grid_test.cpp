// Grids of densities, and the files that they are read from.
#include "core/files.h"
#include "scene/grid.h"
#include "scene/grid/formats.h"
#include "scene/load_context.h"
#include "scratch.h"
#include "support/folders.h"

#include <cmath>
#include <cstring>

using namespace onde;
using onde::test::has_note;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

const std::filesystem::path GRIDS = test::in_project("tests/data/grids");

/// The bytes of a .vol file of floats that count up from 0.
std::string vol(const glm::uvec3& count, uint32_t type = 1, uint32_t channels = 1,
                float high = 1.0f) {
    std::string bytes = "VOL\3";
    const auto add = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    add(type);
    for (glm::length_t k = 0; k < 3; ++k) add(count[k]);
    add(channels);
    for (const float edge : {0.0f, 0.0f, 0.0f, high, 1.0f, 2.0f}) add(edge);
    for (uint32_t i = 0; i < count.x * count.y * count.z * channels; ++i)
        type == 1 ? add(float(i)) : add(uint8_t(i));
    return bytes;
}

/// At a place of the grid's own space.
float density_there(const DensityGrid& grid, const glm::vec3& place) {
    return density_at(grid, glm::vec3(glm::inverse(grid.from_samples) * glm::vec4(place, 1.0f)));
}

std::string error_of(const std::string& bytes, bool is_vol) {
    LoadContext context({.limit = uint64_t(64) << 20});
    try {
        is_vol ? read_vol(context, "a.vol", bytes) : read_nanovdb(context, "a.nvdb", bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// What the ball of the files in tests/data is at a voxel.
float ball(const glm::vec3& voxel) {
    return std::max(1.0f - glm::length(voxel - glm::vec3(5, -3, 2)) / 11.0f, 0.0f);
}

/// The grids of one file in tests/data, voxels of 0.25 from (10, 20, 30).
void check_ball(const std::string& file, float tolerance) {
    INFO(file);
    LoadContext context;
    const DensityGrid grid = load_grid(context, GRIDS / file);
    for (int x = -20; x < 30; x += 3)
        for (int y = -20; y < 30; y += 3)
            for (int z = -20; z < 30; z += 3) {
                const glm::vec3 voxel(x, y, z);
                const float got = density_there(grid, voxel * 0.25f + glm::vec3(10, 20, 30));
                CHECK(std::abs(got - ball(voxel)) < tolerance);
            }
    // Half way between two voxels.
    const float between = 0.5f * (ball({7, -3, 2}) + ball({8, -3, 2}));
    CHECK(std::abs(density_there(grid, {11.875f, 19.25f, 30.5f}) - between) < tolerance);
}

} // namespace

TEST_CASE("bricks tell samples and what is linear between them, whole bricks by one number") {
    LoadContext context;
    const auto at = [](const glm::vec3& p) {
        return p.x < 16 ? 0.5f : 0.1f * p.x + 0.01f * p.y + 0.001f * p.z - 1.1f;
    };
    const DensityGrid grid = make_grid(context, "test", {30, 20, 11},
                                       [&](const glm::uvec3& p) { return at(glm::vec3(p)); });
    CHECK(grid.table == glm::uvec3(4, 3, 2));
    CHECK(grid.bricks[0] == DensityGrid::Brick{0.5f, DensityGrid::EVEN});
    CHECK(grid.bricks[2].first != DensityGrid::EVEN);
    CHECK(grid.samples.size() % DensityGrid::BRICK_SAMPLES == 0);
    for (const glm::vec3& p : {glm::vec3(3.3f, 4.4f, 5.5f), glm::vec3(20.25f, 8, 7.5f),
                               glm::vec3(29, 19, 10), glm::vec3(24, 16, 8)})
        CHECK(density_at(grid, p) == Approx(at(p)).margin(1e-4));
    CHECK(density_at(grid, {29.01f, 3, 3}) == 0);
    CHECK(density_at(grid, {-0.01f, 3, 3}) == 0);
    const DensityGrid odd = make_grid(context, "test", {2, 2, 2}, [](const glm::uvec3& p) {
        return p.x == 0 ? -1.0f : p.y == 0 ? NAN : 2.0f;
    });
    CHECK(density_at(odd, {0, 1, 1}) == 0);
    CHECK(density_at(odd, {1, 0, 1}) == 0);
    CHECK(density_at(odd, {1, 1, 0}) == 2);
    CHECK_THROWS_WITH(make_grid(context, "test", {1u << 21, 2, 2}, {}),
                      Catch::Contains("too large"));
}

TEST_CASE(".vol files are read, of floats and of bytes, as cells of a box") {
    LoadContext context;
    const std::string bytes = vol({4, 3, 2});
    const DensityGrid grid = read_vol(context, "a.vol", bytes);
    CHECK(density_there(grid, {0.125f, 1.0f / 6, 0.5f}) == Approx(0).margin(1e-3));
    CHECK(density_there(grid, {0.875f, 5.0f / 6, 1.5f}) == Approx(23).epsilon(1e-4));
    CHECK(density_there(grid, {0.999f, 0.999f, 1.999f}) == Approx(23).epsilon(1e-4)); // to the face
    CHECK(density_there(grid, {0.25f, 1.0f / 6, 0.5f}) == Approx(0.5).margin(1e-3));
    CHECK(density_there(grid, {1.001f, 0.5f, 0.5f}) == 0);
    const DensityGrid small = read_vol(context, "a.vol", vol({4, 3, 2}, 3, 2));
    CHECK(density_there(small, {0.875f, 5.0f / 6, 1.5f}) == Approx(46.0 / 255).epsilon(1e-4));
}

TEST_CASE("damaged .vol files are refused in one sentence") {
    const std::string whole = vol({4, 3, 2});
    for (size_t size = 0; size < whole.size(); ++size) {
        const std::string error = error_of(whole.substr(0, size), true);
        CHECK_THAT(error, Catch::StartsWith("a.vol: "));
        CHECK(error.find('\n') == std::string::npos);
    }
    CHECK_THAT(error_of(vol({4, 3, 2}, 2), true), Catch::Contains("neither floats nor bytes"));
    CHECK_THAT(error_of(vol({4, 3, 2}, 1, 1, 0), true), Catch::Contains("no volume"));
    CHECK_THAT(error_of(vol({0, 3, 2}), true), Catch::Contains("no cells"));
    CHECK_THAT(error_of(vol({1, 1, 1}, 1, 0), true), Catch::Contains("no channels"));
    std::string huge = whole;
    const uint32_t side = 1 << 19;
    for (size_t k = 0; k < 3; ++k) std::memcpy(&huge[8 + 4 * k], &side, 4);
    CHECK_THAT(error_of(huge, true), Catch::Contains("more cells"));
}

TEST_CASE("NanoVDB files are read, compressed, of floats and of fewer bits") {
    check_ball("floats.nvdb", 2e-5f); // its second grid, which is the density
    check_ball("fp16.nvdb", 5e-5f);
    check_ball("fp8.nvdb", 0.005f);
    check_ball("fp4.nvdb", 0.08f);
    check_ball("fpn.nvdb", 0.05f);
    check_ball("blosc.nvdb", 0.005f);
}

TEST_CASE("damaged NanoVDB files are refused in one sentence or read") {
    ScratchFolder folder;
    const std::string whole = read_file(GRIDS / "tiny.nvdb");
    LoadContext context;
    CHECK(density_there(read_nanovdb(context, "a.nvdb", whole), {1, 1, 1}) == Approx(0.75f));
    for (size_t size = 0; size < whole.size(); size += size < 2000 ? 1 : 997) {
        const std::string error = error_of(whole.substr(0, size), false);
        CHECK_THAT(error, Catch::StartsWith("a.nvdb: "));
        CHECK(error.find('\n') == std::string::npos);
    }
    // Each word of its heads, in turn, is something else.
    for (size_t at = 0; at < 1200; at += 4)
        for (const uint32_t value : {0u, 1u, 0x7fffffffu, 0xffffffffu, 0x80000000u}) {
            std::string bytes = whole;
            std::memcpy(&bytes[at], &value, 4);
            CHECK(error_of(bytes, false).find('\n') == std::string::npos);
        }
    std::string packed = whole;
    packed[14] = 3;
    CHECK_THAT(error_of(packed, false), Catch::Contains("not known"));
    packed[14] = 2;
    CHECK_THAT(error_of(packed, false), Catch::Contains("damaged"));
    CHECK_THAT(error_of("no such thing at all", false), Catch::Contains("no NanoVDB file"));
}

TEST_CASE("what is compressed and damaged is refused in one sentence") {
    for (const char* file : {"fp8.nvdb", "blosc.nvdb"}) {
        const std::string whole = read_file(GRIDS / file);
        for (size_t at = 16; at < whole.size(); at += 61) {
            std::string bytes = whole;
            bytes[at] = char(bytes[at] ^ 0x55);
            CHECK(error_of(bytes, false).find('\n') == std::string::npos);
            CHECK_THAT(error_of(whole.substr(0, at), false), Catch::StartsWith("a.nvdb: "));
        }
    }
}

TEST_CASE("media have grids by name, placed, and shared") {
    ScratchFolder folder;
    folder.write("a.vol", vol({4, 3, 2}));
    const std::string text = R"(
[medium]
density = "a.vol"
density_scale = 2
position = [1, 2, 3]
scale = 2
absorption = 1
emission = [1, 2, 3]
[[shape]]
type = "sphere"
material = "m"
[[material]]
name = "m"
kind = "dielectric"
medium = { density = "a.vol", rotation = [0, 90, 0], scattering = 3 }
)";
    const Scene scene = load_scene(folder.write("a.toml", text));
    REQUIRE(scene.grids.size() == 1);
    CHECK(scene.medium.grid == 0);
    CHECK(scene.medium.density_scale == 2);
    CHECK(scene.medium.emission == glm::vec3(1, 2, 3));
    CHECK(glm::vec3(scene.medium.placement * glm::vec4(1, 1, 1, 1)) == glm::vec3(3, 4, 5));
    const Medium& inside = *scene.materials[0].medium;
    CHECK(inside.grid == 0);
    CHECK(glm::length(glm::vec3(inside.placement * glm::vec4(1, 0, 0, 1)) - glm::vec3(0, 0, -1)) <
          1e-5f);
    CHECK(scene_hash(scene) != [&] {
        Scene other = scene;
        other.grids[0].bricks[0].largest += 1;
        return scene_hash(other);
    }());

    const Scene around = load_scene(folder.write("b.toml", R"(
[[include]]
file = "a.toml"
position = [10, 0, 0]
)"));
    CHECK(glm::vec3(around.medium.placement * glm::vec4(1, 1, 1, 1)) == glm::vec3(13, 4, 5));
    CHECK(around.materials[0].medium->placement[3].x == 10);
}

TEST_CASE("what is wrong with the grid of a medium is told") {
    ScratchFolder folder;
    folder.write("a.vol", vol({4, 3, 2}).substr(0, 60));
    const auto error = [&](const std::string& medium) {
        return load_error(
            folder.write("a.toml", "[[shape]]\ntype = \"sphere\"\n[medium]\n" + medium));
    };
    CHECK_THAT(error("density = \"a.vol\"\n"), Catch::Contains("a.vol: it ends too early"));
    CHECK_THAT(error("density = \"b.vol\"\n"), Catch::Contains("'b.vol', which does not exist"));
    CHECK_THAT(error("density = \"a.toml\"\n"), Catch::Contains("no grid of densities"));
    CHECK_THAT(error("density = \"../a.vol\"\n"), Catch::Contains("medium.density"));
    CHECK_THAT(error("scale = 2\n"), Catch::Contains("give density"));
    CHECK_THAT(error("emission = 1\n"), Catch::Contains("no end"));
    folder.write("c.vol", vol({4, 3, 2}));
    CHECK_THAT(error("density = \"c.vol\"\nscale = [1, 0, 1]\n"),
               Catch::Contains("must not be 0 along any axis"));
}

TEST_CASE("scenes that are brought to scale or counted from afar keep their grids in place") {
    ScratchFolder folder;
    folder.write("a.vol", vol({4, 3, 2}));
    const Scene scene = load_scene(folder.write("a.toml", R"(
[[shape]]
type = "sphere"
radius = 1e-9
[medium]
density = "a.vol"
scale = 1e-9
absorption = 1e9
emission = 1e9
)"));
    const float size = scene.spheres[0].radius;
    CHECK(scene.medium.placement[0].x == Approx(size));
    CHECK(scene.medium.absorption.x * size == Approx(1));
    CHECK(scene.medium.emission.x * size == Approx(1));
    const Scene far = load_scene(folder.write("b.toml", R"(
[[shape]]
type = "sphere"
center = [1e6, 0, 0]
[medium]
density = "a.vol"
position = [1000001, 0, 0]
absorption = 1
)"));
    CHECK(far.origin.x > 0);
    CHECK(far.medium.placement[3].x - far.spheres[0].center.x == 1);
}
