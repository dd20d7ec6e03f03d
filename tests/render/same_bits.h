// That a scene's picture does not depend on how an engine is driven.
#pragma once

#include "render/picture.h"
#include "render/variants.h"

namespace onde::test {

inline void check_same_bits(const Scene& scene, const RenderOptions& options) {
    const Image wave = render_scene(scene, apply(options, VARIANTS[0])).image;
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        CHECK(first_difference(wave, render_scene(scene, apply(options, variant)).image) == "");
    }
}

} // namespace onde::test
