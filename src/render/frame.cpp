#include "render/frame.h"

#include "core/error.h"
#include "render/filter.h"
#include "shared/aovs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {

static void copy(float (&to)[3], glm::vec3 from) {
    for (uint32_t k = 0; k < 3; k++) to[k] = from[k];
}

/// What the film sees of the plane at `distance` before the eye: the size of a pixel and where its
/// lower left corner lies, from the view axis.
struct Window {
    float step, distance;
    glm::vec2 corner;
};

/// Where the plane of rays' targets lies. Beyond 2^24 times what the rays start from, the lens and
/// the way to it, a float's direction tells a plane from infinity no more, and its squares
/// overflow. A pinhole's may lie anywhere: not so near to an eye far out that the digits of its
/// place leave none for pixels.
static float focus_distance(const Camera& camera) {
    constexpr float NEAR = 1.0f / 16;
    const glm::vec3 origin = glm::abs(glm::vec3(camera.camera_to_world[3]));
    const float out = std::max({origin.x, origin.y, origin.z});
    const float from = std::max(out, camera.aperture_radius);
    const bool any = camera.aperture_radius == 0 && !camera.orthographic_height;
    const float focus = any && camera.focus_distance < NEAR * out ? out : camera.focus_distance;
    return std::min(focus, std::max(1e12f, from * float(1 << 24)));
}

static Window view_window(const Camera& camera, glm::vec2 pixels) {
    if (camera.screen) {
        const ScreenWindow& screen = *camera.screen;
        const float step = screen.size.x / pixels.x;
        const glm::vec2 centred = -0.5f * screen.size;
        return {step, screen.distance,
                screen.first_pixel ? *screen.first_pixel - 0.5f * step : centred};
    }
    const float distance = focus_distance(camera);
    const float height =
        camera.orthographic_height.value_or(2 * distance * std::tan(camera.vertical_fov / 2));
    const float narrower = camera.aspect_ratio.value_or(0) * pixels.y / pixels.x;
    const float step = height / pixels.y * std::max(narrower, 1.0f);
    return {step, distance, -0.5f * step * pixels};
}

/// How far the screen of parallel rays may move ahead with nothing of the scene behind it, nor any
/// of it below the ground. Rays that begin at more than `FAR` times the screen's height have no
/// digits left for its pixels; nearer ones keep their bits.
static double free_way(const PackedScene& scene, const Camera& camera, double width,
                       double height) {
    constexpr double FAR = 256.0;
    const glm::dmat4 m(camera.camera_to_world);
    const glm::dvec3 origin(m[3]), forward = -glm::dvec3(m[2]);
    if (!scene.bounds || scene.bounds->empty()) return 0.0;
    const auto& [low, high] = *scene.bounds;
    const glm::dvec3 nearest(forward.x > 0 ? low.x : high.x, forward.y > 0 ? low.y : high.y,
                             forward.z > 0 ? low.z : high.z);
    double way = glm::dot(nearest - origin, forward) - 0.01 * glm::length(high - low);
    if (scene.features.ground && forward.y < 0) {
        const double reach = 0.5 * (width * std::abs(m[0].y) + height * std::abs(m[1].y));
        way = std::min(way, (origin.y - scene.ground_height - reach) / -forward.y);
    }
    return way > FAR * height && std::isfinite(way) ? way : 0.0;
}

/// What is not rectilinear.
static void set_projection(FrameRecord& frame, const Camera& camera, uint32_t width,
                           uint32_t height) {
    static_assert(uint32_t(Projection::rectilinear) == PROJECTION_RECTILINEAR);
    static_assert(uint32_t(Projection::panorama) == PROJECTION_PANORAMA);
    static_assert(uint32_t(Projection::fisheye) == PROJECTION_FISHEYE);
    frame.projection = uint32_t(camera.projection);
    const double turns = double(camera.fisheye_angle) / (2.0 * std::numbers::pi);
    frame.fisheye_step = float(turns / std::min(width, height));
    if (!is_wide(camera)) return;
    frame.aperture_radius = 0.0f;
    frame.orthographic = 0;
}

static void set_camera(FrameRecord& frame, const PackedScene& scene, const Camera& camera,
                       uint32_t width, uint32_t height) {
    const glm::vec3 right(camera.camera_to_world[0]), up(camera.camera_to_world[1]);
    const glm::vec3 forward = -glm::vec3(camera.camera_to_world[2]);
    const Window window = view_window(camera, glm::vec2(float(width), float(height)));
    frame.orthographic = camera.orthographic_height.has_value();
    glm::vec3 origin(camera.camera_to_world[3]);
    if (frame.orthographic && frame.camera_mover == NO_INDEX) {
        const double way =
            free_way(scene, camera, double(window.step) * width, double(window.step) * height);
        if (way > 0.0) origin = glm::vec3(glm::dvec3(origin) + way * glm::dvec3(forward));
        frame.setback = float(way);
    }
    const float distance = frame.orthographic ? 0.0f : window.distance;
    copy(frame.origin, origin);
    copy(frame.corner, origin + forward * distance + right * window.corner.x +
                           up * (window.corner.y + window.step * float(height)));
    copy(frame.step_x, right * window.step);
    copy(frame.step_y, up * -window.step);
    copy(frame.lens_u, right);
    copy(frame.lens_v, up);
    copy(frame.forward, forward);
    frame.aperture_radius = camera.aperture_radius;
    frame.aperture_blades = camera.aperture_blades;
    const double turn = double(camera.aperture_rotation) / (2.0 * std::numbers::pi);
    frame.aperture_turn = float(turn - std::floor(turn));
    frame.focus_distance = distance;
    set_projection(frame, camera, width, height);
}

