#include "chapter/raster_camera.h"

#include "render/frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {
namespace {

glm::vec3 forward_of(const Camera& camera) {
    return -glm::vec3(camera.camera_to_world[2]);
}

glm::dvec3 vector(const float (&v)[3]) {
    return {v[0], v[1], v[2]};
}

/// The camera's part of the record that rays are made from.
FrameRecord view_of(const Camera& camera, const RenderOptions& options) {
    return make_frame(PackedScene{}, camera, options);
}

} // namespace

Camera parallel_camera(const Camera& camera, glm::vec3 center) {
    Camera parallel = camera;
    parallel.aperture_radius = 0;
    if (camera.orthographic_height) return parallel;
    float depth = glm::dot(center - glm::vec3(camera.camera_to_world[3]), forward_of(camera));
    if (!(depth > 0)) depth = camera.focus_distance;
    if (!camera.screen) {
        parallel.orthographic_height = 2 * depth * std::tan(camera.vertical_fov / 2);
        return parallel;
    }
    const float scale = depth / camera.screen->distance;
    parallel.screen->size *= scale;
    if (parallel.screen->first_pixel) *parallel.screen->first_pixel *= scale;
    parallel.orthographic_height = parallel.screen->size.y;
    return parallel;
}

double pixel_size(const Camera& camera, const RenderOptions& options) {
    return glm::length(vector(view_of(camera, options).step_x));
}

glm::dmat4 screen_transform(const Camera& camera, const RenderOptions& options) {
    const FrameRecord view = view_of(camera, options);
    const glm::dvec3 right = vector(view.step_x), down = vector(view.step_y);
    const glm::dvec3 rows[3] = {right / glm::dot(right, right), down / glm::dot(down, down),
                                vector(view.forward)};
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) matrix[column][row] = rows[row][column];
        matrix[3][row] = -glm::dot(rows[row], vector(view.corner));
    }
    return matrix;
}

glm::vec3 raster_background(const Scene& scene, const Camera& camera) {
    const Environment& environment = scene.environment;
    if (scene.chapter.whitted.background) return *scene.chapter.whitted.background;
    if (!environment.map || environment.map->pixels.empty()) return environment.radiance;
    const glm::dvec3 d(glm::normalize(forward_of(camera)));
    constexpr double PI = std::numbers::pi;
    const double turns = std::atan2(d.x, -d.z) / (2 * PI) + 0.5 + environment.rotation / (2 * PI);
    const double down = std::acos(std::clamp(d.y, -1.0, 1.0)) / PI;
    const Image& map = *environment.map;
    const auto nearest = [](double place, uint32_t size) {
        return std::min(uint32_t(place * size), size - 1);
    };
    const size_t pixel = size_t(nearest(down, map.height)) * map.width +
                         nearest(turns - std::floor(turns), map.width);
    return environment.radiance *
           glm::vec3(map.pixels[3 * pixel], map.pixels[3 * pixel + 1], map.pixels[3 * pixel + 2]);
}

} // namespace onde
