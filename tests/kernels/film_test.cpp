// The film's sums over samples that the tests make up, by the kernels of kernels/film.
#include "core/error.h"
#include "doctor/film_rig.h"
#include "kernels/columns.h"
#include "render/film.h"
#include "support/probe.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace onde::test {
namespace {

using doctor::film_options;
using doctor::mean_of;
using doctor::random_samples;
using doctor::tree_sum;

class FilmRig : public doctor::FilmRig {
  public:
    explicit FilmRig(uint32_t width, uint32_t first_sample = 0)
        : doctor::FilmRig(programs(), width, first_sample) {}
};

bool same_bytes(const FilmSums& a, const FilmSums& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool same_parts(const std::vector<FilmPart>& a, const std::vector<FilmPart>& b) {
    return std::ranges::equal(a, b, [](const FilmPart& x, const FilmPart& y) {
        return x.node == y.node && same_bytes(x.sums, y.sums);
    });
}

} // namespace

TEST_CASE("constant pixels keep their value over a million samples") {
    const std::vector<float> values{100.0f, 0.3f, 0.18f, 1e-4f};
    FilmRig rig(uint32_t(values.size()));
    std::vector<cl_float4> radiance;
    for (const float value : values)
        radiance.insert(radiance.end(), FILM_BLOCK, {{value, value, value, 0}});
    rig.place(radiance);
    constexpr uint32_t SAMPLES = 1u << 20;
    for (uint32_t i = 0; i < SAMPLES; i += FILM_BLOCK) rig.add_placed(FILM_BLOCK);
    const Image image = rig.film.develop(), counts = rig.film.develop(SAMPLE_COUNT);
    for (size_t i = 0; i < values.size(); i++) {
        const double error = double(image.pixels[3 * i]) / double(values[i]) - 1;
        INFO("a pixel of " << values[i] << " is off by " << error);
        CHECK(std::abs(error) <= 1e-6);
        CHECK(counts.pixels[i] == float(SAMPLES));
    }
}

TEST_CASE("the film is the sum over blocks of 64 that are joined as aligned pairs") {
    for (const size_t count : {1u, 5u, 63u, 64u, 65u, 127u, 128u, 129u, 192u, 448u, 640u, 1000u}) {
        const std::vector<float> samples = random_samples(count, 7);
        FilmRig rig(3);
        rig.add_all(samples);
        const Image image = rig.film.develop();
        const float mean = mean_of(samples);
        INFO(count << " samples");
        for (size_t pixel = 0; pixel < 3; pixel++) {
            CHECK(image.pixels[3 * pixel] == mean);
            CHECK(image.pixels[3 * pixel + 1] == 2 * mean);
            CHECK(image.pixels[3 * pixel + 2] == 0); // light is not below 0
        }
        CHECK(rig.film.develop(SAMPLE_COUNT).pixels == std::vector<float>(3, float(count)));
    }
}

TEST_CASE("a film goes on from its contents, wherever they were taken") {
    const std::vector<float> samples = random_samples(640, 11);
    const auto part = [&](ptrdiff_t first, ptrdiff_t end) {
        return std::vector<float>(samples.begin() + first, samples.begin() + end);
    };
    for (const ptrdiff_t cut : {0, 1, 63, 64, 65, 128, 192, 200, 256, 448, 512, 576, 639, 640}) {
        FilmRig first(2), second(2);
        first.add_all(part(0, cut));
        second.add_all(part(0, 100)); // which restore() must forget
        second.film.restore(first.film.contents());
        second.add_all(part(cut, 640));
        INFO("cut at " << cut);
        CHECK(second.film.develop().pixels[3] == mean_of(samples));
        CHECK(second.film.extent() == FilmExtent{0, 640, 0, 0});
    }
    CHECK_THROWS_WITH(FilmRig(3).film.restore(FilmRig(2).film.contents()), Catch::Contains("2x1"));
}

TEST_CASE("pixels that an interrupted pass did not reach have the mean of fewer samples") {
    const std::vector<float> samples = random_samples(84, 13);
    FilmRig rig(2);
    rig.add_all({samples.begin(), samples.begin() + 80});
    std::vector<cl_float4> radiance;
    for (size_t i = 80; i < 84; i++) radiance.push_back({{samples[i], 0, 0, 0}});
    for (size_t i = 0; i < 4; i++) radiance.push_back({}); // of the pixel that has to wait
    rig.place(radiance);
    const FilmContents before = rig.film.contents();
    rig.add_placed(4);
    FilmContents interrupted = rig.film.contents();
    interrupted.extent = {0, 80, 4, 1};
    interrupted.block[1] = before.block[1];
    rig.film.restore(interrupted);
    CHECK(rig.film.samples() == 82);
    const Image image = rig.film.develop();
    CHECK(image.pixels[0] == mean_of(samples));
    CHECK(image.pixels[3] == mean_of({samples.begin(), samples.begin() + 80}));
    CHECK(rig.film.develop(SAMPLE_COUNT).pixels == std::vector<float>{84, 80});
    CHECK(rig.film.begin_pass(80, 4, 2) == 1);
    CHECK_THROWS_AS(rig.film.begin_pass(80, 2, 2), InputError);
    CHECK_THROWS_AS(rig.film.begin_pass(84, 4, 2), InputError);
}

TEST_CASE("a pass lies in one block and follows what the film has") {
    FilmRig rig(1);
    CHECK_THROWS_AS(rig.film.begin_pass(60, 8, 1), InputError);
    CHECK_THROWS_AS(rig.film.begin_pass(0, 0, 1), InputError);
    CHECK_THROWS_AS(rig.film.begin_pass(56, 8, 1), InputError);
    CHECK(rig.film.begin_pass(64, 56, 1) == 0);
    rig.film.end_wave(1);
    CHECK_THROWS_AS(rig.film.begin_pass(64, 56, 1), InputError);
    CHECK_THROWS_AS(rig.film.begin_pass(128, 8, 1), InputError);
    CHECK(rig.film.begin_pass(120, 8, 1) == 0);
    rig.film.end_wave(1);
    CHECK(rig.film.begin_pass(128, 64, 1) == 0);
    rig.film.clear();
    CHECK(rig.film.begin_pass(0, 64, 1) == 0);
}

TEST_CASE("a film that begins late is the tree without the samples before") {
    std::vector<float> samples = random_samples(1000, 17);
    std::fill(samples.begin(), samples.begin() + 320, 0.0f);
    FilmRig rig(1);
    rig.film.begin_pass(320, 1, 1);
    rig.add_all({samples.begin() + 320, samples.end()});
    CHECK(rig.film.develop().pixels[0] == tree_sum(samples, 0, 1000) / 680.0f);
    CHECK(rig.film.samples() == 680);
}

TEST_CASE("a film takes a buffer for every doubling of its blocks, and none for one block") {
    const auto buffers = [](uint32_t samples) {
        gpu::BufferList list;
        plan_film(list, film_options(70, 0, samples));
        const auto sums = list.sizes().size() - 1; // the last buffer counts invalid samples
        CHECK(list.sizes().back().name == "invalid samples");
        CHECK(gpu::total_bytes(list.sizes()) - list.sizes().back().bytes == sums * 70 * 16);
        return sums;
    };
    CHECK(buffers(1) == 1);
    CHECK(buffers(64) == 1);
    CHECK(buffers(65) == 2);
    CHECK(buffers(128) == 2);
    CHECK(buffers(129) == 3);
    CHECK(buffers(1u << 20) == 15);
    for (const uint32_t samples : {64u, 128u, 192u, 640u}) {
        FilmRig rig(1);
        rig.place(std::vector<cl_float4>(FILM_BLOCK, {{1, 1, 1, 0}}));
        const uint64_t before = device().allocated_bytes();
        for (uint32_t done = 0; done < samples; done += FILM_BLOCK) rig.add_placed(FILM_BLOCK);
        CHECK((device().allocated_bytes() - before) / sizeof(cl_float4) + 1 == buffers(samples));
    }
}

TEST_CASE("blocks are covered by whole nodes, as few as can be") {
    for (uint32_t begin = 0; begin < 40; begin++)
        for (uint32_t end = begin; end < 40; end++) {
            uint64_t at = begin;
            const std::vector<FilmNode> nodes = cover(begin, end);
            for (const FilmNode& node : nodes) {
                CHECK(node.first_block() == at);
                at = node.end_block();
            }
            CHECK(at == end);
            for (size_t i = 1; i < nodes.size(); i++)
                CHECK_FALSE((nodes[i].is_right() && nodes[i - 1] == nodes[i].sibling()));
        }
}

TEST_CASE("a film that begins at any block keeps only whole nodes of the tree") {
    const std::vector<float> samples = random_samples(1000, 13);
    for (const uint32_t first : {64u, 128u, 192u, 320u, 448u, 832u, 960u})
        for (const uint32_t end : {first + 1, 128u, 512u, 640u, 1000u}) {
            if (end <= first) continue;
            FilmRig rig(1, first);
            rig.add_all({samples.begin() + first, samples.begin() + end});
            const FilmContents contents = rig.film.contents();
            INFO("samples " << first << " to " << end);
            std::vector<FilmNode> nodes;
            for (const FilmPart& part : contents.parts) {
                nodes.push_back(part.node);
                CHECK(part.sums[0].s[0] == tree_sum(samples, part.node.first_block() * FILM_BLOCK,
                                                    part.node.end_block() * FILM_BLOCK));
            }
            CHECK(nodes == cover(first / FILM_BLOCK, end / FILM_BLOCK));
            CHECK(contents.block[0].s[0] == tree_sum(samples, end / FILM_BLOCK * FILM_BLOCK, end));
            CHECK(rig.film.develop(SAMPLE_COUNT).pixels[0] == float(end - first));
            FilmRig resumed(1, first);
            resumed.film.restore(contents);
            CHECK(resumed.film.develop().pixels == rig.film.develop().pixels);
            CHECK(same_parts(resumed.film.contents().parts, contents.parts));
        }
}

TEST_CASE("films of some blocks add up to the film of all, bit for bit") {
    const std::vector<float> samples = random_samples(1000, 17);
    FilmRig whole(1);
    whole.add_all(samples);
    const FilmContents expected = whole.film.contents();
    for (const std::vector<uint32_t>& borders :
         {std::vector<uint32_t>{0, 64, 1000},
          {0, 128, 192, 1000},
          {0, 448, 512, 576, 1000},
          {0, 64, 128, 192, 256, 320, 384, 448, 512, 576, 640, 704, 768, 832, 896, 960, 1000}}) {
        std::vector<FilmPart> parts;
        for (size_t i = 0; i + 1 < borders.size(); i++) {
            FilmRig rig(1, borders[i]);
            rig.add_all({samples.begin() + borders[i], samples.begin() + borders[i + 1]});
            const FilmContents contents = rig.film.contents();
            for (const FilmPart& part : contents.parts) add_part(parts, part);
            if (i + 2 == borders.size()) CHECK(same_bytes(contents.block, expected.block));
        }
        INFO(borders.size() - 1 << " films, the first of " << borders[1] << " samples");
        CHECK(same_parts(parts, expected.parts));
    }
}

TEST_CASE("a film begins and goes on only where the tree allows it") {
    FilmRig rig(1);
    CHECK_THROWS_WITH(rig.film.begin_pass(65, 1, 1), Catch::Contains("can't follow"));
    CHECK_THROWS_WITH(FilmRig(1, 64).film.restore(rig.film.contents()),
                      Catch::Contains("from sample 64 on"));
}

} // namespace onde::test
