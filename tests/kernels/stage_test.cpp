// Each stage of the wavefront alone, on a few hand-made slots, one at a time and in lanes: the
// slots around them are full of NaN.
#include "kernels/stage_rig.h"

#include <catch2/catch.hpp>

#include <map>

using namespace onde;
using namespace onde::test;

namespace {

const glm::vec3 UP(0, 1, 0), DOWN(0, -1, 0);
const glm::vec3 ALBEDO(0.5f, 0.25f, 1.0f), EMISSION(2, 3, 4), SKY(0.5f, 1, 2);
const glm::vec3 POINT(0, 3, 0), INTENSITY(9, 18, 27);
constexpr uint32_t FLOOR = 0, LAMP = 1; // primitives
constexpr double LAMP_AREA = 2;

/// A diffuse floor, a lamp above that shines downward, a point between them, and a sky.
Scene room() {
    Scene scene;
    Material floor;
    floor.base_color = ALBEDO;
    add_triangle(scene, {-9, 0, -9}, {0, 0, 9}, {9, 0, -9}, floor);
    Material lamp;
    lamp.base_color = glm::vec3(0);
    lamp.emission = EMISSION;
    lamp.two_sided = false;
    add_triangle(scene, {-1, 8, -1}, {1, 8, -1}, {0, 8, 1}, lamp);
    scene.point_lights.push_back({POINT, INTENSITY});
    scene.environment.radiance = SKY;
    return scene;
}

/// Probability of choosing a light of that kind.
double pmf(uint32_t kind) {
    static const PackedScene packed = pack_scene(room());
    for (const LightRecord& light : packed.lights)
        if (light.kind == kind) return light.pmf;
    return 0;
}

/// A rig with an empty wave. Its program is compiled once for each width.
StageRig fresh_rig(uint32_t width) {
    static std::map<uint32_t, StageRig> rigs;
    if (!rigs.contains(width)) rigs.emplace(width, StageRig(room(), width));
    return rigs.at(width);
}

constexpr double LIFT = 2e-4; // of rays off the floor, at most: it is 20 long

void check_near(glm::dvec3 got, glm::dvec3 wanted, double bound = 1e-5) {
    INFO("(" << got.x << ", " << got.y << ", " << got.z << ") instead of (" << wanted.x << ", "
             << wanted.y << ", " << wanted.z << ")");
    CHECK(glm::length(got - wanted) <= bound * std::max(1.0, glm::length(wanted)));
}
void check_near(glm::vec3 got, glm::dvec3 wanted, double bound = 1e-5) {
    check_near(glm::dvec3(got), wanted, bound);
}

/// What a shadow ray from `position` on the floor brings, by the light that it goes to: Veach 1997,
/// power heuristic, next to cosine-weighted sampling.
glm::dvec3 direct_light(glm::dvec3 position, glm::dvec3 direction, double distance) {
    const glm::dvec3 f = glm::dvec3(ALBEDO) / M_PI * direction.y;
    const glm::dvec3 to_point = glm::dvec3(POINT) - position;
    const double bsdf_pdf = direction.y / M_PI;
    const auto weighted = [&](glm::vec3 light, double pdf) {
        return f * glm::dvec3(light) * pdf / (pdf * pdf + bsdf_pdf * bsdf_pdf);
    };
    if (distance > 1e20) return weighted(SKY, pmf(LIGHT_ENVIRONMENT) / (4 * M_PI));
    if (glm::length(glm::normalize(to_point) - direction) < 1e-4) // the origin is lifted
        return f * glm::dvec3(INTENSITY) / glm::dot(to_point, to_point) / pmf(LIGHT_POINT);
    return weighted(EMISSION,
                    pmf(LIGHT_TRIANGLE) * distance * distance / (direction.y * LAMP_AREA));
}

/// A path that came down on the floor below (x, 2, z).
void put_on_floor(StageRig& rig, uint32_t slot, uint32_t id, float x, float z,
                  glm::vec3 throughput = glm::vec3(1)) {
    rig.put_path(slot, id, {x, 2, z}, DOWN, throughput);
    rig.put_hit(slot, 2, 0.25f, 0.5f, FLOOR);
}

/// Forty paths, of which about a third go on; path 39 - i is in slot i.
StageRig rig_to_extend(uint32_t width) {
    StageRig rig = fresh_rig(width);
    rig.count = 40;
    for (uint32_t i = 0; i < rig.count; i++) {
        const auto x = float(i);
        rig.put_path(i, 39 - i, {x, x + 0.25f, x + 0.5f}, {-x, -x - 0.25f, -x - 0.5f},
                     {2 * x, 2 * x + 1, 2 * x + 2}, 100 + x);
        rig.working(WorkColumn::alive, i) = word(i % 3 == 1 || (i >= 16 && i < 20));
    }
    return rig;
}

/// The words of a slot that move with its path, as bits.
std::vector<uint32_t> path_words(const std::vector<float>& state, uint32_t slot) {
    std::vector<uint32_t> words;
    for (uint32_t k = 0; k < PathColumn::count; k++)
        words.push_back(from_word(state[k * StageRig::STRIDE + slot]));
    return words;
}

const uint32_t WIDTHS[] = {1, 16};

} // namespace

