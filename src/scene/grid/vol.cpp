// Mitsuba's volumes (its documentation, "Grid-based volume data source"): "VOL", a version, then
// the type of the values, the cells along X, Y and Z, the channels, the box, the values.
#include "scene/grid/bytes.h"
#include "scene/grid/formats.h"
#include "scene/load_context.h"

#include <glm/glm.hpp>

#include <cmath>

namespace onde {

static constexpr uint64_t HEADER = 48;
static constexpr uint32_t FLOATS = 1, BYTES = 3; ///< types of values

DensityGrid read_vol(LoadContext& context, const std::string& name, std::string_view bytes) {
    const Bytes file(bytes, name);
    if (file.part(0, 4) != "VOL\3") file.fail("it is no .vol file of version 3");
    const auto type = file.at<uint32_t>(4), channels = file.at<uint32_t>(20);
    if (type != FLOATS && type != BYTES)
        file.fail("its values are neither floats nor bytes; write it with one of these");
    glm::uvec3 count;
    glm::dvec3 low, high;
    for (glm::length_t k = 0; k < 3; ++k) {
        count[k] = file.at<uint32_t>(8 + 4 * uint64_t(k));
        low[k] = double(file.at<float>(24 + 4 * uint64_t(k)));
        high[k] = double(file.at<float>(36 + 4 * uint64_t(k)));
        if (count[k] < 1 || count[k] > MOST_SAMPLES - 2)
            file.fail("it has no cells, or more than a grid may have");
        if (!std::isnormal(float(high[k] - low[k]))) file.fail("its box has no volume");
    }
    if (channels < 1 || channels > 64) file.fail("it has no channels, or more than 64");
    const uint64_t cells = uint64_t(count.x) * count.y * count.z;
    if (cells > uint64_t(MOST_BRICKS) * 512) file.fail("it has more cells than a grid may have");
    const uint64_t size = type == FLOATS ? 4 : 1;
    file.part(HEADER, cells * channels * size);
    context.spend(cells, sizeof(float), name);
    std::vector<float> densities(cells);
    for (uint64_t i = 0; i < cells; ++i) {
        const uint64_t offset = HEADER + i * channels * size;
        densities[i] =
            type == FLOATS ? file.at<float>(offset) : float(file.at<uint8_t>(offset)) / 255.0f;
    }
    return make_cell_grid(context, name, count, densities, low, high);
}

} // namespace onde
