#include "upload/features.h"

#include <algorithm>

namespace onde {

SceneFeatures with_all_materials(SceneFeatures features) {
    features.rough = features.rough_glass = features.albedos = features.beckmann = true;
    features.indices = features.specular = features.iridescence = true;
    features.anisotropy = features.dispersion = true;
    features.edges = features.inner = features.blends = true;
    features.transmission = features.absorption = features.panes = features.unbent = true;
    features.lobes = ALL_LOBES;
    features.common_lobes = 0;
    return features;
}

SceneFeatures joined(SceneFeatures own, const SceneFeatures& more) {
    const auto either = [](auto a, auto b) { return decltype(a)(a | b); };
    const auto shared = [](auto a, auto b) { return decltype(a)(a & b); };
    const auto larger = [](auto a, auto b) { return std::max(a, b); };
    const auto data = [](auto a, auto) { return a; };
#define ONDE_FEATURE(Type, name, initial, NAME, join) own.name = join(own.name, more.name);
    SCENE_FEATURES(ONDE_FEATURE)
#undef ONDE_FEATURE
    return own;
}

} // namespace onde
