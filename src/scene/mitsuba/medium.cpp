// Media of Mitsuba's files.
#include "core/error.h"
#include "scene/mitsuba/reader.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>

namespace onde::mitsuba {

/// From the unit cube to the box of a grid, in the grid's own space.
static glm::dmat4 box_of(const DensityGrid& grid) {
    const glm::dmat4 from_samples(grid.from_samples);
    const glm::dvec3 low(from_samples * glm::dvec4(grid.low, 1.0));
    const glm::dvec3 high(from_samples * glm::dvec4(grid.high, 1.0));
    return glm::scale(glm::translate(glm::dmat4(1.0), low), high - low);
}

std::optional<uint32_t> Reader::grid_of(const Element& volume) {
    const std::string file = Values(document_, volume).text("filename");
    const auto path = document_.find(file, "Grids of densities");
    if (!path) return std::nullopt;
    if (const auto known = grid_files_.find(path->string()); known != grid_files_.end())
        return known->second;
    try {
        std::vector<DensityGrid>& grids = scene_.assets().grids;
        grids.push_back(load_grid(context_, *path));
        return grid_files_[path->string()] = uint32_t(grids.size() - 1);
    } catch (const OverBudget&) {
        throw;
    } catch (const InputError& error) {
        notes_.wrong("Grids of densities that can't be read are left out", error.what());
        return std::nullopt;
    }
}

bool Reader::take_grid(Medium& medium, const Element& volume) {
    if (volume["type"] != "gridvolume") return false;
    const auto grid = grid_of(volume);
    if (!grid) return false;
    const Values values(document_, volume);
    glm::dmat4 place = values.transform("to_world");
    const DensityGrid& found = scene_.assets().grids[*grid];
    if (!values.flag("use_grid_bbox", false)) place = place * glm::inverse(box_of(found));
    if (!scene_.usable(place, notes_) ||
        !scene_.usable(place * glm::dmat4(found.from_samples), notes_))
        return false;
    medium.grid = *grid;
    medium.placement = glm::mat4(place);
    return true;
}

/// A colour, a number, or a volume that is the same everywhere.
glm::dvec3 Reader::color_of(const Element& of, std::string_view name, double absent) {
    const Element* found = document_.property(of, name);
    if (found && found->tag == "volume") {
        if ((*found)["type"] == "constvolume") return color_of(*found, "value", absent);
        notes_.add("Volumes of colours are left out", found->where);
        return glm::dvec3(absent);
    }
    const Values values(document_, of);
    return found && found->tag == "float" ? glm::dvec3(values.number(name, absent))
                                          : values.color(name).value_or(glm::dvec3(absent));
}

void Reader::set_phase(Medium& medium, const Element& phase) {
    if (phase["type"] == "hg")
        medium.anisotropy =
            float(std::clamp(Values(document_, phase).number("g", 0.8), -0.99, 0.99));
    else if (phase["type"] != "isotropic")
        notes_.add("Phase functions other than hg scatter evenly", phase.where);
}

std::optional<Medium> Reader::medium_of(const Element* element) {
    if (!element) return std::nullopt;
    const std::string& type = (*element)["type"];
    const Element* density = document_.property(*element, "sigma_t");
    Medium medium;
    const bool has_grid = density && density->tag == "volume" && take_grid(medium, *density);
    if (type != "homogeneous" && !(type == "heterogeneous" && has_grid)) {
        notes_.add("Media that are not homogeneous, nor have a grid, are left out", element->where);
        return std::nullopt;
    }
    const double scale = Values(document_, *element).number("scale", 1.0);
    const glm::dvec3 dense = has_grid ? glm::dvec3(1.0) : color_of(*element, "sigma_t", 1.0);
    const glm::dvec3 rate = glm::clamp(dense * scale, 0.0, 1e30);
    const glm::dvec3 albedo = glm::clamp(color_of(*element, "albedo", 0.75), 0.0, 1.0);
    medium.scattering = glm::vec3(rate * albedo);
    medium.absorption = glm::vec3(rate * (1.0 - albedo));
    if (const Element* phase = document_.child(*element, "phase")) set_phase(medium, *phase);
    return medium;
}

} // namespace onde::mitsuba
