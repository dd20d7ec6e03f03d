#include "scene/shutter.h"

#include "scene/loaders.h"
#include "scene/merge.h"
#include "scene/scene.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

using Matrices = std::vector<glm::mat4>;

/// The most keys of a thing, and the most moments that a file is asked for.
constexpr size_t MOST_STEPS = 512, MOST_MOMENTS = 33;

/// A transform that moves, turns and stretches, in this order from the left.
struct Pose {
    glm::dvec3 move{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dmat3 stretch{1.0};
};

/// The rotation next to a matrix (Higham 1986); mirrors are left to the stretch.
glm::dmat3 rotation_of(const glm::dmat3& m) {
    glm::dmat3 r = glm::determinant(m) < 0.0 ? -1.0 * m : m;
    for (int i = 0; i < 64; ++i) {
        const glm::dmat3 next = 0.5 * (r + glm::transpose(glm::inverse(r)));
        const glm::dmat3 change = next - r;
        r = next;
        if (glm::length(change[0]) + glm::length(change[1]) + glm::length(change[2]) < 1e-14) break;
    }
    return r;
}

Pose pose_of(const glm::dmat4& matrix) {
    const glm::dmat3 m(matrix), turn = rotation_of(m);
    return {glm::dvec3(matrix[3]), glm::quat_cast(turn), glm::transpose(turn) * m};
}

/// Radians between two of them.
double angle_between(const glm::dquat& a, const glm::dquat& b) {
    return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

glm::dmat4 mixed(const Pose& a, const Pose& b, double share) {
    const glm::dmat3 turn = glm::mat3_cast(glm::slerp(a.turn, b.turn, share));
    glm::dmat4 m(turn * (a.stretch * (1.0 - share) + b.stretch * share));
    m[3] = glm::dvec4(glm::mix(a.move, b.move, share), 1.0);
    return m;
}

/// By how much a thing turns from one place to the next, at most.
double largest_turn(const std::vector<Pose>& poses) {
    double largest = 0.0;
    for (size_t i = 1; i < poses.size(); ++i)
        largest = std::max(largest, angle_between(poses[i - 1].turn, poses[i].turn));
    return largest;
}

bool stands_still(const Matrices& places) {
    return std::ranges::all_of(places, [&](const glm::mat4& m) { return m == places[0]; });
}

/// Whether mixing the first and the last gives all that lie between, but for rounding.
bool is_straight(const Matrices& places) {
    constexpr float ROUNDING = 1e-5f;
    const glm::mat4 way = places.back() - places.front();
    for (size_t i = 0; i < places.size(); ++i) {
        const float share = float(i) / float(places.size() - 1);
        const glm::mat4 off = places[i] - (places.front() + share * way);
        for (glm::length_t column = 0; column < 4; ++column)
            if (glm::length(off[column]) > ROUNDING * glm::length(way[column])) return false;
    }
    return true;
}

std::vector<Pose> poses_of(const Matrices& places) {
    std::vector<Pose> poses;
    for (const glm::mat4& place : places) poses.push_back(pose_of(glm::dmat4(place)));
    return poses;
}

/// Whether straight ways and even turns between these places may be far from those of the file.
bool is_bent(const Matrices& places) {
    constexpr double FAR_TURN = 0.17, BENT = 0.02; // radians; of the way
    if (stands_still(places)) return false;
    const std::vector<Pose> poses = poses_of(places);
    for (size_t i = 1; i + 1 < poses.size(); ++i) {
        const glm::dvec3 way = poses[i + 1].move - poses[i - 1].move;
        const glm::dvec3 off = poses[i].move - 0.5 * (poses[i + 1].move + poses[i - 1].move);
        const double path = glm::length(poses[i + 1].move - poses[i].move) +
                            glm::length(poses[i].move - poses[i - 1].move);
        if (glm::length(off) > BENT * std::max(glm::length(way), path)) return true;
    }
    return largest_turn(poses) > FAR_TURN;
}

/// Where the things of a scene are at moments of the shutter; of each, a list of as many.
struct Places {
    std::vector<Matrices> instances, shapes, spheres, cameras;

    template <class Visit>
    void for_each(const Visit& visit) {
        for (auto* things : {&instances, &shapes, &spheres, &cameras})
            for (Matrices& places : *things) visit(places);
    }
};

glm::mat4 place_of(const Sphere& sphere) {
    return glm::scale(glm::translate(glm::mat4(1.0f), sphere.center), glm::vec3(sphere.radius));
}

/// Where they are at one moment; `others` are the instances of `then` that belong to the scene's.
struct Moment {
    Matrices instances, shapes, spheres, cameras;
};

Moment moment_of(const Scene& scene, const Scene& then,
                 const std::vector<std::optional<size_t>>& others) {
    Moment m;
    for (size_t i = 0; i < scene.instances.size(); ++i)
        m.instances.push_back(others[i] ? then.instances[*others[i]].object_to_world
                                        : scene.instances[i].object_to_world);
    const auto take = [](const auto& ours, const auto& theirs, const auto& place, Matrices& to) {
        const auto& counted = ours.size() == theirs.size() ? theirs : ours;
        for (const auto& thing : counted) to.push_back(place(thing));
    };
    const auto object_to_world = [](const Shape& s) { return s.object_to_world; };
    const auto camera_to_world = [](const Camera& c) { return c.camera_to_world; };
    take(scene.shapes, then.shapes, object_to_world, m.shapes);
    take(scene.spheres, then.spheres, place_of, m.spheres);
    take(scene.cameras, then.cameras, camera_to_world, m.cameras);
    return m;
}

Moment own_moment(const Scene& scene) {
    std::vector<std::optional<size_t>> same;
    for (size_t i = 0; i < scene.instances.size(); ++i) same.emplace_back(i);
    return moment_of(scene, scene, same);
}

/// Thing by thing.
Places places_of(const std::vector<Moment>& moments) {
    Places places;
    const auto transpose = [&](const auto member, std::vector<Matrices>& to) {
        to.resize((moments[0].*member).size());
        for (const Moment& moment : moments)
            for (size_t i = 0; i < to.size(); ++i) to[i].push_back((moment.*member)[i]);
    };
    transpose(&Moment::instances, places.instances);
    transpose(&Moment::shapes, places.shapes);
    transpose(&Moment::spheres, places.spheres);
    transpose(&Moment::cameras, places.cameras);
    return places;
}

/// What a file shows while the shutter is open.
class Recorder {
  public:
    Recorder(const Scene& scene, const std::filesystem::path& path, LoadOptions options,
             double seconds)
        : scene_(scene), path_(path), options_(std::move(options)), seconds_(seconds) {
        options_.only_shapes = true;
        options_.environment.reset();
        options_.stage = Stage{.origin = scene.origin, .exponent = scene.exponent};
    }

    /// As many moments as the motion asks for.
    Places record() {
        moments_ = {own_moment(scene_), load(0.5), load(1.0)};
        Places places = places_of(moments_);
        while (moments_.size() < MOST_MOMENTS && is_bent_somewhere(places)) {
            double_moments();
            places = places_of(moments_);
        }
        return places;
    }

    /// Instances that change their meshes meanwhile, or come and go.
    size_t deforming() const { return deforming_; }

  private:
    Moment load(double share) {
        options_.at = *scene_.moment + share * seconds_;
        const Scene then = load_uncompleted(path_, options_);
        const auto others = counterparts(scene_, then);
        count_deforming(then, others);
        return moment_of(scene_, then, others);
    }

    void count_deforming(const Scene& then, const std::vector<std::optional<size_t>>& others) {
        size_t count = 0;
        for (size_t i = 0; i < others.size(); ++i)
            count += !others[i] || scene_.meshes[scene_.instances[i].mesh].positions !=
                                       then.meshes[then.instances[*others[i]].mesh].positions;
        deforming_ = std::max(deforming_, count);
    }

    static bool is_bent_somewhere(Places& places) {
        bool bent = false;
        places.for_each([&](const Matrices& of_thing) { bent |= is_bent(of_thing); });
        return bent;
    }

    void double_moments() {
        const double steps = 2.0 * double(moments_.size() - 1);
        std::vector<Moment> more{moments_[0]};
        for (size_t i = 1; i < moments_.size(); ++i) {
            more.push_back(load((2.0 * double(i) - 1.0) / steps));
            more.push_back(moments_[i]);
        }
        moments_ = std::move(more);
    }

    const Scene& scene_;
    const std::filesystem::path& path_;
    LoadOptions options_;
    double seconds_;
    std::vector<Moment> moments_;
    size_t deforming_ = 0;
};

std::vector<MotionKeys> keys_of(const std::vector<Matrices>& things) {
    std::vector<MotionKeys> keys;
    for (const Matrices& places : things) keys.push_back(motion_keys(places));
    return keys;
}

/// Spheres that move become shapes, which have transforms.
void move_spheres(Scene& scene, const std::vector<Matrices>& places) {
    std::vector<Sphere> still;
    for (size_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& sphere = scene.spheres[i];
        MotionKeys keys = motion_keys(places[i]);
        if (keys.empty()) {
            still.push_back(sphere);
            continue;
        }
        scene.shapes.push_back(
            {ShapeKind::sphere, sphere.material, 0.25f, place_of(sphere), sphere.name});
        scene.shutter->shapes.push_back(std::move(keys));
    }
    scene.spheres = std::move(still);
}

/// Moving things that shine.
size_t count_shining(const Scene& scene) {
    const auto shines = [&](uint32_t material) {
        return scene.materials[material].emission != glm::vec3(0.0f);
    };
    size_t count = 0;
    for (size_t i = 0; i < scene.instances.size(); ++i)
        count += !scene.shutter->instances[i].empty() &&
                 std::ranges::any_of(scene.meshes[scene.instances[i].mesh].materials, shines);
    for (size_t i = 0; i < scene.shapes.size(); ++i)
        count += !scene.shutter->shapes[i].empty() && shines(scene.shapes[i].material);
    return count;
}

void note_limits(Scene& scene, size_t deforming) {
    if (deforming > 0)
        scene.notes.push_back(fmt::format(
            "{} of {} things change their shape while the shutter is open: only their places are "
            "blurred.",
            deforming, scene.instances.size()));
    if (const size_t shining = scene.shutter ? count_shining(scene) : 0)
        scene.notes.push_back(fmt::format(
            "{} things that shine move while the shutter is open: only paths that meet them find "
            "their light, which takes more samples.",
            shining));
}

} // namespace

bool ShutterMotion::empty() const {
    const auto still = [](const MotionKeys& keys) { return keys.empty(); };
    return std::ranges::all_of(instances, still) && std::ranges::all_of(shapes, still) &&
           std::ranges::all_of(cameras, still);
}

glm::dmat4 between(const glm::dmat4& from, const glm::dmat4& to, double share) {
    return mixed(pose_of(from), pose_of(to), share);
}

MotionKeys motion_keys(const std::vector<glm::mat4>& places) {
    constexpr double FLATTER = 2e-4; // than a circle, by its radius
    if (stands_still(places)) return {};
    const std::vector<Pose> poses = poses_of(places);
    if (largest_turn(poses) < 1e-6 && is_straight(places)) return {places.front(), places.back()};
    const size_t intervals = places.size() - 1;
    const double most = 2.0 * std::acos(1.0 - FLATTER);
    const auto wanted = size_t(std::max(1.0, std::ceil(largest_turn(poses) / most)));
    const size_t steps = std::min(wanted, std::max<size_t>(1, MOST_STEPS / intervals));
    MotionKeys keys;
    for (size_t i = 0; i < intervals; ++i) {
        keys.push_back(places[i]);
        for (size_t k = 1; k < steps; ++k)
            keys.emplace_back(mixed(poses[i], poses[i + 1], double(k) / double(steps)));
    }
    keys.push_back(places.back());
    return keys;
}

void load_shutter(Scene& scene, const std::filesystem::path& path, LoadOptions options,
                  double seconds) {
    if (!scene.moment || !(seconds > 0.0)) return;
    Recorder recorder(scene, path, std::move(options), seconds);
    const Places places = recorder.record();
    scene.shutter =
        ShutterMotion{keys_of(places.instances), keys_of(places.shapes), keys_of(places.cameras)};
    move_spheres(scene, places.spheres);
    if (scene.shutter->empty()) scene.shutter.reset();
    note_limits(scene, recorder.deforming());
}

} // namespace onde
