#include "core/hash.h"

#include <fmt/format.h>

namespace onde {

std::string Hasher::hex() const {
    return fmt::format("{:016x}", digest());
}

} // namespace onde
