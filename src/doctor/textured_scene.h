// Small textures of every pair of wrap modes.
#pragma once

#include "doctor/scene_probe.h"

namespace onde::doctor {

/// Textures 3 u + v have wrap modes u and v, and sizes of their own; the last one is one texel.
inline Scene textured_scene() {
    constexpr Wrap WRAPS[] = {Wrap::repeat, Wrap::clamp, Wrap::mirror};
    Generator generator(51);
    Scene scene = scene_with_a_speck();
    for (uint32_t i = 0; i < 10; i++) {
        Texture texture;
        texture.image.width = i < 9 ? 2 + i % 4 : 1;
        texture.image.height = i < 9 ? 1 + i / 2 : 1;
        texture.image.rgba.resize(4 * texture.image.width * texture.image.height);
        for (uint8_t& byte : texture.image.rgba) byte = uint8_t(generator());
        texture.wrap_u = WRAPS[i / 3 % 3];
        texture.wrap_v = WRAPS[i % 3];
        scene.textures.push_back(texture);
    }
    return scene;
}

} // namespace onde::doctor