TEST_CASE("generate starts every sample of every pixel at the camera") {
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        StageRig rig = fresh_rig(width);
        rig.count = 10;
        rig.log2_samples = 1;
        rig.first_pixel = 3;
        rig.sums.assign(StageRig::STRIDE, glm::vec4(7));
        rig.run("generate");
        for (uint32_t i = 0; i < rig.count; i++) {
            CHECK(from_word(rig.path(PathColumn::id, i)) == i);
            CHECK(rig.path(PathColumn::pdf, i) == 0);
            CHECK(rig.path3(PathColumn::origin, i) == glm::vec3(0));
            CHECK(rig.path3(PathColumn::throughput, i) == glm::vec3(1));
            CHECK(rig.sums[i] == glm::vec4(0));
            // The default camera sees 0.7 radians over the film's height of 4 pixels.
            const uint32_t pixel = rig.pixel_order[3 + i / 2];
            const glm::vec3 d = rig.path3(PathColumn::direction, i);
            const double scale = 2 / std::tan(0.35);
            CHECK(2 + d.x / -d.z * scale == Approx(double(pixel & 0xffff) + 0.5).margin(0.501));
            CHECK(2 - d.y / -d.z * scale == Approx(double(pixel >> 16) + 0.5).margin(0.501));
        }
        CHECK(rig.path3(PathColumn::direction, 0) != rig.path3(PathColumn::direction, 1));
        CHECK(rig.sums[rig.count] == glm::vec4(7));
        CHECK(rig.queue == std::vector<uint32_t>{rig.count, 0});
    }
}

TEST_CASE("generate gives the samples of a wave the rays that they have in any other wave") {
    StageRig first = fresh_rig(1), second = fresh_rig(16);
    first.count = 16;
    first.log2_samples = 2;
    first.run("generate");
    second.count = 2;
    second.log2_samples = 0;
    second.first_pixel = 2;
    second.first_sample = 3;
    second.run("generate");
    for (uint32_t k = 0; k < 3; k++)
        CHECK(second.path(PathColumn::direction + k, 0) ==
              first.path(PathColumn::direction + k, 11));
}

TEST_CASE("intersect finds what each ray meets first") {
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        StageRig rig = fresh_rig(width);
        rig.put_path(0, 0, {1, 2, -3}, DOWN);
        rig.put_path(1, 1, {0, 2, 0}, UP);
        rig.put_path(2, 2, {0, 9, 0}, DOWN);
        rig.put_path(3, 3, {0, 2, 0}, {1, 0, 0});
        rig.run("intersect");
        CHECK(rig.counters[COUNTER_EXTENSION * COUNTER_BOUNCES] == 4);
        CHECK(rig.queue == std::vector<uint32_t>{4, 0});
        const uint32_t wanted[] = {FLOOR, LAMP, LAMP, BVH_NONE};
        const float distance[] = {2, 6, 1};
        for (uint32_t i = 0; i < 4; i++)
            CHECK(from_word(rig.working(WorkColumn::primitive, i)) == wanted[i]);
        for (uint32_t i = 0; i < 3; i++)
            CHECK(rig.working(WorkColumn::t, i) == Approx(distance[i]));
        const float u = rig.working(WorkColumn::u, 0), v = rig.working(WorkColumn::v, 0);
        check_near(glm::vec3(-9, 0, -9) * (1 - u - v) + glm::vec3(0, 0, 9) * u +
                       glm::vec3(9, 0, -9) * v,
                   {1, 0, -3});
    }
}

