#include "scene/mapping.h"

#include "scene/phong.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace onde {
namespace {

using Sentences = std::vector<std::string>;

/// "2 diffuse, 1 dielectric": the materials that `is_mapped`, counted by the kind of `kind_of`.
template <class IsMapped, class KindOf>
std::string count_kinds(const Scene& scene, const IsMapped& is_mapped, const KindOf& kind_of) {
    std::map<MaterialKind, size_t> counts;
    for (uint32_t i = 0; i < scene.materials.size(); ++i)
        if (is_mapped(scene.materials[i])) ++counts[kind_of(i)];
    std::vector<std::string> words;
    for (const auto& [kind, count] : counts)
        words.push_back(fmt::format("{} {}", count, word_of(kind)));
    return fmt::format("{}", fmt::join(words, ", "));
}

bool is_phong(const Material& material) {
    return material.kind == MaterialKind::phong;
}
bool is_physical(const Material& material) {
    return !is_phong(material);
}
bool glows(const Material& material) {
    return material.emission != glm::vec3(0.0f);
}

size_t count_lights(const Scene& scene) {
    size_t count = scene.chapter.area_lights.size();
    for_each_light_list(
        scene, [&](const auto& lights, const auto&, const char*) { count += lights.size(); });
    return count;
}

/// Glowing materials whose geometry is not of a light that Whitted knows.
size_t count_unlisted_glow(const Scene& scene) {
    std::vector<bool> listed(scene.materials.size());
    for (const AreaLight& light : scene.chapter.area_lights) listed[light.material] = true;
    size_t count = 0;
    for (size_t i = 0; i < scene.materials.size(); ++i)
        count += !listed[i] && glows(scene.materials[i]);
    return count;
}

bool has_lens(const Scene& scene) {
    return std::ranges::any_of(scene.cameras,
                               [](const Camera& c) { return c.aperture_radius > 0; });
}

/// What paths do of light that they can't find.
void note_unbent(const Scene& scene, Sentences& notes) {
    const size_t lights = count_delta_lights(scene);
    const auto is_glass = [](const Material& m) {
        const bool clear = m.kind == MaterialKind::dielectric || m.transmission > 0;
        return clear && !m.thin_walled && m.roughness * m.roughness < 1e-3f &&
               m.shadows == GlassShadows::straight;
    };
    if (lights > 0 && std::ranges::any_of(scene.materials, is_glass))
        notes.push_back(fmt::format(
            "the light of {} points, spots or directions goes through smooth glass unbent, as no "
            "path would find it behind; --integrator light bends it, shadows = \"opaque\" stops it",
            lights));
}

Sentences notes_of_light_transport(const Scene& scene) {
    Sentences notes;
    const std::string kinds = count_kinds(
        scene, is_phong, [&](uint32_t material) { return path_material(scene, material).kind; });
    if (!kinds.empty()) notes.push_back("phong materials were taken as physical ones: " + kinds);
    if (scene.chapter.derived_lights.measures > 0)
        notes.push_back(fmt::format("{} lights have only the chapter's intensity; their power was "
                                    "chosen so that the scene's centre looks the same",
                                    scene.chapter.derived_lights.measures));
    if (scene.chapter.whitted.ambient || scene.chapter.whitted.background)
        notes.push_back("the ambient light and background of [whitted] were left out; the "
                        "[environment] counts");
    return notes;
}

/// What only the path tracer knows.
void note_media(const Scene& scene, Sentences& notes) {
    const bool inside = std::ranges::any_of(scene.materials,
                                            [](const Material& m) { return m.medium.has_value(); });
    if (inside || scene.medium != Medium{}) notes.push_back("media were left out");
}

/// What light tracing and drawing leave out of materials.
void note_left_out(const Scene& scene, bool alpha_too, Sentences& notes) {
    const auto any = [&](const auto& is) { return std::ranges::any_of(scene.materials, is); };
    if (alpha_too && any([](const Material& m) { return m.alpha_mode != AlphaMode::opaque; }))
        notes.push_back("surfaces with alpha were taken as opaque");
    if (!alpha_too && any([](const Material& m) { return m.kind == MaterialKind::unlit; }))
        notes.push_back("unlit surfaces are black: no light comes from them");
}

Sentences notes_of_whitted(const Scene& scene) {
    Sentences notes;
    const std::string kinds =
        count_kinds(scene, is_physical, [&](uint32_t i) { return scene.materials[i].kind; });
    if (!kinds.empty()) notes.push_back("materials were taken as phong ones: " + kinds);
    if (scene.chapter.derived_lights.intensities > 0)
        notes.push_back(
            fmt::format("{} lights have only a power; their chapter_intensity was chosen so that "
                        "the scene's centre looks the same",
                        scene.chapter.derived_lights.intensities));
    if (const size_t glowing = count_unlisted_glow(scene))
        notes.push_back(
            fmt::format("{} glowing materials are seen but light nothing: only [[light]] "
                        "does",
                        glowing));
    if (!scene.spot_lights.empty())
        notes.push_back(fmt::format("{} spot lights were left out", scene.spot_lights.size()));
    if (!scene.photometric_lights.empty())
        notes.push_back(
            fmt::format("{} photometric lights were left out", scene.photometric_lights.size()));
    if (count_without_size(scene.directional_lights) < scene.directional_lights.size())
        notes.push_back(
            "directional lights were taken as points at infinity, whatever their angle");
    if (scene.environment.map && !scene.chapter.whitted.ambient)
        notes.push_back("of the environment map the ambient light has its factor only");
    note_media(scene, notes);
    if (has_lens(scene)) notes.push_back("the lens was taken as a pinhole");
    return notes;
}

Sentences notes_of_raster(const Scene& scene) {
    Sentences notes;
    const size_t lights = count_lights(scene);
    bool bends = false;
    for (uint32_t i = 0; i < scene.materials.size(); ++i) {
        const Phong phong = phong_of(scene, i);
        bends |= phong.reflection > 0 || phong.transmission > 0;
    }
    std::vector<std::string> left_out;
    if (lights > 0) left_out.push_back(fmt::format("{} lights", lights));
    if (std::ranges::any_of(scene.materials, glows)) left_out.push_back("glow");
    if (bends) left_out.push_back("reflection and refraction");
    if (!left_out.empty())
        notes.push_back(
            fmt::format("surfaces show their own colour; left out: {}", fmt::join(left_out, ", ")));
    note_media(scene, notes);
    if (has_lens(scene)) notes.push_back("the lens was left out: all rays are parallel");
    note_left_out(scene, true, notes);
    return notes;
}

} // namespace

