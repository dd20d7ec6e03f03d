// Devices that share a picture: the bits of one device, whatever each of them took, and whichever
// of them fails.
#include "session/device_group.h"
#include "support/folders.h"

#include "core/error.h"
#include "gpu/device_list.h"
#include "session/machine.h"
#include "session/small_session.h"

#include <filesystem>

namespace onde::test {
namespace {

namespace fs = std::filesystem;

SessionOptions small_waves(uint32_t samples) {
    SessionOptions options = small_session(IntegratorKind::path, samples);
    options.render.settings.wave_size = 4 * options.render.settings.chunk;
    return options;
}

std::vector<float> alone(const SessionOptions& options) {
    Session session(programs(), varied_scene(), options);
    return rendered(session);
}

/// Two parts of the first device; the kernels of the second may come from elsewhere.
struct Halves {
    std::vector<std::unique_ptr<Machine>> machines;
    std::vector<std::string> lost;

    explicit Halves(const fs::path& kernels_of_second = {}) {
        for (gpu::Device& device : gpu::open_devices("0/2")) {
            const bool is_other = !machines.empty() && !kernels_of_second.empty();
            machines.push_back(std::make_unique<Machine>(
                std::move(device),
                is_other ? gpu::KernelSources::folder(kernels_of_second) : kernel_sources(),
                test_cache()));
        }
    }

    DeviceGroup group(const SessionOptions& options) {
        std::vector<std::unique_ptr<Session>> sessions;
        for (const auto& machine : machines)
            sessions.push_back(
                std::make_unique<Session>(machine->programs, varied_scene(), options));
        return DeviceGroup(std::move(sessions),
                           [this](const std::string& why) { lost.push_back(why); });
    }
};

bool can_be_halved() {
    return device().facts().compute_units > 1;
}

/// A copy of the kernels, which can be taken away.
class KernelCopy {
  public:
    KernelCopy() {
        std::string name = (fs::temp_directory_path() / "onde-kernels-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()));
        path_ = name;
        fs::copy(fs::path(in_project("kernels")), path_, fs::copy_options::recursive);
    }
    ~KernelCopy() { remove(); }
    const fs::path& path() const { return path_; }
    void remove() const {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

  private:
    fs::path path_;
};

} // namespace

TEST_CASE("devices that share a picture make the bits of one, of many samples and of few") {
    if (!can_be_halved()) return;
    Halves halves;
    for (const uint32_t samples : {20u, 64u, 300u}) {
        SessionOptions options = small_waves(samples);
        if (samples == 64) options.render.rectangle = Rectangle{3, 5, 30, 20};
        if (samples == 300) options.render.first_sample = 64;
        DeviceGroup group = halves.group(options);
        const RenderOutcome outcome = group.render();
        CHECK_FALSE(outcome.interrupted);
        CHECK(outcome.samples == samples - options.render.first_sample);
        CHECK(group.session().picture().pixels == alone(options));
        CHECK(group.ray_counts().total() > 0);
        const std::vector<DeviceShare> shares = group.shares();
        REQUIRE(shares.size() == 2);
        CHECK(shares[0].share + shares[1].share == Approx(1));
        CHECK(shares[0].units + shares[1].units >= 4);
        CHECK(std::min(shares[0].units, shares[1].units) > 0);
    }
    CHECK(halves.lost.empty());
}

TEST_CASE("devices count the rays that one counts") {
    if (!can_be_halved()) return;
    Halves halves;
    const SessionOptions options = small_waves(130);
    DeviceGroup group = halves.group(options);
    group.render();
    Session session(programs(), varied_scene(), options);
    session.render();
    CHECK(group.ray_counts().total() == session.ray_counts().total());
}

TEST_CASE("devices go on from a film of one, within a block and within a pass") {
    if (!can_be_halved()) return;
    Halves halves;
    SessionOptions options = small_waves(200);
    for (const bool within_a_pass : {false, true}) {
        SessionOptions part = options;
        if (!within_a_pass) part.render.samples = 70;
        Session session(programs(), varied_scene(), part);
        session.render(
            [&](const Progress& progress) { return !within_a_pass || progress.fraction < 0.2; });
        DeviceGroup group = halves.group(options);
        group.restore_film(session.keep_film());
        CHECK(group.render().samples == 200);
        CHECK(group.session().picture().pixels == alone(options));
    }
}

TEST_CASE("devices that are stopped keep whole blocks and go on from them") {
    if (!can_be_halved()) return;
    Halves halves;
    const SessionOptions options = small_waves(640);
    DeviceGroup group = halves.group(options);
    FilmContents seen;
    const RenderOutcome stopped = group.render([&](const Progress& progress) {
        seen = group.contents();
        return progress.fraction < 0.2;
    });
    if (stopped.interrupted) {
        CHECK(stopped.samples < 640);
        CHECK(uint32_t(stopped.samples) % FILM_BLOCK == 0);
        CHECK(seen.extent.end <= stopped.samples);
        CHECK(group.samples() == stopped.samples);
    }
    CHECK(group.render().samples == 640);
    CHECK(group.session().picture().pixels == alone(options));
    CHECK(group.render().samples == 640); // nothing is left to do
}

TEST_CASE("a camera that is moved is moved on all devices") {
    if (!can_be_halved()) return;
    Halves halves;
    const SessionOptions options = small_waves(64);
    DeviceGroup group = halves.group(options);
    group.render();
    Camera camera = group.session().camera();
    camera.camera_to_world = moved({0.2f, 0.1f, 0}) * camera.camera_to_world;
    group.set_camera(camera);
    group.render();
    Session session(programs(), varied_scene(), options);
    session.set_camera(camera);
    CHECK(group.session().picture().pixels == rendered(session));
}

TEST_CASE("a device that fails gives its unit back, and the others finish") {
    if (!can_be_halved()) return;
    const SessionOptions options = small_waves(300);
    const std::vector<float> expected = alone(options);
    const KernelCopy kernels; // without which the second device can't begin a unit
    Halves halves(kernels.path());
    DeviceGroup group = halves.group(options);
    group.prepare();
    kernels.remove();
    CHECK(group.render().samples == 300);
    CHECK(group.session().picture().pixels == expected);
    CHECK(halves.lost.size() == 1);
    CHECK(group.shares()[1].is_lost);
    CHECK(group.shares()[0].share == 1);
}

TEST_CASE("where no device is left, the last one's failure is told") {
    if (!can_be_halved()) return;
    const KernelCopy kernels;
    Halves halves(kernels.path());
    halves.machines.erase(halves.machines.begin());
    halves.machines.push_back(std::move(Halves(kernels.path()).machines[1]));
    DeviceGroup group = halves.group(small_waves(300));
    group.prepare();
    kernels.remove();
    CHECK_THROWS_AS(group.render(), DeviceError);
    CHECK(halves.lost.size() == 1);
}

TEST_CASE("several devices refuse what only one can do") {
    if (!can_be_halved()) return;
    Halves halves;
    CHECK_THROWS_WITH(halves.group(small_session(IntegratorKind::light)),
                      Catch::Contains("light has none"));
    SessionOptions timed = small_waves(64);
    timed.render.seconds = 1;
    CHECK_THROWS_WITH(halves.group(timed), Catch::Contains("a time limit is for one device"));
}

} // namespace onde::test
