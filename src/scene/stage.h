// What loading adds to a file that was made for no picture, fitted to what is in it: a camera, a
// ground and a scale. Several loads of one file, as for the frames of an animation, share it.
#pragma once

#include "scene/framing.h"

#include <filesystem>
#include <vector>

namespace onde {

/// Fits what complete_scene() would add to a scene: to that scene and to others beside it.
class StageFit {
  public:
    /// The options and the first scene say what is wanted. `is_model` as of complete_scene().
    StageFit(const Scene& first, const LoadOptions& options, bool is_model);

    /// Whether there is anything to fit, but the scale.
    bool is_wanted() const { return framing_ || grounded_; }
    void add(const Scene& scene);
    Stage stage() const;

  private:
    std::optional<Framing> framing_; ///< none: the file has a camera
    bool grounded_;
    std::optional<SceneBounds> bounds_; ///< of all scenes, where a ground is wanted
};

/// The stage of a file for what it shows at these seconds, at least one; only the first is loaded
/// where nothing is to be fitted. Throws InputError as load_scene() does.
Stage fit_stage(const std::filesystem::path& path, LoadOptions options,
                const std::vector<double>& seconds);

} // namespace onde
