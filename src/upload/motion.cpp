#include "upload/motion.h"

#include "upload/words.h"

#include <map>

namespace onde {
namespace {

/// The linear part of a transform and, where there is room, its offset, row by row.
template <size_t N>
void copy_rows(float (&rows)[N], const glm::dmat4& m) {
    constexpr glm::length_t COLUMNS = N / 3;
    for (glm::length_t row = 0; row < 3; row++)
        for (glm::length_t column = 0; column < COLUMNS; column++)
            rows[row * COLUMNS + column] = float(m[column][row]);
}

class MotionWriter {
  public:
    MotionWriter(const Scene& scene, MotionArrays& arrays)
        : scene_(scene), next_(*scene.next), arrays_(arrays) {
        arrays_.movers.emplace_back();
    }

    /// The mover of an instance whose mesh's primitives begin there: 0 where it stands still.
    uint32_t add(uint32_t instance, uint32_t first_primitive) {
        const glm::mat4& now = scene_.instances[instance].object_to_world;
        const NextInstance& then = next_.instances[instance];
        if (now == then.object_to_world && !then.steps) return 0;
        MoverRecord mover{};
        const glm::dmat4 placed(then.object_to_world);
        if (now != then.object_to_world)
            copy_rows(mover.step, placed * glm::inverse(glm::dmat4(now)) - glm::dmat4(1.0));
        copy_rows(mover.to_world, placed);
        mover.deforms = then.steps.has_value();
        if (then.steps)
            mover.first_triangle =
                first_triangle(*then.steps, scene_.instances[instance].mesh) - first_primitive;
        arrays_.movers.push_back(mover);
        return uint32_t(arrays_.movers.size() - 1);
    }

  private:
    /// Among the corners' steps, of a mesh whose vertices take these.
    uint32_t first_triangle(uint32_t steps, uint32_t mesh) {
        constexpr size_t TRIANGLE_WORDS = 9;
        std::vector<float>& words = arrays_.corner_steps;
        const auto [found, is_new] =
            written_.try_emplace(steps, uint32_t(words.size() / TRIANGLE_WORDS));
        if (!is_new) return found->second;
        for (const glm::uvec3& corners : scene_.meshes[mesh].triangles)
            for (glm::length_t k = 0; k < 3; k++) {
                const glm::vec3& step = next_.steps[steps][corners[k]];
                words.insert(words.end(), {step.x, step.y, step.z});
            }
        return found->second;
    }

    const Scene& scene_;
    const NextFrame& next_;
    MotionArrays& arrays_;
    std::map<uint32_t, uint32_t> written_; ///< first triangles, by steps
};

} // namespace

MotionArrays pack_motion(const Scene& scene, const FlatGeometry& flat) {
    MotionArrays arrays;
    if (!scene.next) return arrays;
    MotionWriter writer(scene, arrays);
    const auto is_instance = [&](uint32_t object) { return object < scene.instances.size(); };
    arrays.primitive_movers.resize(flat.surfaces.size());
    const std::vector<ObjectMap::Run>& runs = flat.objects.runs;
    for (size_t r = 0; r < runs.size(); r++) {
        if (!is_instance(runs[r].object)) continue;
        const uint32_t mover = writer.add(runs[r].object, runs[r].first_primitive);
        const size_t triangles =
            scene.meshes[scene.instances[runs[r].object].mesh].triangles.size();
        const auto begin = arrays.primitive_movers.begin() + runs[r].first_primitive;
        std::fill_n(begin, triangles, mover);
    }
    arrays.instance_movers.resize(flat.placements.size());
    for (size_t p = 0; p < flat.placements.size(); p++) {
        const uint32_t object = flat.objects.of_placement[p];
        if (!is_instance(object)) continue;
        const uint32_t first = flat.geometries[flat.placements[p].geometry].first_primitive;
        arrays.instance_movers[p] = writer.add(object, first);
    }
    return arrays;
}

} // namespace onde
