#include "upload/environment.h"

#include "upload/alias_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace onde {
namespace {

/// Calls visit(pixel, brightness, solid angle but for a factor that all have).
template <class Visit>
void for_each_pixel(const Image& map, const Visit& visit) {
    for (uint32_t y = 0; y < map.height; y++) {
        const double sine = std::sin(std::numbers::pi * (y + 0.5) / map.height);
        for (uint32_t x = 0; x < map.width; x++) {
            const auto p = map.pixel(x, y);
            visit(size_t(y) * map.width + x, double(p[0]) + p[1] + p[2], sine);
        }
    }
}

double mean_brightness(const Image& map) {
    double sum = 0, weight = 0;
    for_each_pixel(map, [&](size_t, double brightness, double sine) {
        sum += brightness * sine;
        weight += sine;
    });
    return sum / weight;
}

void fill_table(PackedEnvironment& packed, const Image& map, uint32_t which, double floor) {
    std::vector<double> weights(size_t(map.width) * map.height);
    for_each_pixel(map, [&](size_t pixel, double brightness, double sine) {
        weights[pixel] = std::max(brightness - floor, 0.0) * sine;
    });
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (sum > 0) packed.scale[which] = float(double(weights.size()) / sum);
    const std::vector<AliasEntry> table = build_alias_table(weights);
    for (size_t i = 0; i < table.size(); i++)
        packed.alias[i * MAP_TABLES + which] = {table[i].below, table[i].alias};
}

} // namespace

PackedEnvironment pack_environment(const Environment& environment, double compensation) {
    PackedEnvironment packed;
    if (!environment.map) return packed;
    const Image& map = *environment.map;
    packed.width = map.width;
    packed.height = map.height;
    packed.pixels = map.pixels;
    packed.alias.resize(MAP_TABLES * size_t(map.width) * map.height);
    packed.floor = float(compensation * mean_brightness(map));
    fill_table(packed, map, MAP_WHOLE, 0);
    fill_table(packed, map, MAP_COMPENSATED, double(packed.floor));
    return packed;
}

} // namespace onde
