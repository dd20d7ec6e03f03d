// The files of grids, by their extension.
#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"
#include "scene/grid/formats.h"
#include "scene/load_context.h"

namespace onde {

DensityGrid load_grid(LoadContext& context, const std::filesystem::path& path) {
    const std::string extension = lower_extension(path), name = path.string();
    if (extension != ".nvdb" && extension != ".vol")
        throw InputError("{}: '{}' is no grid of densities; give a .nvdb or .vol file", name,
                         shown(extension));
    const std::string bytes = read_file_within(context, path);
    DensityGrid grid =
        extension == ".nvdb" ? read_nanovdb(context, name, bytes) : read_vol(context, name, bytes);
    grid.name = path.stem().string();
    return grid;
}

} // namespace onde
