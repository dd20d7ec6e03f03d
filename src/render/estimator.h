// What the schedulers need to know of an estimator: the host's half of kernels/.../estimator.h.
#pragma once

#include "gpu/program.h"
#include "render/options.h"
#include "upload/features.h"

#include <cstdint>
#include <string>
#include <vector>

namespace onde {

struct EstimatorShape {
    std::string file;                 ///< its estimator.h, whose text comes before the scheduler's
    std::vector<std::string> defines; ///< what its text leaves open
    uint32_t state_columns = 0;       ///< of a path, and of a connection; see shared/columns.h
    uint32_t connection_columns = 0;
    bool connects_start = false; ///< a path has a connection before its first ray
    bool is_tree = false;        ///< vertices have several connections, and children
    uint32_t connections = 1;    ///< of a vertex
};

/// An estimator with its own buffers on the device.
class Estimator {
  public:
    virtual ~Estimator() = default;

    virtual const EstimatorShape& shape() const = 0;
    /// Binds ESTIMATOR_PARAMETERS from argument `first` on; returns the next index.
    virtual uint32_t bind(gpu::Kernel& kernel, uint32_t first) const = 0;
    /// Forgets what it has counted and gathered.
    virtual void clear(const gpu::Device&) {}
};

/// The path tracer, which has no buffers of its own. Where the film has AOVs of light and guides,
/// paths know more about what came before; where it has groups of lights, connections know theirs;
/// where the scene has a light tree, paths know the normal at their last vertex, and where it has
/// panes, both know what they pass.
class PathEstimator : public Estimator {
  public:
    PathEstimator(const RenderOptions& options, const SceneFeatures& scene);
    const EstimatorShape& shape() const override { return shape_; }
    uint32_t bind(gpu::Kernel&, uint32_t first) const override { return first; }

  private:
    EstimatorShape shape_;
};

} // namespace onde
