// Sessions render, stop, continue and say what they have to say.
#include "core/error.h"
#include "session/machine.h"
#include "session/small_session.h"

namespace onde::test {

TEST_CASE("a render that goes on to more samples is the render that had them at once") {
    for (const IntegratorKind integrator : ALL_INTEGRATORS) {
        INFO(word_of(integrator));
        Session session(programs(), varied_scene(), small_session(integrator, 6));
        for (const uint32_t samples : {6u, 70u}) {
            RenderOptions options = session.options();
            options.samples = samples;
            session.set_options(options);
            CHECK(session.render().samples == samples);
        }
        CHECK(session.picture().pixels ==
              fresh_picture(varied_scene(), small_session(integrator, 70)));
    }
}

TEST_CASE("a render that is stopped goes on where it was") {
    SessionOptions options = small_session(IntegratorKind::path, 5);
    options.render.settings.wave_size = options.render.settings.chunk;
    Session session(programs(), varied_scene(), options);
    const RenderOutcome stopped = session.render([](const Progress&) { return false; });
    CHECK(stopped.interrupted);
    CHECK(stopped.samples < 5);
    const RenderOutcome ended = session.render();
    CHECK_FALSE(ended.interrupted);
    CHECK(ended.samples == 5);
    CHECK(session.picture().pixels == fresh_picture(varied_scene(), options));
}

TEST_CASE("a finished render has nothing left to do") {
    Session session(programs(), varied_scene(), small_session());
    session.render();
    const uint64_t rays = session.ray_counts().total();
    CHECK(rays > 0);
    CHECK(session.render().samples == 2);
    CHECK(session.ray_counts().total() == rays);
}

TEST_CASE("a session follows a sample of its picture") {
    for (const IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::whitted}) {
        Session session(programs(), varied_scene(), small_session(integrator, 1));
        session.render();
        const Image picture = session.picture();
        const SampleReport report = session.inspect({20, 15, 0});
        for (uint32_t k = 0; k < 3; k++) {
            const auto* path = std::get_if<PathReport>(&report);
            const float value =
                path ? path->radiance[k] : std::get<TreeReport>(report).nodes[0].returned[k];
            CHECK(value == picture.pixel(20, 15)[k]);
        }
    }
    Session session(programs(), varied_scene(), small_session(IntegratorKind::painter));
    CHECK_THROWS_WITH(session.inspect({0, 0, 0}), Catch::Contains("not by painter"));
}

TEST_CASE("notes of the scene and of what the integrator makes of it are told as they arise") {
    Scene scene = varied_scene();
    scene.notes = {"a note of the loader"};
    SessionOptions options = small_session(IntegratorKind::whitted);
    std::vector<std::string> told;
    options.on_note = [&](const std::string& note) { told.push_back(note); };
    Session session(programs(), scene, options);
    REQUIRE(session.notes().size() >= 2);
    CHECK(session.notes().front() == "a note of the loader");
    CHECK(told == session.notes());
    const size_t before = told.size();
    RenderOptions painted = session.options();
    painted.integrator = IntegratorKind::light;
    session.set_options(painted);
    CHECK(told == session.notes());
    CHECK(session.options().integrator == IntegratorKind::light);
    CHECK(told.size() >= before);
}

TEST_CASE("kernels are timed where that is asked for") {
    Machine machine({}, kernel_sources(), test_cache(), gpu::Profiling::on);
    SessionOptions options = small_session();
    Session untimed(machine.programs, varied_scene(), options);
    untimed.render();
    CHECK(untimed.kernel_times().empty());
    options.timed = true;
    Session timed(machine.programs, varied_scene(), options);
    timed.render();
    CHECK_FALSE(timed.kernel_times().empty());
}

TEST_CASE("a kept film goes on in another session, by other waves, and counts anew") {
    for (const IntegratorKind integrator : ALL_INTEGRATORS) {
        INFO(word_of(integrator));
        SessionOptions options = small_session(integrator, 3);
        Session first(programs(), varied_scene(), options);
        first.render();
        options.render.samples = 70;
        options.render.settings.wave_size = 4 * options.render.settings.chunk;
        Session second(programs(), varied_scene(), options);
        second.render();
        second.restore_film(first.keep_film());
        CHECK(second.ray_counts().total() == 0);
        CHECK(second.render().samples == 70);
        CHECK(second.picture().pixels == fresh_picture(varied_scene(), options));
    }
}

TEST_CASE("only the pixels of a rectangle are rendered, with the bits that they have in all") {
    for (const IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::whitted}) {
        INFO(word_of(integrator));
        SessionOptions options = small_session(integrator, 3);
        Session whole(programs(), varied_scene(), options);
        whole.render();
        const Image all = whole.picture();
        options.render.rectangle = Rectangle{5, 3, 9, 10};
        options.render.settings.wave_size = 4 * options.render.settings.chunk;
        Session part(programs(), varied_scene(), options);
        CHECK(part.render().samples == 3);
        const Image some = part.picture(), counts = part.film().develop(SAMPLE_COUNT);
        for (uint32_t y = 0; y < all.height; y++)
            for (uint32_t x = 0; x < all.width; x++) {
                const bool inside = x >= 5 && x < 14 && y >= 3 && y < 13;
                CHECK(counts.pixel(x, y)[0] == (inside ? 3.0f : 0.0f));
                for (uint32_t k = 0; k < 3; k++)
                    CHECK(some.pixel(x, y)[k] == (inside ? all.pixel(x, y)[k] : 0.0f));
            }
    }
    SessionOptions options = small_session(IntegratorKind::light, 3);
    options.render.rectangle = Rectangle{5, 3, 9, 10};
    CHECK_THROWS_WITH(Session(programs(), varied_scene(), options),
                      Catch::Contains("draws all pixels at once"));
}

TEST_CASE("a film of another scene or other settings is refused, with what differs") {
    Session session(programs(), varied_scene(), small_session());
    const KeptFilm kept = session.keep_film();
    const auto check = [&](const char* what, const auto& change) {
        Scene scene = varied_scene();
        SessionOptions options = small_session();
        change(scene, options.render);
        Session other(programs(), scene, options);
        CHECK_THROWS_WITH(other.restore_film(kept),
                          Catch::Contains(std::string("another ") + what));
    };
    check("scene", [](Scene& scene, RenderOptions&) { scene.materials[RED].roughness = 0.25f; });
    check("seed", [](Scene&, RenderOptions& options) { options.seed = 1; });
    check("width", [](Scene&, RenderOptions& options) { options.width--; });
    check("depth", [](Scene&, RenderOptions& options) { options.depth--; });
    check("filter", [](Scene&, RenderOptions& options) { options.filter = Filter::box; });
    check("integrator",
          [](Scene&, RenderOptions& options) { options.integrator = IntegratorKind::whitted; });
}

} // namespace onde::test
