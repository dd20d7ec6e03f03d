#include "support/folders.h"

namespace onde::test {

std::string in_project(const std::string& path) {
    return ONDE_SOURCE_DIR "/" + path;
}

std::string built_program() {
    return ONDE_BINARY;
}

} // namespace onde::test
