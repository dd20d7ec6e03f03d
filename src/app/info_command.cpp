#include "app/info_command.h"

#include "scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace onde::app {

namespace {

constexpr std::array KIND_NAMES = {"diffuse", "conductor", "dielectric", "metallic-roughness"};

template <class T>
uint64_t bytes_of(const std::vector<T>& values) {
    return uint64_t(values.size()) * sizeof(T);
}

uint64_t bytes_of(const Mesh& mesh) {
    return bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(mesh.uvs) +
           bytes_of(mesh.triangles) + bytes_of(mesh.materials);
}

uint64_t emissive_triangles(const Scene& scene, const Mesh& mesh) {
    uint64_t count = 0;
    for (const uint32_t material : mesh.materials)
        count += scene.materials[material].emission != glm::vec3(0.0f);
    return count;
}

uint64_t host_bytes(const Scene& scene, uint64_t texture_bytes) {
    uint64_t bytes = texture_bytes + bytes_of(scene.materials) + bytes_of(scene.instances) +
                     bytes_of(scene.spheres) + bytes_of(scene.point_lights) +
                     bytes_of(scene.directional_lights);
    for (const Mesh& mesh : scene.meshes) bytes += bytes_of(mesh);
    if (scene.environment.map) bytes += bytes_of(scene.environment.map->pixels);
    return bytes;
}

std::string size_text(uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    if (bytes < 1024 * 1024) return fmt::format("{:.1f} KiB", double(bytes) / 1024);
    return fmt::format("{:.1f} MiB", double(bytes) / (1024 * 1024));
}

std::string vector_text(const glm::vec3& v) {
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

std::string environment_text(const Environment& environment) {
    const std::string radiance = vector_text(environment.radiance);
    if (!environment.map) return "radiance " + radiance;
    return fmt::format("map {} x {}, times {}", environment.map->width, environment.map->height,
                       radiance);
}

void print_settings(const RenderSettings& settings) {
    if (settings.width && settings.height)
        fmt::print("film          {} x {}\n", *settings.width, *settings.height);
    if (settings.samples) fmt::print("samples       {}\n", *settings.samples);
    if (settings.depth) fmt::print("depth         {}\n", *settings.depth);
}

void print_text(const Scene& scene, const SceneSummary& summary) {
    const SceneBounds bounds = scene_bounds(scene);
    fmt::print("triangles     {} unique, {} instanced, {} of them emissive\n",
               summary.unique_triangles, summary.instanced_triangles, summary.emissive_triangles);
    fmt::print("meshes        {}, in {} instances\n", scene.meshes.size(), scene.instances.size());
    fmt::print("spheres       {}\n", scene.spheres.size());
    fmt::print("materials     {}", scene.materials.size());
    for (const auto& [kind, count] : summary.materials_by_kind) fmt::print(", {} {}", count, kind);
    fmt::print("\ntextures      {}, {}\n", scene.textures.size(), size_text(summary.texture_bytes));
    fmt::print("lights        {} point, {} directional\n", scene.point_lights.size(),
               scene.directional_lights.size());
    fmt::print("environment   {}\n", environment_text(scene.environment));
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        fmt::print("camera {}      '{}', {:.4g} degrees\n", i, scene.cameras[i].name,
                   glm::degrees(scene.cameras[i].vertical_fov));
    print_settings(scene.settings);
    fmt::print("bounds        {} to {}\n", vector_text(bounds.low), vector_text(bounds.high));
    fmt::print("host memory   {}\n", size_text(summary.host_bytes));
    fmt::print("hash          {}\n", scene_hash(scene));
    for (const std::string& note : scene.notes) fmt::print("note          {}\n", note);
}

/// A JSON string of UTF-8 text (RFC 8259, section 7).
std::string json_string(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", int(c));
        else
            result += c;
    }
    return result + '"';
}

std::string json_vector(const glm::vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

template <class T, class Convert>
std::string json_list(const std::vector<T>& values, Convert convert) {
    std::string list = "[";
    for (const T& value : values) list += (list.size() > 1 ? ", " : "") + convert(value);
    return list + "]";
}

std::string json_kinds(const SceneSummary& summary) {
    std::string object = "{";
    for (const auto& [kind, count] : summary.materials_by_kind)
        object += fmt::format("{}\"{}\": {}", object.size() > 1 ? ", " : "", kind, count);
    return object + "}";
}

std::string json_camera(const Camera& camera) {
    return fmt::format(R"({{"name": {}, "vertical_fov_degrees": {}}})", json_string(camera.name),
                       glm::degrees(camera.vertical_fov));
}

void print_json(const Scene& scene, const SceneSummary& summary) {
    const SceneBounds bounds = scene_bounds(scene);
    fmt::print("{{\n");
    fmt::print("  \"unique_triangles\": {},\n", summary.unique_triangles);
    fmt::print("  \"instanced_triangles\": {},\n", summary.instanced_triangles);
    fmt::print("  \"emissive_triangles\": {},\n", summary.emissive_triangles);
    fmt::print("  \"meshes\": {},\n  \"instances\": {},\n  \"spheres\": {},\n", scene.meshes.size(),
               scene.instances.size(), scene.spheres.size());
    fmt::print("  \"materials\": {},\n", json_kinds(summary));
    fmt::print("  \"textures\": {},\n  \"texture_bytes\": {},\n", scene.textures.size(),
               summary.texture_bytes);
    fmt::print("  \"point_lights\": {},\n  \"directional_lights\": {},\n",
               scene.point_lights.size(), scene.directional_lights.size());
    fmt::print("  \"environment_radiance\": {},\n  \"environment_map\": {},\n",
               json_vector(scene.environment.radiance), scene.environment.map.has_value());
    fmt::print("  \"cameras\": {},\n", json_list(scene.cameras, json_camera));
    fmt::print("  \"bounds\": [{}, {}],\n", json_vector(bounds.low), json_vector(bounds.high));
    fmt::print("  \"host_bytes\": {},\n  \"hash\": \"{}\",\n", summary.host_bytes,
               scene_hash(scene));
    fmt::print("  \"notes\": {}\n}}\n", json_list(scene.notes, json_string));
}

} // namespace

SceneSummary summarize(const Scene& scene) {
    SceneSummary summary;
    for (const Mesh& mesh : scene.meshes) summary.unique_triangles += mesh.triangles.size();
    std::vector<uint64_t> emissive;
    for (const Mesh& mesh : scene.meshes) emissive.push_back(emissive_triangles(scene, mesh));
    for (const Instance& instance : scene.instances) {
        summary.instanced_triangles += scene.meshes[instance.mesh].triangles.size();
        summary.emissive_triangles += emissive[instance.mesh];
    }
    for (size_t kind = 0; kind < KIND_NAMES.size(); ++kind) {
        const auto is_kind = [&](const Material& m) { return size_t(m.kind) == kind; };
        const auto count = std::count_if(scene.materials.begin(), scene.materials.end(), is_kind);
        if (count > 0) summary.materials_by_kind.emplace_back(KIND_NAMES[kind], size_t(count));
    }
    for (const Texture& texture : scene.textures)
        summary.texture_bytes += bytes_of(texture.image.rgba);
    summary.host_bytes = host_bytes(scene, summary.texture_bytes);
    return summary;
}

void add_info_command(CLI::App& app) {
    struct Options {
        std::string scene;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("info", "Say what a scene file contains");
    command->add_option("scene", options->scene, "A .gltf, .glb, .obj or .toml file")->required();
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options] {
        const Scene scene = load_scene(options->scene);
        const SceneSummary summary = summarize(scene);
        if (options->json)
            print_json(scene, summary);
        else
            print_text(scene, summary);
    });
}

} // namespace onde::app
