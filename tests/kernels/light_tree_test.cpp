// The light tree: bounds on the host, choices and their probabilities on the device.
#include "doctor/light_rig.h"
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"
#include "upload/light_tree.h"

#include <catch2/catch.hpp>

#include <numeric>

using namespace onde;
using namespace onde::test;
using namespace onde::doctor::lights;

namespace {

const LightOptions BY_TREE{.sampler = LightSampler::tree};

LightBounds random_bounds(Generator& generator) {
    LightBounds b;
    b.low = glm::dvec3(unit(generator), unit(generator), unit(generator)) * 100.0;
    b.high = b.low + glm::dvec3(unit(generator), unit(generator), 0);
    b.axis = glm::normalize(glm::dvec3(unit_vector(generator)));
    b.spread = generator() % 3 ? 0 : 3 * unit(generator);
    b.reach = M_PI / 2;
    b.power = 0.01 + double(unit(generator));
    return b;
}

glm::dvec3 vector_of(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

/// Whether a branch's bounds hold a light's; empty, or what they leave out.
std::string bound_failure(const LightBranch& of, const LightBounds& light) {
    const BranchBounds branch = onde::bounds_of(of);
    if (branch.radius < 0) return {};
    for (int corner = 0; corner < 8; corner++) {
        const glm::dvec3 p(corner & 1 ? light.low.x : light.high.x,
                           corner & 2 ? light.low.y : light.high.y,
                           corner & 4 ? light.low.z : light.high.z);
        const double off = glm::length(p - branch.center) - branch.radius;
        if (off > 1e-40) return fmt::format("a corner is {} outside of the sphere", off);
    }
    if (std::abs(glm::length(branch.axis) - 1) > 0.02) return "its axis is not unit";
    const double apart =
        std::acos(std::clamp(glm::dot(glm::normalize(branch.axis), light.axis), -1.0, 1.0));
    const double spread = std::acos(branch.cosine_of_spread);
    constexpr double AXIS_ERROR = 4e-3; // of short components; what it reaches has room for that
    if (std::min(apart + light.spread, M_PI) > spread + AXIS_ERROR)
        return fmt::format("normals to {} are outside of the cone of {}", apart + light.spread,
                           spread);
    if (branch.cosine_of_reach > std::cos(light.reach) + 1e-6) return "it reaches less far";
    return {};
}

/// Follows every light's trail; empty when each ends at the light, below branches that hold it and
/// have the power of what is below them.
std::string tree_failure(const LightTree& tree, const std::vector<LightBounds>& local,
                         const std::vector<double>& everywhere) {
    std::vector<double> powers(tree.branches.size());
    for (uint32_t light = 0; light < tree.trails.size(); light++) {
        uint32_t trail = tree.trails[light], pair = 0;
        for (uint32_t level = 0;; level++, trail >>= 1) {
            if (level == MOST_LIGHT_LEVELS) return fmt::format("light {} lies too deep", light);
            const uint32_t at = pair + (trail & 1);
            const LightBranch& branch = tree.branches.at(at);
            powers[at] +=
                light < local.size() ? local[light].power : everywhere[light - local.size()];
            const std::string failure =
                light < local.size() ? bound_failure(branch, local[light]) : std::string();
            if (!failure.empty()) return fmt::format("light {}: {}", light, failure);
            pair = branch.next;
            if (pair == (LIGHT_LEAF | light)) break;
            if (pair >= LIGHT_LEAF) return fmt::format("light {} has another's leaf", light);
        }
    }
    for (size_t i = 0; i < powers.size(); i++)
        if (!(std::abs(powers[i] - double(tree.branches[i].power)) <= 1e-5 * powers[i]))
            return fmt::format("branch {} has power {} instead of {}", i, tree.branches[i].power,
                               powers[i]);
    return {};
}

std::string build_failure(const std::vector<LightBounds>& local,
                          const std::vector<double>& everywhere) {
    return tree_failure(build_light_tree(local, everywhere), local, everywhere);
}

/// Squares of one row, some almost black.
Scene row_of_lamps(size_t count, size_t dim) {
    Scene scene;
    for (size_t i = 0; i < count + dim; i++) {
        const float x = float(i);
        doctor::add_triangle(scene, {x, 5, 0}, {x + 0.5f, 5, 0}, {x, 5, 0.5f},
                             emitter(i < count ? 10.0f : 1e-4f));
        scene.materials.back().emission = glm::vec3(i < count ? 10.0f : 1e-4f);
    }
    return scene;
}

/// All points see the same lights: inside their cube, beside it, far from it.
const glm::vec3 POINTS[] = {{5, 5, 5}, {0.3f, 9, 4}, {-3, 2, 5}, {40, -70, 20}, {5, 3000, 5}};

} // namespace

TEST_CASE("every light's trail leads to its leaf, through bounds that hold it") {
    Generator generator(76);
    for (const size_t count : {0u, 1u, 2u, 3u, 17u, 5000u})
        for (const size_t others : {0u, 1u, 5u}) {
            INFO(count << " lights that have a place, " << others << " that have none");
            std::vector<LightBounds> local;
            for (size_t i = 0; i < count; i++) local.push_back(random_bounds(generator));
            std::vector<double> everywhere(others, 0.25);
            CHECK(build_light_tree(local, everywhere).branches.empty() == (count + others < 2));
            if (count + others >= 2) CHECK(build_failure(local, everywhere) == "");
        }
}

TEST_CASE("a light tree is never deeper than its trails are long") {
    std::vector<LightBounds> row, heap;
    Generator generator(77);
    for (int i = 0; i < 1000; i++) { // each as far from the next as all before are long
        LightBounds b = random_bounds(generator);
        b.low = b.high = glm::dvec3(std::exp2(-i), 0, 0);
        row.push_back(b);
        b.low = b.high = glm::dvec3(1, 2, 3);
        heap.push_back(b);
    }
    CHECK(build_failure(row, {1.0}) == "");
    CHECK(build_failure(heap, {}) == "");
}

TEST_CASE("the probabilities of all lights sum to one wherever they are chosen from") {
    SceneProbe probe(many_lights(300), {"light_choice"}, 1, {}, BY_TREE);
    REQUIRE(probe.packed().features.light_tree);
    for (const glm::vec3 point : POINTS)
        for (const glm::vec3 normal :
             {glm::vec3(0), glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, -0.8f)}) {
            INFO(point.x << " " << point.y << " " << point.z << ", normal " << normal.x);
            const std::vector<double> all = choice_probabilities(probe, point, normal);
            CHECK(std::accumulate(all.begin(), all.end(), 0.0) == Approx(1).epsilon(1e-5));
        }
}

