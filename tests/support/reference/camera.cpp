#include "support/reference/camera.h"

#include "support/reference/sampling.h"

#include <vector>

namespace onde::reference {
namespace {

double filter_radius(Filter filter) {
    if (filter == Filter::box) return 0.5;
    return filter == Filter::tent ? 1.0 : 1.5;
}

double filter_weight(Filter filter, double x) {
    const double turn = 2.0 * M_PI * (x + 1.5) / 3.0;
    switch (filter) {
    case Filter::box:
        return 1.0;
    case Filter::tent:
        return 1.0 - std::abs(x);
    case Filter::gaussian:
        return std::exp(-x * x / (2.0 * 0.5 * 0.5));
    case Filter::blackman_harris:
        return 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2.0 * turn) -
               0.01168 * std::cos(3.0 * turn);
    }
    return 0.0;
}

} // namespace

PixelFilter::PixelFilter(Filter filter) {
    constexpr size_t STEPS = 1 << 16;
    const double radius = filter_radius(filter), step = 2.0 * radius / STEPS;
    std::vector<double> cumulative(STEPS + 1, 0.0);
    for (size_t i = 0; i < STEPS; ++i)
        cumulative[i + 1] =
            cumulative[i] + filter_weight(filter, -radius + (double(i) + 0.5) * step);
    for (size_t i = 0, j = 0; i < inverse_.size(); ++i) {
        const double target = cumulative[STEPS] * double(i) / double(inverse_.size() - 1);
        while (j + 1 < STEPS && cumulative[j + 1] < target) ++j;
        const double inside = (target - cumulative[j]) / (cumulative[j + 1] - cumulative[j]);
        inverse_[i] = float(-radius + (double(j) + std::min(inside, 1.0)) * step);
    }
}

PinholeOrLens::PinholeOrLens(const Camera& camera, uint32_t width, uint32_t height, Filter filter)
    : camera_to_world_(camera.camera_to_world), resolution_(width, height),
      aperture_radius_(camera.aperture_radius), focus_distance_(camera.focus_distance),
      filter_(filter) {
    const float half_height = std::tan(0.5f * camera.vertical_fov);
    half_size_ = {half_height * resolution_.x / resolution_.y, half_height};
}

Ray PinholeOrLens::sample(uint32_t x, uint32_t y, Random& random) const {
    const glm::vec2 u = random.next2();
    const glm::vec2 pixel(float(x) + 0.5f + filter_.sample(u.x),
                          float(y) + 0.5f + filter_.sample(u.y));
    const glm::vec2 film = (2.0f * pixel / resolution_ - 1.0f) * half_size_;
    glm::vec3 origin(0.0f), direction(film.x, -film.y, -1.0f);
    if (aperture_radius_ > 0.0f) {
        origin = glm::vec3(aperture_radius_ * sample_disk(random.next2()), 0.0f);
        direction = direction * focus_distance_ - origin;
    }
    return {glm::vec3(camera_to_world_ * glm::vec4(origin, 1.0f)),
            glm::normalize(glm::mat3(camera_to_world_) * direction)};
}

} // namespace onde::reference
