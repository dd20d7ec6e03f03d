// What of a session may be changed while it lives, and what that costs.
#include "session/session.h"

#include "core/error.h"
#include "render/frame.h"
#include "scene/check.h"
#include "session/choices.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace onde {
namespace {

/// Whether two materials make the same lights and tangents of the surfaces that have them.
bool same_geometry(const Material& a, const Material& b) {
    return a.emission == b.emission && a.emission_texture == b.emission_texture &&
           a.two_sided == b.two_sided && tangent_map_of(a) == tangent_map_of(b) &&
           has_tangents(a) == has_tangents(b) && a.blend_with == b.blend_with && a.group == b.group;
}

/// Whether a film of the one is a beginning of a film of the other.
bool same_but_for_length(RenderOptions a, const RenderOptions& b) {
    a.samples = b.samples;
    a.seconds = b.seconds;
    a.picture_samples = b.picture_samples;
    return a == b;
}

template <class T>
T& find(std::vector<T>& things, size_t index, const char* kind) {
    if (index < things.size()) return things[index];
    throw InputError("there is no {} {}; the scene has {}", kind, index, things.size());
}

} // namespace

void Session::set_options(const RenderOptions& options) {
    check_options(options);
    check_light_groups(scene_, options);
    if (options.camera >= scene_.cameras.size())
        throw InputError("there is no camera {}; the scene has {}", options.camera,
                         scene_.cameras.size());
    check_view(scene_.cameras[options.camera], options);
    const RenderOptions before = std::exchange(options_.render, options);
    const bool same_film = same_but_for_length(before, options);
    try {
        complete_next_frame();
        placed_->set_features(features_of(placed_->packed()));
        if (!same_film) fit_waves(packed());
        if (options.width != before.width || options.integrator != before.integrator)
            denoiser_ = make_denoiser();
    } catch (...) {
        options_.render = before;
        placed_->set_features(features_of(placed_->packed()));
        throw;
    }
    if (same_film) return;
    integrator_.reset();
    if (options.integrator != before.integrator) note_mapping();
}

void Session::set_camera(const Camera& value) {
    check_camera(value, options_.render.camera);
    check_view(value, options_.render);
    scene_.cameras[options_.render.camera] = value;
    if (scene_.next) scene_.next->cameras[options_.render.camera] = value;
    if (is_wide(value) && !placed_->packed().features.projections) changed(SceneChange::materials);
    if (scene_.shutter &&
        !std::exchange(scene_.shutter->cameras[options_.render.camera], {}).empty())
        changed(SceneChange::transforms);
    placed_->set_next_view(scene_);
    if (value.orthographic_height && !placed_->packed().bounds) placed_->set_bounds(scene_);
    if (integrator_ && !integrator_->set_camera(value)) integrator_.reset();
}

void Session::set_environment_rotation(float radians) {
    if (!std::isfinite(radians)) throw InputError("the environment's rotation must be finite");
    scene_.environment.rotation = radians;
    placed_->set_environment_rotation(radians);
    if (scene_.next) scene_.next->environment_rotation = radians;
    placed_->set_next_view(scene_);
    if (integrator_ && !integrator_->set_camera(camera())) integrator_.reset();
}

void Session::set_next_view(const Camera& value, float environment_rotation) {
    check_camera(value, options_.render.camera);
    if (!std::isfinite(environment_rotation))
        throw InputError("the environment's rotation must be finite");
    if (!scene_.next) return;
    scene_.next->cameras[options_.render.camera] = value;
    scene_.next->environment_rotation = environment_rotation;
    placed_->set_next_view(scene_);
    if (integrator_ && !integrator_->set_camera(camera())) integrator_.reset();
}

void Session::set_material(size_t index, const Material& value) {
    Material& material = find(scene_.materials, index, "material");
    const Material before = std::exchange(material, value);
    try {
        check_material(scene_, index);
        check_light_groups(scene_, options_.render);
    } catch (...) {
        material = before;
        throw;
    }
    changed(same_geometry(before, value) ? SceneChange::materials : SceneChange::lights);
}

void Session::set_instance_transform(size_t index, const glm::mat4& object_to_world) {
    Instance& instance = find(scene_.instances, index, "instance");
    check_transform(object_to_world, "instance", index);
    instance.object_to_world = object_to_world;
    if (scene_.next) scene_.next->instances[index] = {object_to_world};
    // What moved was placed by itself.
    const bool moved =
        scene_.shutter && !std::exchange(scene_.shutter->instances[index], {}).empty();
    changed(moved ? SceneChange::lights : SceneChange::transforms);
}

void Session::set_shape_transform(size_t index, const glm::mat4& object_to_world) {
    Shape& shape = find(scene_.shapes, index, "shape");
    check_transform(object_to_world, "shape", index);
    shape.object_to_world = object_to_world;
    const bool moved = scene_.shutter && !std::exchange(scene_.shutter->shapes[index], {}).empty();
    changed(moved ? SceneChange::lights : SceneChange::transforms);
}

void Session::changed(SceneChange change) {
    change_ = std::max(change_, change);
    integrator_.reset();
}

} // namespace onde
