// The painter's algorithm (chapter 1.2): primitives from far to near, each over what is there.
#pragma once

#include "chapter/raster_scene.h"

namespace onde {

/// What the painter has drawn so far, over all samples.
struct PaintCounts {
    uint64_t fragments = 0; ///< that were blended
    uint64_t covered = 0;   ///< samples of pixels that any fragment fell on
};

class Painter : public Integrator {
  public:
    virtual PaintCounts counts() const = 0;
};

/// Entries of the lists of all tiles; primitives are painted in as many groups as that takes.
inline constexpr uint32_t MOST_TILE_ENTRIES = 1u << 22;

/// States the buffers of a painter of these options.
void plan_painter(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options,
                  const gpu::DeviceFacts& facts);

std::unique_ptr<Painter> make_painter(const IntegratorContext& context,
                                      uint32_t most_entries = MOST_TILE_ENTRIES);

} // namespace onde
