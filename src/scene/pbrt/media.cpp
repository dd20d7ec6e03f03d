// Media of pbrt files: what is inside of shapes and around the camera.
#include "core/error.h"
#include "scene/pbrt/reader.h"

#include <algorithm>

namespace onde::pbrt {

/// A rate of absorption or scattering.
static glm::vec3 rate(const Parameters& p, std::string_view key, const glm::dvec3& absent,
                      const Sources& sources) {
    const auto value = spectrum_of(p, key, sources);
    const glm::dvec3 color = !value       ? absent
                             : value->rgb ? *value->rgb
                                          : spectrum::color_of_surface(value->curve);
    return glm::vec3(glm::clamp(color * p.number("scale").value_or(1.0), 0.0, 1e30));
}

/// The box and the samples that the parameters state.
std::optional<uint32_t> Reader::uniform_grid(const Parameters& p) {
    glm::uvec3 count;
    for (glm::length_t k = 0; k < 3; ++k) {
        constexpr std::string_view KEYS[] = {"nx", "ny", "nz"};
        count[k] = uint32_t(std::clamp(p.number(KEYS[k]).value_or(1.0), 1.0, 1e6));
    }
    const std::vector<double>& numbers = p.numbers("density");
    const glm::dvec3 low = p.point("p0").value_or(glm::dvec3(0.0));
    const glm::dvec3 high = p.point("p1").value_or(glm::dvec3(1.0));
    const glm::vec3 size(high - low);
    if (numbers.size() != uint64_t(count.x) * count.y * count.z ||
        !std::isnormal(size.x * size.y * size.z)) {
        notes_.wrong("Media whose grids are not as large as they say are left out", p.where());
        return std::nullopt;
    }
    const std::vector<float> densities(numbers.begin(), numbers.end());
    return add_grid(make_cell_grid(context_, p.where(), count, densities, low, high));
}

std::optional<uint32_t> Reader::grid_file(const Parameters& p) {
    const std::string file = p.text("filename").value_or("");
    const auto path = sources_.find(file, "Grids of densities");
    if (!path) return std::nullopt;
    if (const auto known = grid_files_.find(path->string()); known != grid_files_.end())
        return known->second;
    try {
        return grid_files_[path->string()] = add_grid(load_grid(context_, *path));
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError& error) {
        notes_.wrong("Grids of densities that can't be read are left out", error.what());
        return std::nullopt;
    }
}

uint32_t Reader::add_grid(DensityGrid grid) {
    std::vector<DensityGrid>& grids = scene_.assets().grids;
    grids.push_back(std::move(grid));
    return uint32_t(grids.size() - 1);
}

bool Reader::place_grid(Medium& medium, uint32_t grid) {
    const glm::dmat4 from_samples(scene_.assets().grids[grid].from_samples);
    if (!scene_.usable(state_.transform, notes_) ||
        !scene_.usable(state_.transform * from_samples, notes_))
        return false;
    medium.grid = grid;
    medium.placement = glm::mat4(state_.transform);
    return true;
}

/// What glows does so by what it absorbs.
void Reader::set_emission(Medium& medium, const Parameters& p) {
    const auto glow = spectrum_of(p, "Le", sources_);
    if (!glow) return;
    const double scale = std::max(p.number("Lescale").value_or(1.0), 0.0);
    medium.emission = glm::min(light_color(*glow) * float(scale) * medium.absorption, 1e30f);
}

void Reader::make_named_medium() {
    const std::string name = text("a name");
    const Parameters p = parameters();
    const std::string kind = p.text("type").value_or("");
    const bool has_grid = kind == "uniformgrid" || kind == "nanovdb";
    if (kind != "homogeneous" && !has_grid)
        return notes_.add("Media that are not homogeneous, nor have a grid, are left out", name);
    if (p.has("preset")) notes_.add("Media of named substances are pbrt's default", name);
    // What the format has where nothing is stated; of what has no grid per millimetre.
    const glm::dvec3 absorbed = has_grid ? glm::dvec3(1.0) : glm::dvec3(0.0011, 0.0024, 0.014);
    const glm::dvec3 scattered = has_grid ? glm::dvec3(1.0) : glm::dvec3(2.55, 3.21, 3.77);
    Medium medium;
    medium.absorption = rate(p, "sigma_a", absorbed, sources_);
    medium.scattering = rate(p, "sigma_s", scattered, sources_);
    medium.anisotropy = float(std::clamp(p.number("g").value_or(0.0), -0.99, 0.99));
    set_emission(medium, p);
    if (has_grid) {
        const auto grid = kind == "nanovdb" ? grid_file(p) : uniform_grid(p);
        if (!grid || !place_grid(medium, *grid)) return;
    }
    for (const std::string& unused : p.unused())
        notes_.add("Other parameters of media are ignored", unused);
    media_[name] = medium;
}

void Reader::medium_interface() {
    state_.inside = state_.outside = text("a medium");
    const auto token = tokens_->peek();
    if (token && token->kind == Token::Kind::text) state_.outside = text("a medium");
}

const Medium* Reader::find_medium(const std::string& name) {
    if (name.empty()) return nullptr;
    const auto found = media_.find(name);
    if (found == media_.end()) notes_.wrong("Media that are not defined are left out", name);
    return found == media_.end() ? nullptr : &found->second;
}

} // namespace onde::pbrt
