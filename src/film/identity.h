// What a film is of: all that the value of a sample depends on.
#pragma once

#include "accel/bvh.h"
#include "image/display.h"
#include "render/film_contents.h"
#include "render/options.h"
#include "scene/fields.h"
#include "scene/id_names.h"
#include "upload/lights.h"

#include <map>
#include <string>

namespace onde {

/// Of films that do not count what their samples see.
inline constexpr const char* NO_IDS = "none";

/// Films of equal identities hold samples of one picture.
struct FilmIdentity {
    std::string scene; ///< scene_hash()
    uint32_t camera, width, height, depth, roulette_start, seed;
    Filter filter;
    IntegratorKind integrator;
    Background background;
    uint32_t aovs;
    std::vector<std::string> light_groups; ///< of which the film has the light, or empty
    std::string ids;                       ///< a hash of the names of what it counts, or NO_IDS
    float clamp, noise, noise_exposure;
    bool watertight;
    LightSampler light_sampler;

    bool has_ids() const { return ids != NO_IDS; }
    FilmPlanes planes() const { return {aovs, uint32_t(light_groups.size())}; }
};

constexpr auto fields_of(TypeTag<FilmIdentity>) {
    using I = FilmIdentity;
    return std::tuple{field_without_key(&I::scene, "scene"),
                      field_without_key(&I::camera, "camera"),
                      field_without_key(&I::width, "width"),
                      field_without_key(&I::height, "height"),
                      field_without_key(&I::depth, "depth"),
                      field_without_key(&I::roulette_start, "start of the roulette"),
                      field_without_key(&I::seed, "seed"),
                      field_without_key(&I::filter, "filter"),
                      field_without_key(&I::integrator, "integrator"),
                      field_without_key(&I::background, "background"),
                      field_without_key(&I::clamp, "clamp"),
                      field_without_key(&I::noise, "noise"),
                      field_without_key(&I::noise_exposure, "exposure of noise"),
                      field_without_key(&I::aovs, "set of AOVs"),
                      field_without_key(&I::light_groups, "list of light groups"),
                      field_without_key(&I::ids, "hash of names"),
                      field_without_key(&I::watertight, "triangle test"),
                      field_without_key(&I::light_sampler, "light sampler")};
}

/// FilmIdentity::ids of films that count things of these names.
std::string hash_of_names(const IdNames& names);

FilmIdentity film_identity(const Scene& scene, const RenderOptions& options, const BvhOptions& bvh,
                           LightSampler lights);

/// What computed the samples, as far as it decides their bits.
struct FilmMaker {
    std::string version;      ///< of the program
    std::string kernels;      ///< gpu::KernelSources::hash()
    std::string device_class; ///< devices of one class make the same bits
};

constexpr auto fields_of(TypeTag<FilmMaker>) {
    using M = FilmMaker;
    return std::tuple{field_without_key(&M::version, "version"),
                      field_without_key(&M::kernels, "hash of kernels"),
                      field_without_key(&M::device_class, "class of devices")};
}

/// Platform and driver, and of a GPU its name: CPUs run one compiler's code for the same numbers.
std::string device_class(const gpu::DeviceFacts& facts);

struct FilmHeader {
    FilmIdentity identity;
    FilmMaker maker;
    std::string device;   ///< for people
    uint32_t samples = 0; ///< of the whole picture, of which a film may have a part
    Display display{};    ///< how the scene is shown
    IdNames names{};      ///< of what the film counts
};

/// Throws InputError, with what differs, unless samples of the one film belong to the other. `name`
/// is that of the film's file; without one, it is the film of a session.
void check_same(const FilmHeader& film, const FilmHeader& wanted, const std::string& name = {});

/// The header as texts by name, and back. What can't be understood is a std::runtime_error with the
/// end of a sentence.
using HeaderTexts = std::map<std::string, std::string>;
HeaderTexts texts_of(const FilmHeader& header);
FilmHeader header_of(const HeaderTexts& texts);

} // namespace onde
