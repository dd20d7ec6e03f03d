#include "app/json.h"

namespace onde::app {

static std::string dump(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string json_text(const Json& value) {
    return dump(value, 2);
}

std::string json_line(const Json& value) {
    return dump(value, -1);
}

} // namespace onde::app
