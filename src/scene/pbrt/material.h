// pbrt's materials as the nearest of ours: the only place that knows how they are mapped.
#pragma once

#include "scene/pbrt/texture.h"

#include <functional>

namespace onde::pbrt {

/// A material as its file states it.
struct MaterialSource {
    std::string name, kind; ///< no kind: not defined
    Parameters parameters;
};

/// All materials of a file, by their numbers.
using MaterialSources = std::vector<MaterialSource>;

/// Where a material of that name is, or -1.
using FindMaterial = std::function<int64_t(const std::string&)>;

struct ConvertedMaterial {
    Material material;
    std::optional<Material> other; ///< to blend it with
};

/// The material as the nearest that Onde has; what is not exact is noted.
ConvertedMaterial convert_material(const MaterialSource& source, const MaterialSources& all,
                                   const FindMaterial& find, Textures& textures,
                                   const Sources& sources);

} // namespace onde::pbrt
