#include "session/kept_film.h"

#include "core/error.h"
#include "scene/load.h"

namespace onde {

FilmIdentity film_identity(const Scene& scene, const RenderOptions& options,
                           const BvhOptions& bvh) {
    return {scene_hash(scene),  options.camera,         options.width, options.height,
            options.depth,      options.roulette_start, options.seed,  options.filter,
            options.integrator, options.background,     options.aovs,  bvh.watertight};
}

void check_identity(const FilmIdentity& kept, const FilmIdentity& wanted) {
    for_each_field(wanted, [&](const auto& field, const auto& value) {
        if (kept.*field.member != value)
            throw InputError("the film is of another {}; go on with what it was begun with",
                             name_of(field));
    });
}

} // namespace onde
