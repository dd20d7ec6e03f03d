#include "doctor/checks.h"

#include <exception>

namespace onde::doctor {

static constexpr Check CHECKS[] = {
    {"layout", "host and device place the fields of shared records alike", check_layout},
    {"math", "elementary functions, Fresnel terms and sampled shapes are within their bounds",
     check_math},
    {"random", "random numbers are the exact ones, and stratified", check_random},
    {"lanes", "every SIMD lane computes what a single one does", check_lanes},
    {"traversal", "rays hit in every layout what they hit by brute force", check_traversal},
    {"textures", "texture lookups are those of double precision", check_textures},
    {"lobes", "samples of each BSDF lobe follow its density, its values their formulas",
     check_lobes},
    {"lights", "samples of each light follow its density, which integrates to one", check_lights},
    {"film", "the film's sums are those of its tree", check_film},
    {"furnace", "what is lit alike from all sides looks as its closed form says", check_furnace},
    {"engines", "engines, widths, layouts and wave sizes make the same bits", check_engines},
    {"picture", "a small picture of everything is the built-in one", check_picture},
    {"rate", "how fast the device renders that scene", check_rate},
};

std::span<const Check> all_checks() {
    return CHECKS;
}

Finding examine(const Check& check, const CheckContext& context) {
    try {
        return check.run(context);
    } catch (const std::exception& error) {
        return {.passed = false, .value = 1, .unit = "failure", .text = error.what()};
    }
}

} // namespace onde::doctor