TEST_CASE("shade sends a connection and a next ray from a diffuse floor, by the closed forms") {
    bool seen[3] = {};
    for (uint32_t width : WIDTHS)
        for (uint32_t sample = 0; sample < 6; sample++) {
            INFO("width " << width << ", sample " << sample);
            StageRig rig = fresh_rig(width);
            rig.first_sample = sample;
            const glm::vec3 throughput(0.5f, 1, 2);
            for (uint32_t i = 0; i < 4; i++)
                put_on_floor(rig, i, 3 - i, float(i) - 1.5f, 0.5f * float(i), throughput);
            rig.run("shade");
            for (uint32_t i = 0; i < 4; i++) {
                const glm::dvec3 position(double(i) - 1.5, 0, 0.5 * double(i));
                CHECK(rig.sums[i] == glm::vec4(0));

                const glm::dvec3 direction(rig.working3(WorkColumn::direction, i));
                const double distance = double(rig.working(WorkColumn::distance, i)) / (1 - 1e-4);
                const glm::dvec3 light = direct_light(position, direction, distance);
                check_near(rig.working3(WorkColumn::origin, i), position, LIFT);
                check_near(rig.working3(WorkColumn::value, i), glm::dvec3(throughput) * light,
                           1e-3);
                seen[distance > 1e20 ? 0 : distance < 4.5 ? 1 : 2] = true;

                const glm::vec3 next = rig.path3(PathColumn::direction, i);
                CHECK(next.y > 0);
                CHECK(glm::length(next) == Approx(1).epsilon(1e-6));
                CHECK(rig.path(PathColumn::pdf, i) == Approx(next.y / M_PI).epsilon(1e-4));
                check_near(rig.path3(PathColumn::throughput, i), glm::dvec3(throughput * ALBEDO));
                check_near(rig.path3(PathColumn::origin, i), position, LIFT);
                CHECK(rig.is_alive(i));
            }
        }
    CHECK((seen[0] && seen[1] && seen[2])); // sky, point and lamp were chosen
}

TEST_CASE("shade adds the light that paths find, weighted against having sampled it") {
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        StageRig rig = fresh_rig(width);
        const glm::vec3 throughput(0.5f, 1, 2);
        rig.put_path(0, 2, {0, 2, 0}, {0, 0, -1}, throughput, 0); // past everything
        rig.put_hit(0, NAN, NAN, NAN, BVH_NONE);
        rig.put_path(1, 0, {0, 2, 0}, {0, 0, -1}, throughput, 0.1f);
        rig.put_hit(1, 1e30f, 0, 0, BVH_NONE);
        rig.put_path(2, 3, {0, 2, 0}, UP, throughput, 0.2f); // into the lamp
        rig.put_hit(2, 6, 0.25f, 0.5f, LAMP);
        rig.put_path(3, 1, {0, 9, 0}, DOWN, throughput, 0); // onto its dark back
        rig.put_hit(3, 1, 0.25f, 0.5f, LAMP);
        rig.run("shade");
        const auto weight = [](double own, double other) {
            return own * own / (own * own + other * other);
        };
        const glm::dvec3 sky(throughput * SKY), lamp(throughput * EMISSION);
        check_near(glm::vec3(rig.sums[2]), sky);
        check_near(glm::vec3(rig.sums[0]),
                   sky * weight(double(0.1f), pmf(LIGHT_ENVIRONMENT) / (4 * M_PI)), 1e-4);
        check_near(glm::vec3(rig.sums[3]),
                   lamp * weight(double(0.2f), pmf(LIGHT_TRIANGLE) * 36 / LAMP_AREA), 1e-4);
        check_near(glm::vec3(rig.sums[1]), {0, 0, 0});
        for (uint32_t i = 0; i < 4; i++) {
            CHECK(!rig.is_alive(i)); // the lamp is black
            CHECK(rig.working(WorkColumn::distance, i) == 0);
        }
    }
}

TEST_CASE("shade ends every path at the last surface that it may visit") {
    for (uint32_t width : WIDTHS) {
        StageRig rig = fresh_rig(width);
        rig.queue[(RenderOptions().depth - 1) % 2] = rig.count = 1;
        put_on_floor(rig, 0, 0, 0, 0);
        rig.run("shade", RenderOptions().depth - 1);
        CHECK(!rig.is_alive(0));
        CHECK(rig.working(WorkColumn::distance, 0) == 0);
    }
}

TEST_CASE("shade makes the survivors of roulette carry more") {
    StageRig rig = fresh_rig(16);
    rig.queue[RenderOptions().roulette_start % 2] = rig.count = 16;
    for (uint32_t i = 0; i < 16; i++) put_on_floor(rig, i, i, 0, 0, glm::vec3(0.125f));
    rig.run("shade", RenderOptions().roulette_start);
    uint32_t alive = 0;
    for (uint32_t i = 0; i < 16; i++) {
        alive += rig.is_alive(i);
        // Four times the largest component, 0.5, is the probability of surviving.
        check_near(rig.path3(PathColumn::throughput, i), 0.25 * glm::dvec3(ALBEDO));
    }
    CHECK((alive > 0 && alive < 16));
}

