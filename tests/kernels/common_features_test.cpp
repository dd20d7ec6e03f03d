// The kinds of scenes that kernels are compiled for in advance.
#include "scene/load.h"
#include "support/folders.h"
#include "upload/common_features.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace onde;

static bool is_common(const std::string& scene) {
    const std::string path = onde::test::in_project("scenes/") + scene;
    const std::vector<std::string> defines = pack_scene(load_scene(path)).features.defines();
    return std::ranges::any_of(common_features(), [&](const CommonFeatures& kind) {
        return kind.features.defines() == defines;
    });
}

TEST_CASE("a room with spheres and a field of analytic shapes have common features") {
    CHECK(is_common("cornell.toml"));
    CHECK(is_common("shapes.toml"));
}

TEST_CASE("some common kind has a tree beyond the cache") {
    CHECK(std::ranges::any_of(common_features(), &CommonFeatures::beyond_cache));
}
