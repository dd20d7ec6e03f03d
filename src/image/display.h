// How linear radiance becomes a displayed picture; the transforms are in image/tone.h.
#pragma once

#include "core/enum_words.h"

namespace onde {

enum class ToneMap { none, neutral, filmic, agx };

constexpr auto enum_words(ToneMap) {
    return std::array{EnumWord{ToneMap::none, "none"}, EnumWord{ToneMap::neutral, "neutral"},
                      EnumWord{ToneMap::filmic, "filmic"}, EnumWord{ToneMap::agx, "agx"}};
}

struct Display {
    float exposure = 0.0f;            ///< in stops: the picture is multiplied by 2^exposure
    ToneMap tone_map = ToneMap::none; ///< none: clip at 1
};

} // namespace onde
