#include "upload/pack.h"

#include "core/error.h"
#include "scene/light_groups.h"
#include "scene/origin.h"
#include "scene/phong.h"
#include "upload/bvh_arrays.h"
#include "upload/geometry.h"
#include "upload/ground.h"
#include "upload/media.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde {

std::vector<std::string> SceneFeatures::defines() const {
    std::vector<std::string> all{
        fmt::format("ONDE_PASSING={:d}", alpha || culling || panes || unbent || media)};
#define ONDE_DEFINE(Type, name, initial, NAME, join)                                               \
    all.push_back(fmt::format("ONDE_" #NAME "={:d}", name));
    SCENE_FEATURES(ONDE_DEFINE)
#undef ONDE_DEFINE
    return all;
}

/// What of them materials and lights decide.
static SceneFeatures material_features(const Scene& scene) {
    SceneFeatures features;
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material material = path_material(scene, i);
        const MaterialFeatures own = features_of(material);
        features.normal_maps |= has_tangents(material);
        features.kinds |= 1u << uint32_t(material.kind);
        features.rough |= own.rough;
        features.rough_glass |= own.rough_glass;
        features.beckmann |= own.beckmann;
        features.albedos |= own.albedos;
        features.indices |= own.index;
        features.specular |= own.specular;
        features.iridescence |= own.iridescence;
        features.blends |= material.blend_with.has_value();
        features.edges |= own.edges;
        features.inner |= own.inner;
        features.anisotropy |= own.anisotropy;
        features.dispersion |= own.dispersion;
        features.transmission |= own.transmission;
        features.absorption |= own.absorption;
        features.panes |= own.pane;
        features.unbent |= own.unbent;
    }
    const bool has_delta_lights = !scene.point_lights.empty() || !scene.spot_lights.empty() ||
                                  !scene.directional_lights.empty();
    features.unbent &= has_delta_lights;
    return features;
}

static SceneFeatures find_features(const Scene& scene, const PackedScene& packed) {
    SceneFeatures features = material_features(scene);
    features.instances = packed.bvh.has_instances;
    features.watertight = packed.bvh.watertight;
    features.layout = packed.bvh.layout;
    features.spheres = !scene.spheres.empty();
    features.shapes = !scene.shapes.empty();
    features.curved = !packed.bulges.empty();
    features.textures = !scene.textures.empty();
    features.uv_sets = uint32_t(used_uv_sets(scene).size());
    for (const Texture& texture : scene.textures) {
        features.texture_transforms |= texture.transform != UvTransform{};
        features.nearest_filters |= texture.filter == TextureFilter::nearest;
        features.wide_textures |= !texture.image.low.empty();
    }
    features.vertex_colors = !packed.colors.empty();
    features.common_lobes = ~0u;
    for (const MaterialRecord& material : packed.materials) {
        features.lobes |= material.lobes;
        features.common_lobes &= material.lobes;
        features.alpha |= material.alpha_mode != ALPHA_OPAQUE;
        features.culling |= !material.double_sided;
    }
    for (const LightRecord& light : packed.lights) features.lights |= 1u << light.kind;
    features.light_tree = !packed.light_tree.empty();
    features.ground = packed.ground_share != glm::vec3(0.0f);
    features.environment = packed.environment_light != NO_INDEX;
    features.motion = scene.next.has_value();
    features.media = !packed.media.empty();
    features.absorption &= !features.media; // which are asked for it instead
    features.grids = !packed.grids.empty();
    features.glow = std::ranges::any_of(packed.media, [](const MediumRecord& medium) {
        return std::ranges::any_of(medium.emission, [](float e) { return e > 0.0f; });
    });
    // Rounded up, so that scenes of similar depth share a compiled program.
    const uint32_t step = features.layout == BvhLayout::wide ? 32 : 16; // GPUs have little room
    features.stack_size = std::max(2 * step, (packed.bvh.stack_size + step - 1) / step * step);
    return features;
}

std::vector<gpu::BufferSize> PackedScene::device_buffers() const {
    const BvhArrays arrays = bvh_arrays(bvh);
    std::vector<gpu::BufferSize> sizes;
#define ONDE_SIZE(Type, name, words) sizes.push_back({words, arrays.name.size_bytes()});
    BVH_BUFFERS(ONDE_SIZE)
#undef ONDE_SIZE
#define ONDE_SIZE(Type, name, words) sizes.push_back({words, name.size() * sizeof(Type)});
    PACKED_BUFFERS(ONDE_SIZE)
#undef ONDE_SIZE
    return sizes;
}

static void build_tree(PackedScene& packed, const FlatGeometry& flat, const BvhOptions& options) {
    packed.bvh = build_bvh(flat.geometries, flat.placements, options);
    packed.built_cost = packed.bvh.statistics.sah_cost;
    compact_bvh(packed.bvh, options.layout);
}

std::optional<Extent> bounds_for_parallel_rays(const Scene& scene) {
    const auto is_parallel = [](const Camera& c) { return c.orthographic_height.has_value(); };
    if (std::ranges::none_of(scene.cameras, is_parallel)) return std::nullopt;
    SceneExtent extent = extent_of(scene);
    for_each_medium(scene, [&](const Medium& medium) {
        if (medium.grid == NO_GRID) return;
        const DensityGrid& grid = scene.grids[medium.grid];
        const glm::dmat4 place = glm::dmat4(medium.placement) * glm::dmat4(grid.from_samples);
        extent.add(transformed({glm::dvec3(grid.low), glm::dvec3(grid.high)}, place));
    });
    return extent.all;
}

static void pack_appearance(PackedScene& packed, const Scene& scene) {
    PackedMaterials materials = pack_materials(scene);
    packed.materials = std::move(materials.records);
    packed.albedos = std::move(materials.albedos);
    packed.spectrum = std::move(materials.spectrum);
    packed.media = std::move(materials.media);
    packed.grids = std::move(materials.grids);
}

static void pack_geometry(PackedScene& packed, const Scene& scene, FlatGeometry flat,
                          LightSampler sampler) {
    packed.bounds = bounds_for_parallel_rays(scene);
    LightList lights = build_lights(scene, flat, sampler);
    packed.lights = std::move(lights.records);
    packed.light_tree = std::move(lights.tree);
    packed.environment_light = lights.environment;
    static_cast<MotionArrays&>(packed) = pack_motion(scene, flat);
    packed.surfaces = std::move(flat.surfaces);
    packed.bulges = std::move(flat.bulges);
    packed.vertices = std::move(flat.vertices);
    packed.uvs = std::move(flat.uvs);
    packed.colors = std::move(flat.colors);
    packed.tangents = std::move(flat.tangents);
    packed.objects = std::move(flat.objects);
}

static void put_environment(PackedScene& packed, PackedEnvironment environment) {
    packed.environment = std::move(environment.pixels);
    packed.environment_alias = std::move(environment.alias);
    packed.environment_width = environment.width;
    packed.environment_height = environment.height;
    packed.environment_floor = environment.floor;
    std::ranges::copy(environment.scale, packed.environment_scale);
}

void take_next_view(PackedScene& packed, const Scene& scene) {
    if (!scene.next) return;
    packed.next_cameras = scene.next->cameras;
    packed.next_environment_rotation = scene.next->environment_rotation;
}

PackedScene pack_scene(const Scene& scene, const BvhOptions& options, const LightOptions& lights) {
    if (scene.materials.size() > MOST_MATERIALS)
        throw InputError("the scene has {} materials; at most {} can be told apart",
                         scene.materials.size(), MOST_MATERIALS);
    PackedScene packed;
    FlatGeometry flat = flatten_geometry(scene);
    build_tree(packed, flat, options);
    pack_geometry(packed, scene, std::move(flat), lights.sampler);
    pack_appearance(packed, scene);
    PackedTextures textures = pack_textures(scene);
    packed.textures = std::move(textures.records);
    packed.texels = std::move(textures.texels);
    packed.srgb = srgb_table();
    packed.voxels = pack_voxels(scene);
    put_environment(packed, pack_environment(scene.environment, lights.compensation));
    packed.ground_share = ground_share(scene);
    packed.ground_height = scene.environment.ground.value_or(packed.ground_height);
    packed.environment_radiance = scene.environment.radiance;
    packed.environment_rotation = scene.environment.rotation;
    packed.environment_group = LightGroups(scene)(scene.environment.group);
    take_next_view(packed, scene);
    packed.features = find_features(scene, packed);
    return packed;
}

/// Whether the tree was fitted to geometry that has moved, and is still good.
static bool refit_tree(PackedScene& packed, const FlatGeometry& flat, const BvhOptions& options) {
    if (packed.bvh.layout != BvhLayout::wide) return false;
    refit_bvh(packed.bvh, flat.geometries, flat.placements, options);
    return packed.bvh.statistics.sah_cost <= MOST_REFIT_COST * packed.built_cost;
}

void repack_scene(PackedScene& packed, const Scene& scene, SceneChange change,
                  const BvhOptions& options, const LightOptions& lights) {
    if (change >= SceneChange::transforms) {
        FlatGeometry flat = flatten_geometry(scene);
        const bool same_primitives = change == SceneChange::transforms;
        if (!same_primitives || !refit_tree(packed, flat, options))
            build_tree(packed, flat, options);
        pack_geometry(packed, scene, std::move(flat), lights.sampler);
    }
    pack_appearance(packed, scene);
    packed.environment_group = LightGroups(scene)(scene.environment.group);
    take_next_view(packed, scene);
    packed.features = find_features(scene, packed);
}

} // namespace onde