TEST_CASE("lights are chosen with the probability that the light tree tells of them") {
    SceneProbe probe(many_lights(300), {"light_choice"}, 1, {}, BY_TREE);
    constexpr size_t COUNT = 1 << 16;
    Generator generator(78);
    for (const glm::vec3 point : POINTS) {
        INFO(point.x << " " << point.y << " " << point.z);
        CHECK(choice_failure(probe, point, {0, -1, 0}, COUNT, 1e-4 / 5) == "");
        ChoiceInput input{std::vector(COUNT, point), std::vector(COUNT, glm::vec3(0, -1, 0)),
                          uniform_column(generator, COUNT), word_column(COUNT, 0)};
        const LightChoices first = choose_lights(probe, input);
        for (size_t i = 0; i < COUNT; i++) input.asked[i] = doctor::word(first.light[i]);
        CHECK(first_bit_difference({choose_lights(probe, input).pmf_of_asked}, {first.pmf}) == "");
        std::vector<double> tenths(10);
        for (const float rest : first.rest) tenths[size_t(10 * rest)]++;
        CHECK(chi_square_failure(tenths, std::vector<double>(10, COUNT / 10.0), 1e-4 / 5) == "");
    }
}

TEST_CASE("a light that the tree never chooses sends nothing to the point") {
    const Scene scene = many_lights(300);
    SceneProbe probe(scene, {"light_choice"}, 1, {}, BY_TREE);
    size_t never = 0;
    for (const glm::vec3 point : POINTS) {
        const glm::vec3 normal(0, 0.6f, 0.8f);
        const std::vector<double> all = choice_probabilities(probe, point, normal);
        for (size_t i = 0; i < all.size(); i++) {
            const LightRecord& light = probe.packed().lights[i];
            const bool is_outside = light.trail == LIGHT_OUTSIDE_TREE;
            if (all[i] > 0 || light.kind != LIGHT_TRIANGLE || is_outside) continue;
            never++;
            const TriangleLightRecord& t = light.as.triangle;
            const glm::dvec3 corner = vector_of(t.corner), a = vector_of(t.edge1);
            const glm::dvec3 b = vector_of(t.edge2);
            const glm::dvec3 front = double(t.orientation) * glm::cross(a, b);
            const bool behind = glm::dot(glm::dvec3(point) - corner, front) <= 1e-5;
            const auto height = [&](glm::dvec3 p) {
                return glm::dot(p - glm::dvec3(point), glm::dvec3(normal));
            };
            const double highest =
                std::max({height(corner), height(corner + a), height(corner + b)});
            INFO("light " << i);
            CHECK((behind || highest <= 1e-5));
        }
    }
    CHECK(never > 100);
}

