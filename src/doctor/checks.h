// The checks, each in the file of its name.
#pragma once

#include "doctor/check.h"

namespace onde::doctor {

Finding check_layout(const CheckContext& context);
Finding check_math(const CheckContext& context);
Finding check_random(const CheckContext& context);
Finding check_lanes(const CheckContext& context);
Finding check_traversal(const CheckContext& context);
Finding check_textures(const CheckContext& context);
Finding check_lobes(const CheckContext& context);
Finding check_lights(const CheckContext& context);
Finding check_film(const CheckContext& context);
Finding check_furnace(const CheckContext& context);
Finding check_engines(const CheckContext& context);
Finding check_picture(const CheckContext& context);
Finding check_rate(const CheckContext& context);

} // namespace onde::doctor
