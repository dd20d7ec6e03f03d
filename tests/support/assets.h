// Real scenes and images that live outside the project. Tests that use them skip, with a message,
// where the folder is absent.
#pragma once

#include "support/folders.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace onde::test {

/// The folder named by ONDE_ASSETS, or ../shared/assets beside the checkout.
inline std::filesystem::path assets_folder() {
    if (const char* folder = std::getenv("ONDE_ASSETS")) return folder;
    return std::filesystem::path(in_project("../shared")) / "assets";
}

/// The asset's path, or nothing (with a warning in the test's output) where it is absent.
inline std::optional<std::filesystem::path> find_asset(const std::string& name) {
    const std::filesystem::path path = assets_folder() / name;
    if (std::filesystem::exists(path)) return path;
    WARN("skipped: no asset " << name << " (set ONDE_ASSETS to the folder of assets)");
    return std::nullopt;
}

} // namespace onde::test