TEST_CASE("samples by the light tree have the mean of all lights, one after the other") {
    Scene scene;
    Generator generator(79);
    for (int i = 0; i < 60; i++) {
        const glm::vec3 at(8 * unit(generator), 2 + unit(generator), 8 * unit(generator));
        add_triangle(scene, at, at + glm::vec3(0.5f, 0, 0), at + glm::vec3(0, 0.1f, 0.5f),
                     emitter(1 + 3 * unit(generator)));
    }
    const glm::vec3 from(2, 0, 3);
    std::vector<double> each; // irradiance of a floor, in red
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Triangle t{mesh.positions[0], mesh.positions[1], mesh.positions[2]};
        each.push_back(projected_solid_angle(t, from) *
                       double(scene.materials[mesh.materials[0]].emission.x));
    }
    std::vector<double> deviations;
    for (const LightSampler sampler : {LightSampler::power, LightSampler::tree}) {
        INFO(word_of(sampler));
        SceneProbe probe(scene, {"light_sample"}, 1, {}, {.sampler = sampler});
        double expected = 0;
        for (size_t i = 0; i < each.size(); i++)
            if (probe.packed().lights[i].trail != LIGHT_OUTSIDE_TREE) expected += each[i];
        const LightSamples samples = sample(probe, from, 1 << 16);
        double sum = 0, squares = 0;
        for (size_t i = 0; i < samples.pdf.size(); i++) {
            const double value = samples.valid[i] == 0
                                     ? 0.0
                                     : double(samples.radiance[i].x) *
                                           double(samples.direction[i].y) / double(samples.pdf[i]);
            sum += value / double(1 << 16);
            squares += value * value / double(1 << 16);
        }
        deviations.push_back(std::sqrt((squares - sum * sum) / (1 << 16)));
        CHECK(sum == Approx(expected).margin(5 * deviations.back()));
    }
    CHECK(deviations[1] < 0.6 * deviations[0]);
}

TEST_CASE("the light tree is for many lights, or for whom asks for it") {
    const auto has_tree = [](size_t count, LightSampler sampler) {
        return pack_scene(many_lights(count), {}, {.sampler = sampler}).features.light_tree;
    };
    CHECK(has_tree(100, LightSampler::automatic));
    CHECK_FALSE(has_tree(3, LightSampler::automatic));
    CHECK_FALSE(has_tree(100, LightSampler::power));
    CHECK(has_tree(3, LightSampler::tree));
}

TEST_CASE("choices by the light tree have the same bits at every width, beside dead lanes") {
    const Scene scene = many_lights(300);
    constexpr size_t FEW = 4096;
    Generator generator(80);
    Columns in(9, Column(FEW));
    for (size_t i = 0; i < FEW; i++) {
        const bool live = i / 16 % 5 && generator() % 3;
        const glm::vec3 normal = unit_vector(generator);
        for (uint32_t k = 0; k < 3; k++) {
            in[k][i] = live ? 12 * unit(generator) - 1 : NAN;
            in[3 + k][i] = live ? normal[k] : -INFINITY;
        }
        in[6][i] = live ? unit(generator) : NAN;
        in[7][i] = doctor::word(uint32_t(generator() % 300));
        in[8][i] = live;
    }
    SceneProbe scalar(scene, {"light_choice"}, 1, {}, BY_TREE);
    const Columns expected = scalar.run("light_choice", in, 4);
    for (const uint32_t width : {8u, 16u}) {
        INFO("width " << width);
        SceneProbe wide(scene, {"light_choice"}, width, {}, BY_TREE);
        CHECK(first_bit_difference(wide.run("light_choice", in, 4), expected, in[8]) == "");
    }
}

TEST_CASE("what is all but black is left to rays, and the tree's other lights stay as likely") {
    SceneProbe probe(row_of_lamps(20, 40), {"light_choice"}, 1, {}, BY_TREE);
    CHECK(probe.packed().light_tree.size() == 2 * 19);
    const std::vector<double> all = choice_probabilities(probe, {5, 0, 0}, {0, 1, 0});
    CHECK(std::accumulate(all.begin(), all.end(), 0.0) == Approx(1).epsilon(1e-5));
    for (size_t i = 0; i < all.size(); i++) CHECK((all[i] > 0) == (i < 20));
    const auto has_tree = [](size_t count, size_t dim) {
        return pack_scene(row_of_lamps(count, dim)).features.light_tree;
    };
    CHECK(has_tree(12, 0));
    CHECK_FALSE(has_tree(11, 40));
    Scene points; // which no ray finds
    for (int i = 0; i < 20; i++)
        points.point_lights.push_back({{float(i), 0, 0}, glm::vec3(i < 10 ? 1.0f : 1e-6f)});
    CHECK(pack_scene(points).light_tree.size() == 2 * 19);
}

TEST_CASE("glowing details of a texture have no tree beside a far stronger environment") {
    Scene scene = row_of_lamps(40, 0);
    Texture texture;
    texture.image.width = texture.image.height = 1;
    texture.image.rgba = {255, 255, 255, 255};
    scene.textures.push_back(texture);
    const auto has_tree = [&] { return pack_scene(scene).features.light_tree; };
    CHECK(has_tree());
    scene.environment.radiance = glm::vec3(10);
    CHECK(has_tree()); // lamps in a hall that the sky may not reach
    for (Material& material : scene.materials) material.emission_texture = 0;
    CHECK_FALSE(has_tree());
    CHECK(pack_scene(scene, {}, BY_TREE).features.light_tree);
    scene.environment.radiance = glm::vec3(1e-3f);
    CHECK(has_tree());
}
