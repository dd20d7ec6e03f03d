// Any split of a render, resumed anywhere and by any engine, makes the same film.
#include "render/picture.h"
#include "render/variants.h"
#include "support/folders.h"

#include <cstring>

namespace onde::test {
namespace {

constexpr IntegratorKind INTEGRATORS[] = {IntegratorKind::path, IntegratorKind::whitted,
                                          IntegratorKind::light, IntegratorKind::depth_buffer,
                                          IntegratorKind::painter};

/// A scene and what renders it.
struct Studio {
    Scene scene = load_scene(std::filesystem::path(in_project("scenes/chapter/five-objects.toml")));
    DeviceScene placed = place_on_device(scene);

    std::unique_ptr<Integrator> integrator(const RenderOptions& options) const {
        return make_integrator({programs(), &scene, placed, scene.cameras[0], options, nullptr});
    }
};

RenderOptions options_of(IntegratorKind kind, uint32_t samples) {
    RenderOptions options = small_options(12, 8, samples);
    options.integrator = kind;
    options.depth = 4;
    return options;
}

/// Goes on until the film has that many samples.
void render_to(Integrator& integrator, RenderOptions options, uint32_t samples) {
    const std::atomic<bool> never{false};
    options.samples = samples;
    CHECK(render(integrator, options, never, [](const Progress&) {}).samples == samples);
}

/// The pass is left when it asks for the second time.
void interrupt_pass(Integrator& integrator, uint32_t first, uint32_t count) {
    uint32_t asked = 0;
    integrator.render_pass(first, count, [&](double) { return ++asked < 2; });
}

bool same_sums(const FilmSums& a, const FilmSums& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

/// What differs, in words; empty when nothing does.
std::string difference(const FilmContents& a, const FilmContents& b) {
    if (!(a.extent == b.extent)) return "other samples";
    if (a.splats != b.splats) return "splats";
    if (!same_sums(a.block, b.block)) return "the block";
    if (a.parts.size() != b.parts.size()) return "other nodes";
    for (size_t i = 0; i < a.parts.size(); i++) {
        if (a.parts[i].node != b.parts[i].node) return fmt::format("node {}", i);
        if (!same_sums(a.parts[i].sums, b.parts[i].sums)) return fmt::format("sums of node {}", i);
    }
    return "";
}

} // namespace

TEST_CASE("640 samples in one go and in steps give the same bytes, by every integrator") {
    const Studio studio;
    for (const IntegratorKind kind : INTEGRATORS) {
        const RenderOptions options = options_of(kind, 640);
        const auto whole = studio.integrator(options);
        render_to(*whole, options, 640);
        const FilmContents expected = whole->film().contents();
        const Image picture = whole->film().develop();
        CHECK(*std::ranges::max_element(picture.pixels) > 0);
        const auto check = [&](std::initializer_list<uint32_t> steps) {
            const auto in_steps = studio.integrator(options_of(kind, 64));
            for (const uint32_t samples : steps) render_to(*in_steps, options, samples);
            INFO("integrator " << int(kind) << ", first to " << *steps.begin());
            CHECK(difference(in_steps->film().contents(), expected) == "");
            CHECK(first_difference(in_steps->film().develop(), picture) == "");
        };
        check({64, 640});
        check({1, 10, 64, 65, 333, 640});
        const auto first = studio.integrator(options);
        for (uint32_t done = 64; done < 640; done += 64) {
            render_to(*first, options, done);
            const auto resumed = studio.integrator(options);
            resumed->film().restore(first->film().contents());
            render_to(*resumed, options, 640);
            INFO("integrator " << int(kind) << ", resumed at " << done);
            CHECK(difference(resumed->film().contents(), expected) == "");
        }
    }
}

TEST_CASE("renders of some samples each add up to the whole render, by other waves too") {
    const Studio studio;
    RenderOptions options = options_of(IntegratorKind::path, 500);
    const auto whole = studio.integrator(options);
    render_to(*whole, options, 500);
    const FilmContents expected = whole->film().contents();
    std::vector<FilmPart> parts;
    for (const auto& [first, end] : {std::pair{0u, 64u}, {64u, 192u}, {192u, 500u}}) {
        options.first_sample = first;
        options.samples_in_flight = first == 64 ? 4 : 16;
        options.settings.wave_size = first == 64 ? 512 : 65536;
        const auto part = studio.integrator(options);
        options.samples = end;
        const std::atomic<bool> never{false};
        CHECK(render(*part, options, never, [](const Progress&) {}).samples == end - first);
        for (const FilmPart& node : part->film().contents().parts) add_part(parts, node);
        options.samples = 500;
        if (end == 500) CHECK(same_sums(part->film().contents().block, expected.block));
    }
    FilmContents added = expected;
    added.parts = parts;
    CHECK(difference(added, expected) == "");
}

TEST_CASE("no wave size, chunk or number of samples in flight changes a byte of many samples") {
    const Studio studio;
    for (const IntegratorKind kind :
         {IntegratorKind::path, IntegratorKind::whitted, IntegratorKind::light}) {
        RenderOptions options = options_of(kind, 200);
        const auto whole = studio.integrator(options);
        render_to(*whole, options, 200);
        const FilmContents expected = whole->film().contents();
        const auto check = [&](uint32_t wave_size, uint32_t chunk, uint32_t samples_in_flight) {
            options.settings.wave_size = wave_size;
            options.settings.chunk = chunk;
            options.samples_in_flight = samples_in_flight;
            const auto integrator = studio.integrator(options);
            render_to(*integrator, options, 200);
            INFO("integrator " << int(kind) << ", waves of " << wave_size << ", chunks of " << chunk
                               << ", " << samples_in_flight << " samples in flight");
            CHECK(difference(integrator->film().contents(), expected) == "");
        };
        check(65536, 256, 1);
        check(65536, 256, 256);
        check(512, 64, 4);
        check(64, 16, 16);
    }
}

TEST_CASE("every engine gives the same bytes of many samples") {
    const Studio studio;
    const RenderOptions options = options_of(IntegratorKind::path, 200);
    const auto whole = studio.integrator(options);
    render_to(*whole, options, 200);
    const FilmContents expected = whole->film().contents();
    for (const Variant& variant : VARIANTS) {
        const auto integrator = studio.integrator(apply(options, variant));
        render_to(*integrator, options, 200);
        INFO(variant.name);
        CHECK(difference(integrator->film().contents(), expected) == "");
    }
}

TEST_CASE("an interrupted pass is finished before the next, by smaller waves as well") {
    const Studio studio;
    for (const IntegratorKind kind :
         {IntegratorKind::path, IntegratorKind::whitted, IntegratorKind::light,
          IntegratorKind::depth_buffer, IntegratorKind::painter}) {
        RenderOptions options = options_of(kind, 160);
        options.settings.chunk = 64;
        options.settings.wave_size = 256; // two waves are in flight when it stops
        const auto whole = studio.integrator(options);
        render_to(*whole, options, 160);
        const auto first = studio.integrator(options);
        render_to(*first, options, 64);
        interrupt_pass(*first, 64, 16);
        const FilmContents interrupted = first->film().contents();
        CHECK(first->film().samples() > 64);
        CHECK(first->film().samples() < 80);
        INFO("integrator " << int(kind));
        render_to(*first, options, 160);
        CHECK(difference(first->film().contents(), whole->film().contents()) == "");

        options.settings.chunk = 16;
        options.settings.wave_size = 64;
        options.samples_in_flight = 4;
        const auto second = studio.integrator(options);
        second->film().restore(interrupted);
        render_to(*second, options, 160);
        CHECK(difference(second->film().contents(), whole->film().contents()) == "");
    }
}

TEST_CASE("sums of splats go on beyond 64 bits") {
    const Studio studio;
    const RenderOptions options = options_of(IntegratorKind::light, 32);
    const auto plain = studio.integrator(options);
    render_to(*plain, options, 16);
    FilmContents contents = plain->film().contents();
    for (size_t i = 0; i < contents.splats.size(); i += 3) // all but full, whatever was there
        for (size_t word = 0; word < 3; word++)
            contents.splats[i + word] = word < 2 ? UINT32_MAX : 5;
    const std::vector<uint32_t> before = contents.splats;
    const auto full = studio.integrator(options);
    full->film().restore(contents);
    render_to(*full, options, 32);
    std::ranges::fill(contents.splats, 0u);
    plain->film().restore(contents);
    render_to(*plain, options, 32);
    const std::vector<uint32_t> added = plain->film().contents().splats;
    std::vector<uint32_t> expected = before;
    for (size_t i = 0; i < expected.size(); i += 3) {
        uint64_t carry = 0;
        for (size_t word = i; word < i + 3; word++) {
            carry += uint64_t(before[word]) + added[word];
            expected[word] = uint32_t(carry);
            carry >>= 32;
        }
    }
    CHECK(added != std::vector<uint32_t>(added.size()));
    CHECK(full->film().contents().splats == expected);
    const Image high = full->film().develop(), low = plain->film().develop();
    for (size_t i = 0; i < low.pixels.size(); i++) {
        const double part = added[3 * i + 1] * 0x1p32 + added[3 * i];
        if (part > 0)
            CHECK(high.pixels[i] ==
                  Approx(low.pixels[i] / part * (6 * 0x1p64 + part)).epsilon(1e-5));
    }
}

TEST_CASE("a cleared film is as new") {
    const Studio studio;
    for (const IntegratorKind kind : INTEGRATORS) {
        const RenderOptions options = options_of(kind, 80);
        const auto integrator = studio.integrator(options);
        render_to(*integrator, options, 80);
        const FilmContents expected = integrator->film().contents();
        const std::vector<std::string> findings = integrator->findings();
        const uint64_t rays = integrator->ray_counts().total();
        integrator->clear();
        const Image black = integrator->film().develop();
        CHECK(*std::ranges::max_element(black.pixels) == 0);
        CHECK(integrator->ray_counts().total() == 0);
        render_to(*integrator, options, 80);
        INFO("integrator " << int(kind));
        CHECK(difference(integrator->film().contents(), expected) == "");
        CHECK(integrator->findings() == findings);
        CHECK(integrator->ray_counts().total() == rays);
    }
}

} // namespace onde::test
