// `onde info SCENE`: what a scene file contains, what was mapped, ignored or added, and the memory
// that rendering it takes.
#pragma once

#include "core/command_line.h"

#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace onde::app {

/// How many there are of each kind that there is, by its word.
using CountsByWord = std::vector<std::pair<std::string, size_t>>;

/// Counts of a scene. Bytes are those of the host's vectors, before anything is packed.
struct SceneSummary {
    uint64_t unique_triangles = 0;    ///< stored
    uint64_t instanced_triangles = 0; ///< seen by a ray: each instance counts
    uint64_t emissive_triangles = 0;  ///< of those seen
    CountsByWord shapes, materials, area_lights;
    uint64_t texture_bytes = 0;
    size_t media = 0; ///< that light meets something in
    uint64_t grid_bytes = 0;
    uint64_t host_bytes = 0;
};

SceneSummary summarize(const Scene& scene);

/// Adds the subcommand; it prints to standard output and throws InputError.
void add_info_command(Command& root);

} // namespace onde::app
