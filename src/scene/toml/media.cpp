// Grids of media in Onde's scene format.
#include "core/error.h"
#include "scene/load_context.h"
#include "scene/toml/fields.h"
#include "scene/toml/scene.h"

namespace onde {
namespace fs = std::filesystem;

template <class Visit>
void TomlScene::for_each_grid(const TableReader& root, const Visit& visit) {
    const auto visit_in = [&](const TableReader& owner, const auto& medium) {
        for (const TableReader& table : owner.tables("medium")) {
            if (table.has("density")) {
                visit(medium(), table);
                continue;
            }
            for (const char* key : {"density_scale", "position", "rotation", "scale"})
                if (table.has(key))
                    table.fail(key, "is of a grid, which it has none of; give density");
        }
    };
    visit_in(root, [&]() -> Medium& { return scene_.medium; });
    size_t i = 0;
    for (const TableReader& table : root.tables("material")) {
        Material& material = scene_.materials[i++];
        visit_in(table, [&]() -> Medium& { return *material.medium; });
    }
}

void TomlScene::read_grids(const TableReader& root) {
    for_each_grid(root, [&](Medium& medium, const TableReader& table) {
        medium.grid = grid(table);
        medium.placement = placement(table);
    });
}

uint32_t TomlScene::grid(const TableReader& medium) {
    const std::string file = medium.require("density", medium.text("density"));
    const fs::path path = context_.resolve(folder_, file, medium.where("density"));
    if (!fs::exists(path))
        medium.fail("density", fmt::format("names '{}', which does not exist", file));
    const auto [found, is_new] =
        grid_of_file_.try_emplace(path.string(), uint32_t(scene_.grids.size()));
    if (is_new) scene_.grids.push_back(load_grid(context_, path));
    return found->second;
}

} // namespace onde
