// A film that leaves its session: what it holds, and what it is a film of.
#pragma once

#include "accel/bvh.h"
#include "render/film_contents.h"
#include "render/options.h"
#include "scene/fields.h"

namespace onde {

/// All that a sample's value depends on. Films of equal identities hold samples of one picture.
struct FilmIdentity {
    std::string scene; ///< scene_hash()
    uint32_t camera, width, height, depth, roulette_start, seed;
    Filter filter;
    IntegratorKind integrator;
    Background background;
    uint32_t aovs;
    bool watertight;
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
                      field_without_key(&I::aovs, "set of AOVs"),
                      field_without_key(&I::watertight, "triangle test")};
}

FilmIdentity film_identity(const Scene& scene, const RenderOptions& options, const BvhOptions& bvh);

struct KeptFilm {
    FilmIdentity identity;
    FilmContents contents;
};

/// Throws InputError, with what differs, unless samples of the one film belong to the other.
void check_identity(const FilmIdentity& kept, const FilmIdentity& wanted);

} // namespace onde
