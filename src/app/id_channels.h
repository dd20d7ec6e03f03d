// Channels that tell things apart: Cryptomatte, and plain numbers.
#pragma once

#include "core/enum_words.h"
#include "image/cryptomatte.h"
#include "render/id_counts.h"
#include "scene/id_names.h"

namespace onde::app {

enum class IdChannel {
    crypto_object,
    crypto_material,
    crypto_asset,
    object_id,
    material_id,
    instance_id
};

constexpr auto enum_words(IdChannel) {
    return std::array{EnumWord{IdChannel::crypto_object, "crypto-object"},
                      EnumWord{IdChannel::crypto_material, "crypto-material"},
                      EnumWord{IdChannel::crypto_asset, "crypto-asset"},
                      EnumWord{IdChannel::object_id, "object-id"},
                      EnumWord{IdChannel::material_id, "material-id"},
                      EnumWord{IdChannel::instance_id, "instance-id"}};
}

/// A film's counts, and what is called how.
struct SeenThings {
    const IdCounts& counts;
    const IdNames& names;
    uint32_t width, height;
};

/// A channel as files have it.
struct IdLayers {
    std::vector<ExrLayer> layers;
    ImageMetadata metadata; ///< of Cryptomatte
    Image shown;            ///< for eyes
};

/// `prefix` comes before the names of Cryptomatte's layers; a number's channel is called so.
IdLayers id_layers(IdChannel channel, const SeenThings& things, const std::string& prefix,
                   const std::string& number);

} // namespace onde::app
