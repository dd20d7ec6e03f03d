// A scene as the depth buffer and the painter see it, still in host memory. Pure.
#pragma once

#include "render/options.h"
#include "shared/raster.h"

#include <string>
#include <vector>

namespace onde {

struct PackedRaster {
    RasterRecord record{};
    std::vector<RasterInstance> instances;
    std::vector<float> positions;             ///< 3 per vertex, in their meshes' spaces
    std::vector<uint32_t> triangles;          ///< 3 vertices each
    std::vector<uint32_t> triangle_materials; ///< one each
    std::vector<RasterSphere> spheres;
    std::vector<RasterMaterial> materials;
    std::vector<float> uvs; ///< 2 per vertex; empty without textures

    /// What was turned into something else, a sentence each.
    std::vector<std::string> notes;
};

/// Throws InputError for more primitives than 32 bits can number, and for scenes that are more
/// than 2^29 pixels wide.
PackedRaster pack_raster(const Scene& scene, const Camera& camera, const RenderOptions& options);

} // namespace onde