static Sentences notes_of(const Scene& scene, IntegratorKind integrator) {
    switch (integrator) {
    case IntegratorKind::path: {
        Sentences notes = notes_of_light_transport(scene);
        note_unbent(scene, notes);
        return notes;
    }
    case IntegratorKind::light: {
        Sentences notes = notes_of_light_transport(scene);
        note_left_out(scene, false, notes);
        return notes;
    }
    case IntegratorKind::whitted:
        return notes_of_whitted(scene);
    case IntegratorKind::depth_buffer:
    case IntegratorKind::painter:
        return notes_of_raster(scene);
    }
    return {};
}

Sentences mapping_notes(const Scene& scene, IntegratorKind integrator) {
    Sentences notes = notes_of(scene, integrator);
    const auto has_idle_lens = [](const Camera& c) { return is_wide(c) && c.aperture_radius > 0; };
    if (std::ranges::any_of(scene.cameras, has_idle_lens))
        notes.push_back("The lens of panoramas and fisheyes is left out: they see from a point.");
    if (scene.shutter && !knows_time(integrator))
        notes.push_back(fmt::format("What moves is as the shutter opens: --integrator {} blurs "
                                    "nothing.",
                                    word_of(integrator)));
    if (scene.environment.ground && integrator != IntegratorKind::path)
        notes.push_back(fmt::format("The ground is left out: --integrator {} does not know it.",
                                    word_of(integrator)));
    return notes;
}

} // namespace onde