TEST_CASE("connect adds light where nothing is in the way, and counts the rays") {
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        StageRig rig = fresh_rig(width);
        for (uint32_t i = 0; i < 4; i++) rig.put_path(i, 3 - i, {}, UP);
        rig.sums[3] = glm::vec4(10, 20, 30, 0);
        rig.put_connection(0, {0, 1, 0}, UP, 6.9f, {1, 2, 3});    // short of the lamp
        rig.put_connection(1, {0, 1, 0}, UP, 7.1f, {1, 2, 3});    // behind it
        rig.put_connection(2, {0, 1, 0}, UP, 0, {NAN, NAN, NAN}); // no ray
        rig.put_connection(3, {5, 1, 0}, UP, 1e30f, {4, 5, 6});
        rig.run("connect");
        CHECK(rig.counters[COUNTER_SHADOW * COUNTER_BOUNCES] == 3);
        CHECK(rig.sums[3] == glm::vec4(11, 22, 33, 0));
        CHECK(rig.sums[2] == glm::vec4(0));
        CHECK(rig.sums[1] == glm::vec4(0));
        CHECK(rig.sums[0] == glm::vec4(4, 5, 6, 0));
    }
}

TEST_CASE("extend packs all that go on into the other state") {
    for (uint32_t width : WIDTHS) {
        INFO("width " << width);
        StageRig rig = rig_to_extend(width);
        rig.queue = {38, 0}; // the last two have ended
        const StageRig before = rig;
        rig.run("extend", 2);
        std::vector<std::vector<uint32_t>> got, wanted;
        for (uint32_t i = 0; i < 38; i++)
            if (from_word(before.work[WorkColumn::alive * StageRig::STRIDE + i]))
                wanted.push_back(path_words(before.state, i));
        for (uint32_t i = 0; i < wanted.size(); i++) got.push_back(path_words(rig.next_state, i));
        std::ranges::sort(got);
        std::ranges::sort(wanted);
        CHECK(got == wanted);
        CHECK(rig.queue[1] == wanted.size());
        CHECK(std::isnan(rig.next_state[PathColumn::pdf * StageRig::STRIDE + wanted.size()]));
    }
}

TEST_CASE("stages work on as many slots as the queue of their step says") {
    for (uint32_t width : WIDTHS) {
        StageRig rig = fresh_rig(width);
        rig.count = 40;
        rig.queue = {0, 33};
        for (uint32_t i = 0; i < 40; i++) rig.put_path(i, i, {0, 2, 0}, DOWN);
        rig.run("intersect", 1);
        for (uint32_t i = 0; i < 33; i++)
            CHECK(from_word(rig.working(WorkColumn::primitive, i)) == FLOOR);
    }
}

TEST_CASE("accumulate adds the samples of a pixel in their order and rejects what is not finite") {
    StageRig rig = fresh_rig(16);
    rig.count = 12;
    rig.log2_samples = 2;
    rig.first_pixel = 1;
    rig.first_sample = 8;
    Generator generator(81);
    for (uint32_t i = 0; i < rig.count; i++)
        rig.sums[i] = {unit(generator), 1e6f * unit(generator), unit(generator), 0};
    rig.sums[5].y = NAN;
    rig.sums[6].x = INFINITY;
    rig.film[0] = glm::vec4(1, 2, 3, 4);
    std::vector<glm::vec4> wanted = rig.film;
    for (uint32_t i = 0; i < rig.count; i++) {
        const uint32_t pixel = rig.pixel_order[1 + i / 4];
        if (i == 5 || i == 6) continue;
        wanted[(pixel >> 16) * 4 + (pixel & 0xffff)] += glm::vec4(glm::vec3(rig.sums[i]), 1);
    }
    rig.run("accumulate");
    for (size_t i = 0; i < wanted.size(); i++) {
        INFO("pixel " << i);
        CHECK(rig.film[i] == wanted[i]);
    }
    CHECK(rig.invalid[INVALID_COUNT] == 2);
    CHECK(rig.invalid[INVALID_PIXEL] == rig.pixel_order[2]);
    CHECK(rig.invalid[INVALID_SAMPLE] == 9);
}

TEST_CASE("tally moves the counters of a wave to the totals") {
    StageRig rig = fresh_rig(1);
    std::vector<uint64_t> totals(COUNTER_SIZE, 1ull << 40);
    for (uint32_t i = 0; i < COUNTER_SIZE; i++) rig.counters[i] = i;
    totals = rig.tally(totals);
    for (uint32_t i = 0; i < COUNTER_SIZE; i++) CHECK(totals[i] == (1ull << 40) + i);
    CHECK(rig.counters == std::vector<uint32_t>(COUNTER_SIZE));
}
