// JSON from files that nobody has checked. Knows no format that is written in it.
#pragma once

#include "scene/load_context.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace onde {

/// The JSON value that is the text; a byte-order mark before it is skipped. Throws InputError
/// "NAME: ..." for what is not JSON, for values nested more than 200 deep, for a key that stands
/// twice in an object, for numbers beyond a double's range, and when its values take more than the
/// load's budget.
nlohmann::json parse_json(std::string_view text, const std::string& name, LoadContext& context);

} // namespace onde
