// The plan of a session's memory is what is allocated, and waves that do not fit are halved.
#include "core/error.h"
#include "scene/check.h"
#include "session/small_session.h"

namespace onde::test {
namespace {

/// The tests' device as if it allowed buffers of that size.
struct OtherDevice {
    gpu::Device device;
    gpu::Programs programs;

    explicit OtherDevice(uint64_t largest_buffer)
        : device(test::device().raw(), with(largest_buffer)),
          programs(device, kernel_sources(), test_cache()) {}

    static gpu::DeviceFacts with(uint64_t largest_buffer) {
        gpu::DeviceFacts facts = test::device().facts();
        facts.max_allocation = largest_buffer;
        facts.global_memory = std::max(facts.global_memory, largest_buffer);
        return facts;
    }
};

/// varied_scene() with three textures of 1 MiB.
Scene textured_scene() {
    Scene scene = varied_scene();
    for (Mesh& mesh : scene.meshes)
        for (const glm::vec3& p : mesh.positions) mesh.uvs.emplace_back(p.x, p.z);
    for (uint32_t i = 0; i < 3; i++) {
        Texture texture;
        texture.image.width = texture.image.height = 512;
        for (uint32_t k = 0; k < 4 * 512 * 512; k++)
            texture.image.rgba.push_back(uint8_t(k / 64 * 37 + 60 * i));
        scene.textures.push_back(texture);
    }
    scene.materials[WHITE].base_color_texture = 0;
    scene.materials[RED].base_color_texture = 1;
    scene.materials[GLOW].emission_texture = 2;
    check_scene(scene);
    return scene;
}

} // namespace

TEST_CASE("the memory plan is what is allocated, by every integrator and engine") {
    std::vector<SessionOptions> all;
    for (const IntegratorKind integrator : ALL_INTEGRATORS)
        all.push_back(small_session(integrator));
    for (const IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::whitted}) {
        all.push_back(small_session(integrator));
        all.back().render.engine = Engine::megakernel;
        all.push_back(small_session(integrator));
        all.back().render.settings.launch = gpu::Launch::staged;
    }
    for (const SessionOptions& options : all) {
        INFO(word_of(options.render.integrator) << ", " << word_of(options.render.engine) << ", "
                                                << word_of(options.render.settings.launch));
        Session(programs(), varied_scene(), options).prepare(); // warming allocates, too
        const uint64_t before = device().allocated_bytes();
        Session session(programs(), varied_scene(), options);
        session.prepare();
        CHECK(session.memory_plan().bytes() == device().allocated_bytes() - before);
    }
}

TEST_CASE("waves that do not fit are halved, with a note, and make the same picture") {
    SessionOptions options = small_session();
    options.render.settings.wave_size = 1u << 18;
    const std::vector<float> expected = fresh_picture(varied_scene(), options);
    OtherDevice small(4u << 20);
    Session session(small.programs, varied_scene(), options);
    CHECK(session.options().settings.wave_size < 1u << 18);
    CHECK(session.options().settings.wave_size >= 1u << 14);
    REQUIRE_FALSE(session.notes().empty());
    CHECK_THAT(session.notes().back(), Catch::Contains("waves of 262144 paths do not fit"));
    CHECK(rendered(session) == expected);
}

TEST_CASE("waves are halved that the driver refuses though its facts allow them") {
    SessionOptions options = small_session();
    const std::vector<float> expected = fresh_picture(varied_scene(), options);
    options.render.settings.wave_size = 1u << 26;
    OtherDevice boastful(UINT64_MAX / 2);
    Session session(boastful.programs, varied_scene(), options);
    CHECK(rendered(session) == expected);
    if (device().facts().max_allocation >= uint64_t(1) << 33) return; // it takes them
    CHECK(session.options().settings.wave_size < 1u << 26);
    CHECK_THAT(session.notes().back(), Catch::Contains("waves of 67108864 paths do not fit"));
}

TEST_CASE("textures that one buffer does not hold lie in several, and make the same picture") {
    for (const Engine engine : {Engine::wavefront, Engine::megakernel}) {
        SessionOptions options = small_session();
        options.render.engine = engine;
        const std::vector<float> expected = fresh_picture(textured_scene(), options);
        OtherDevice small(5u << 18);
        Session session(small.programs, textured_scene(), options);
        REQUIRE(session.packed().texels2.size() == 512 * 512);
        CHECK(session.packed().texture_bytes() > 3u << 20);
        CHECK(rendered(session) == expected);
    }
    OtherDevice smaller(1u << 19);
    CHECK_THROWS_WITH(Session(smaller.programs, textured_scene(), small_session()),
                      Catch::Contains("--texture-memory"));
}

TEST_CASE("a picture that does not fit is refused, whatever the waves") {
    SessionOptions options = small_session();
    options.render.width = options.render.height = 1024;
    OtherDevice small(4u << 20);
    CHECK_THROWS_AS(Session(small.programs, varied_scene(), options), DeviceError);
    CHECK_THROWS_WITH(Session(small.programs, varied_scene(), options),
                      Catch::Contains("use a smaller --size"));
}

} // namespace onde::test
