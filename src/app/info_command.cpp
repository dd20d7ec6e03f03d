#include "app/info_command.h"

#include "app/field_json.h"
#include "app/json.h"
#include "app/load_request.h"
#include "core/command_line.h"
#include "core/text.h"
#include "gpu/device.h"
#include "render/memory_plan.h"
#include "scene/field_text.h"
#include "scene/load.h"
#include "session/choices.h"
#include "session/integrators.h"
#include "upload/layout_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace onde::app {

namespace {

/// What rendering the scene with the default settings takes on the default device.
struct DeviceMemory {
    std::string device;
    RenderOptions options;
    MemoryPlan plan;
};

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

/// How many of each `kind`, without those of none.
template <class T>
CountsByWord count_kinds(const std::vector<T>& things) {
    CountsByWord counts;
    for (const auto& [kind, word] : WORDS_OF<decltype(T::kind)>)
        if (const auto count = std::ranges::count(things, kind, &T::kind))
            counts.emplace_back(word, size_t(count));
    return counts;
}

uint64_t host_bytes(const Scene& scene, uint64_t texture_bytes) {
    uint64_t bytes = texture_bytes + bytes_of(scene.materials) + bytes_of(scene.instances) +
                     bytes_of(scene.spheres) + bytes_of(scene.shapes) +
                     bytes_of(scene.chapter.area_lights);
    for_each_light_list(
        scene, [&](const auto& lights, const auto&, const char*) { bytes += bytes_of(lights); });
    for (const Mesh& mesh : scene.meshes) bytes += bytes_of(mesh);
    if (scene.environment.map) bytes += bytes_of(scene.environment.map->pixels);
    for (const DensityGrid& grid : scene.grids) bytes += grid.bytes();
    return bytes;
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
    for_each_field(settings, [](const auto& field, const auto& value) {
        if (value) fmt::print("{:<13} {}\n", name_of(field), value_text(*value));
    });
}

/// The device that a render takes by default; a CPU of no name where there is none.
gpu::DeviceFacts default_device() {
    const auto platforms = gpu::list_platforms();
    std::vector<gpu::DeviceFacts> all;
    for (const gpu::PlatformReport& platform : platforms)
        all.insert(all.end(), platform.devices.begin(), platform.devices.end());
    if (const auto chosen = gpu::choose_device(platforms, gpu::default_selector()))
        return all.at(*chosen);
    gpu::DeviceFacts cpu;
    cpu.name = "a CPU (there is no OpenCL device)";
    cpu.is_cpu = cpu.is_pocl = true;
    return cpu;
}

DeviceMemory plan_device_memory(const Scene& scene) {
    const gpu::DeviceFacts facts = default_device();
    DeviceMemory memory{facts.name, resolve_options({}, scene, facts).options, {}};
    const PackedScene packed = pack_scene(scene, {.layout = known_layout(facts)});
    memory.plan = plan_memory(scene, memory.options, facts, packed.features);
    memory.plan.add_scene(packed.device_buffers());
    return memory;
}

/// Bytes; the list of all buffers is in the JSON.
constexpr uint64_t SMALLEST_SHOWN = 1024;

void print_buffers(const std::vector<gpu::BufferSize>& buffers) {
    for (const gpu::BufferSize& buffer : buffers)
        if (buffer.bytes >= SMALLEST_SHOWN)
            fmt::print("  {:<21} {:>10}\n", buffer.name, size_text(buffer.bytes));
}

void print_memory(const DeviceMemory& memory) {
    const MemoryPlan& plan = memory.plan;
    fmt::print("device memory {}, on {}\n", size_text(plan.bytes()), memory.device);
    fmt::print(" scene {}\n", size_text(gpu::total_bytes(plan.scene)));
    print_buffers(plan.scene);
    fmt::print(" {} paths in flight {}\n", memory.options.settings.wave_size,
               size_text(gpu::total_bytes(plan.paths)));
    print_buffers(plan.paths);
    fmt::print(" film of {} x {} {}\n", memory.options.width, memory.options.height,
               size_text(gpu::total_bytes(plan.film)));
    print_buffers(plan.film);
}

/// "5, 2 disk, 3 torus".
std::string counts_text(size_t all, const CountsByWord& counts) {
    std::string text = std::to_string(all);
    for (const auto& [word, count] : counts) text += fmt::format(", {} {}", count, word);
    return text;
}

/// How many lights without geometry there are: "1 point, 0 directional".
std::string lights_text(const Scene& scene) {
    std::vector<std::string> counts;
    for_each_light_list(scene, [&](const auto& lights, const auto&, std::string_view words) {
        counts.push_back(fmt::format("{} {}", lights.size(), words.substr(0, words.find(' '))));
    });
    return fmt::format("{}", fmt::join(counts, ", "));
}

void print_text(const Scene& scene, const SceneSummary& summary, const DeviceMemory& memory) {
    const SceneBounds bounds = scene_bounds(scene);
    fmt::print("triangles     {} unique, {} instanced, {} of them emissive\n",
               summary.unique_triangles, summary.instanced_triangles, summary.emissive_triangles);
    fmt::print("meshes        {}, in {} instances\n", scene.meshes.size(), scene.instances.size());
    fmt::print("spheres       {}\n", scene.spheres.size());
    fmt::print("shapes        {}\n", counts_text(scene.shapes.size(), summary.shapes));
    fmt::print("materials     {}\n", counts_text(scene.materials.size(), summary.materials));
    fmt::print("textures      {}, {}\n", scene.textures.size(), size_text(summary.texture_bytes));
    fmt::print("media         {}, {} grids, {}\n", summary.media, scene.grids.size(),
               size_text(summary.grid_bytes));
    fmt::print("lights        {}; area {}\n", lights_text(scene),
               counts_text(scene.chapter.area_lights.size(), summary.area_lights));
    fmt::print("environment   {}\n", environment_text(scene.environment));
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        fmt::print("camera {}      '{}', {:.4g} degrees\n", i, printable(scene.cameras[i].name),
                   glm::degrees(scene.cameras[i].vertical_fov));
    print_settings(scene.settings);
    fmt::print("bounds        {} to {}\n", vector_text(bounds.low), vector_text(bounds.high));
    if (const glm::dvec3& o = scene.origin; o != glm::dvec3(0.0))
        fmt::print("origin        {} {} {} in the file\n", o.x, o.y, o.z);
    fmt::print("host memory   {}\n", size_text(summary.host_bytes));
    print_memory(memory);
    fmt::print("hash          {}\n", scene_hash(scene));
    for (const std::string& note : scene.notes)
        fmt::print("note          {}\n", printable(note, std::string::npos));
}

Json json_vector(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json json_counts(const CountsByWord& counts) {
    Json object = Json::object();
    for (const auto& [word, count] : counts) object[word] = count;
    return object;
}

Json json_cameras(const std::vector<Camera>& cameras) {
    Json list = Json::array();
    for (const Camera& camera : cameras) list.push_back(json_fields(camera));
    return list;
}

Json json_buffers(const std::vector<gpu::BufferSize>& buffers) {
    Json sizes = Json::object();
    for (const gpu::BufferSize& buffer : buffers) sizes[buffer.name] = buffer.bytes;
    return sizes;
}

Json json_memory(const DeviceMemory& memory) {
    return {{"device", memory.device},
            {"width", memory.options.width},
            {"height", memory.options.height},
            {"scene", json_buffers(memory.plan.scene)},
            {"paths", json_buffers(memory.plan.paths)},
            {"film", json_buffers(memory.plan.film)},
            {"bytes", memory.plan.bytes()}};
}

void print_json(const Scene& scene, const SceneSummary& summary, const DeviceMemory& memory) {
    const SceneBounds bounds = scene_bounds(scene);
    fmt::print(
        "{}",
        json_text({{"unique_triangles", summary.unique_triangles},
                   {"instanced_triangles", summary.instanced_triangles},
                   {"emissive_triangles", summary.emissive_triangles},
                   {"meshes", scene.meshes.size()},
                   {"instances", scene.instances.size()},
                   {"spheres", scene.spheres.size()},
                   {"shapes", json_counts(summary.shapes)},
                   {"materials", json_counts(summary.materials)},
                   {"textures", scene.textures.size()},
                   {"texture_bytes", summary.texture_bytes},
                   {"media", summary.media},
                   {"grids", scene.grids.size()},
                   {"grid_bytes", summary.grid_bytes},
                   {"point_lights", scene.point_lights.size()},
                   {"directional_lights", scene.directional_lights.size()},
                   {"area_lights", json_counts(summary.area_lights)},
                   {"environment_radiance", json_vector(scene.environment.radiance)},
                   {"environment_map", scene.environment.map.has_value()},
                   {"cameras", json_cameras(scene.cameras)},
                   {"settings", json_fields(scene.settings)},
                   {"bounds", Json::array({json_vector(bounds.low), json_vector(bounds.high)})},
                   {"origin", Json::array({scene.origin.x, scene.origin.y, scene.origin.z})},
                   {"host_bytes", summary.host_bytes},
                   {"device_memory", json_memory(memory)},
                   {"hash", scene_hash(scene)},
                   {"notes", scene.notes}}));
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
    summary.shapes = count_kinds(scene.shapes);
    summary.materials = count_kinds(scene.materials);
    summary.area_lights = count_kinds(scene.chapter.area_lights);
    for (const Texture& texture : scene.textures) summary.texture_bytes += texture.image.bytes();
    for_each_medium(scene, [&](const Medium& medium) { summary.media += medium != Medium{}; });
    for (const DensityGrid& grid : scene.grids) summary.grid_bytes += grid.bytes();
    summary.host_bytes = host_bytes(scene, summary.texture_bytes);
    return summary;
}

void add_info_command(Command& root) {
    struct Options {
        std::string scene;
        LoadRequest load;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    Command command =
        root.add_command("info", "Say what a scene file contains and the memory it takes");
    command.option("scene", &options->scene, fmt::format("A {} file", SCENE_FILES),
                   {.required = true});
    declare_load(command, options->load);
    command.flag("--json", options->json, "Print JSON");
    command.on_run([options] {
        const Scene scene = load_scene(options->scene, load_options(options->load));
        const SceneSummary summary = summarize(scene);
        const DeviceMemory memory = plan_device_memory(scene);
        if (options->json)
            print_json(scene, summary, memory);
        else
            print_text(scene, summary, memory);
    });
}

} // namespace onde::app