/// Throws InputError where the chapter's drawing can't show what the camera sees.
static void check_projection(const Camera& camera, IntegratorKind integrator) {
    const bool draws =
        integrator == IntegratorKind::depth_buffer || integrator == IntegratorKind::painter;
    if (draws && is_wide(camera))
        throw InputError("--integrator {} draws by parallel rays, which no {} has; choose another "
                         "--camera, or --integrator path",
                         word_of(integrator), word_of(camera.projection));
}

void check_view(const Camera& camera, const RenderOptions& options) {
    check_projection(camera, options.integrator);
    if (!camera.screen || is_wide(camera)) return;
    const uint32_t width = options.width, height = options.height;
    const double a = camera.screen->size.x, b = camera.screen->size.y;
    if (std::abs(a / width - b / height) <= 1e-5 * a / width) return;
    throw InputError("the camera's screen of {} x {} has pixels of {:.6g} x {:.6g} in a picture of "
                     "{}x{}; they must be square: change its size, or --size",
                     a, b, a / width, b / height, width, height);
}

static float turns_of(float radians) {
    const float turns = radians * float(0.5 / std::numbers::pi);
    return std::abs(turns) > 1.0f ? turns - std::round(turns) : turns;
}

FrameRecord make_frame(const PackedScene& scene, const Camera& camera,
                       const RenderOptions& options) {
    FrameRecord frame{};
    frame.camera_mover =
        scene.camera_movers.empty() ? NO_INDEX : scene.camera_movers.at(options.camera);
    set_camera(frame, scene, camera, options.width, options.height);
    frame.width = options.width;
    frame.height = options.height;
    frame.seed = options.seed;
    frame.max_depth = options.depth;
    frame.roulette_start = options.roulette_start;
    frame.light_count = uint32_t(scene.lights.size());
    frame.environment_light = scene.environment_light;
    frame.environment_group = scene.environment_group;
    frame.first_sun = scene.suns.first;
    frame.sun_count = scene.suns.count;
    frame.environment_width = scene.environment_width;
    frame.environment_height = scene.environment_height;
    frame.environment_floor = scene.environment_floor;
    std::ranges::copy(scene.environment_scale, frame.environment_scale);
    copy(frame.environment_radiance, scene.environment_radiance);
    frame.environment_rotation = turns_of(scene.environment_rotation);
    copy(frame.ground_share, scene.ground_share);
    frame.ground_height = scene.ground_height;
    frame.most_radiance = options.clamp;
    std::ranges::copy(filter_table(options.filter), frame.filter_table);
    return frame;
}

std::vector<FrameRecord> make_frames(const PackedScene& scene, const Camera& camera,
                                     const RenderOptions& options) {
    std::vector<FrameRecord> frames{make_frame(scene, camera, options)};
    if (!(options.aovs >> AOV_MOTION & 1)) return frames;
    frames.push_back(make_frame(scene, scene.next_cameras.at(options.camera), options));
    frames.back().environment_rotation = turns_of(scene.next_environment_rotation);
    return frames;
}

/// The bits at even places of a 6-bit number, as a 3-bit number.
static uint32_t every_other_bit(uint32_t code) {
    return (code & 1) | (code >> 1 & 2) | (code >> 2 & 4);
}

std::vector<uint32_t> pixel_order(const Rectangle& r) {
    constexpr uint32_t TILE = 8;
    std::vector<uint32_t> order;
    order.reserve(r.pixels());
    for (uint32_t tile_y = 0; tile_y < r.height; tile_y += TILE)
        for (uint32_t tile_x = 0; tile_x < r.width; tile_x += TILE)
            for (uint32_t code = 0; code < TILE * TILE; code++) {
                const uint32_t x = tile_x + every_other_bit(code);
                const uint32_t y = tile_y + every_other_bit(code >> 1);
                if (x < r.width && y < r.height) order.push_back((r.x + x) | (r.y + y) << 16);
            }
    return order;
}

std::vector<uint32_t> pixel_order(uint32_t width, uint32_t height) {
    return pixel_order(Rectangle{0, 0, width, height});
}

} // namespace onde
