#include "scene/stage.h"

#include "scene/framing.h"
#include "scene/loaders.h"

#include <algorithm>
#include <cmath>

namespace onde {

static glm::uvec2 framed_size(const Scene& scene, const LoadOptions& options) {
    const RenderSettings& own = scene.settings;
    return options.size.value_or(glm::uvec2(own.width.value_or(DEFAULT_FILM_SIZE.x),
                                            own.height.value_or(DEFAULT_FILM_SIZE.y)));
}

/// Far enough below what stands on it that the two are never one plane, and near enough that nobody
/// sees a gap.
static float ground_under(const SceneBounds& bounds) {
    const float gap = 1e-4f * glm::length(bounds.high - bounds.low);
    return bounds.low.y - std::max(gap, 1e-6f * std::abs(bounds.low.y));
}

StageFit::StageFit(const Scene& first, const LoadOptions& options, bool is_model) {
    const bool is_framed = first.cameras.empty();
    if (is_framed) framing_.emplace(framed_size(first, options), options.all_round);
    const bool automatic = options.ground == GroundPlane::automatic && is_framed && is_model;
    grounded_ = !first.environment.ground && (options.ground == GroundPlane::on || automatic);
}

void StageFit::add(const Scene& scene) {
    if (framing_) framing_->add(scene);
    if (!grounded_) return;
    const SceneBounds bounds = scene_bounds(scene);
    if (!bounds_) bounds_ = bounds;
    bounds_->low = glm::min(bounds_->low, bounds.low);
    bounds_->high = glm::max(bounds_->high, bounds.high);
}

Stage StageFit::stage() const {
    Stage stage;
    if (framing_) stage.camera = framing_->camera();
    if (bounds_) stage.ground = ground_under(*bounds_);
    return stage;
}

Stage fit_stage(const std::filesystem::path& path, LoadOptions options,
                const std::vector<double>& seconds) {
    std::optional<StageFit> fit;
    for (const double at : seconds) {
        options.at = at;
        const Scene scene = load_uncompleted(path, options);
        if (!fit) {
            options.stage = Stage{.origin = scene.origin, .exponent = scene.exponent};
            fit.emplace(scene, options, is_model(path));
        }
        if (!fit->is_wanted()) break;
        fit->add(scene);
    }
    Stage stage = fit->stage();
    stage.origin = options.stage->origin;
    stage.exponent = options.stage->exponent;
    return stage;
}

} // namespace onde
