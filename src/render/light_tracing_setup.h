// What light tracing needs to know of a scene before it starts.
#pragma once

#include "render/options.h"
#include "shared/light_tracing.h"
#include "upload/pack.h"

namespace onde {

/// A sphere around the scene, and the fixed point of splats: the power of two that leaves room in
/// 64 bits for FILM_BLOCK samples of a pixel a thousand times as bright as the brightest light. It
/// does not depend on the number of samples, lest a film that goes on be another one; more samples
/// than that run into the third word. Splats are in film area: the sum of a pixel is its radiance
/// times the number of all paths.
LightTracingRecord make_light_tracing(const Scene& scene, const RenderOptions& options);

/// Whether some surface is a smooth mirror or smooth glass, which no connection can see.
bool has_smooth_lobes(const Scene& scene);

/// Surfaces that glow but are no light that rays could start at; those whose emission texture may
/// be black there are left out.
uint64_t count_hidden_emitters(const PackedScene& scene);

} // namespace onde
