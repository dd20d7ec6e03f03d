// From the scene's values to Embree's scenes.
#include "core/error.h"
#include "support/reference/geometry.h"
#include "support/reference/sphere_geometry.h"

#include <embree3/rtcore.h>

#include <algorithm>

namespace onde::reference {
namespace {

RTCScene new_scene(RTCDevice device) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
}

void attach(RTCScene scene, RTCGeometry geometry, uint32_t id) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t count) {
    void* memory =
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), std::max<size_t>(count, 1));
    if (!memory) throw DeviceError("Embree has no memory for {} elements of a mesh.", count);
    return static_cast<T*>(memory);
}

glm::mat3 normal_matrix(const glm::mat4& m) {
    return glm::transpose(glm::inverse(glm::mat3(m)));
}

bool is_mirrored(const glm::mat4& m) {
    return glm::determinant(glm::mat3(m)) < 0.0f;
}

std::vector<glm::vec3> transformed_normals(const Mesh& mesh, const glm::mat4& transform) {
    std::vector<glm::vec3> normals = mesh.normals;
    const glm::mat3 matrix = normal_matrix(transform);
    for (glm::vec3& n : normals) n = matrix * n;
    return normals;
}

} // namespace

void Geometry::Release::operator()(RTCDeviceTy* device) const {
    rtcReleaseDevice(device);
}
void Geometry::Release::operator()(RTCSceneTy* scene) const {
    rtcReleaseScene(scene);
}

Geometry::Geometry(const Scene& scene) : device_(rtcNewDevice(nullptr)), spheres_(scene.spheres) {
    if (!device_)
        throw DeviceError("Embree cannot make a device (error {}).",
                          int(rtcGetDeviceError(nullptr)));
    scene_.reset(new_scene(device_.get()));
    add_instances(scene);
    add_spheres();
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()))
        throw DeviceError("Embree cannot build the scene (error {}).", int(error));
    RTCBounds b;
    rtcGetSceneBounds(scene_.get(), &b);
    const glm::vec3 low(b.lower_x, b.lower_y, b.lower_z), high(b.upper_x, b.upper_y, b.upper_z);
    if (low.x <= high.x) radius_ = 0.5f * glm::length(high - low);
}

void Geometry::add_instances(const Scene& scene) {
    std::vector<uint32_t> uses(scene.meshes.size(), 0);
    for (const Instance& instance : scene.instances) ++uses[instance.mesh];
    struct Shared {
        RTCScene content = nullptr;
        const MeshData* mesh = nullptr;
    };
    std::vector<Shared> shared(scene.meshes.size());
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const glm::mat4& to_world = instance.object_to_world;
        const auto id = uint32_t(shapes_.size());
        const glm::mat3 to_normal = normal_matrix(to_world);
        if (uses[instance.mesh] == 1) {
            const MeshData* baked = add_mesh(mesh, to_world, scene_.get(), id);
            shapes_.push_back({baked, glm::mat4x3(to_world), to_normal, true, false});
            continue;
        }
        Shared& content = shared[instance.mesh];
        if (!content.mesh) {
            content.content = mesh_scenes_.emplace_back(new_scene(device_.get())).get();
            content.mesh = add_mesh(mesh, glm::mat4(1.0f), content.content, 0);
            rtcCommitScene(content.content);
        }
        add_placement(content.content, to_world, id);
        shapes_.push_back(
            {content.mesh, glm::mat4x3(to_world), to_normal, false, is_mirrored(to_world)});
    }
}

const Geometry::MeshData* Geometry::add_mesh(const Mesh& mesh, const glm::mat4& transform,
                                             RTCSceneTy* target, uint32_t id) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = new_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                            mesh.positions.size());
    auto* triangles = new_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                             mesh.triangles.size());
    std::ranges::transform(mesh.positions, positions, [&](const glm::vec3& p) {
        return glm::vec3(transform * glm::vec4(p, 1.0f));
    });
    // A mirror turns the winding around; turned back, the front is counter-clockwise again.
    const bool mirrored = is_mirrored(transform);
    std::ranges::transform(mesh.triangles, triangles, [&](const glm::uvec3& t) {
        return mirrored ? glm::uvec3(t.x, t.z, t.y) : t;
    });
    attach(target, geometry, id);
    meshes_.push_back(std::make_unique<MeshData>(
        MeshData{positions, triangles, uint32_t(mesh.triangles.size()),
                 transformed_normals(mesh, transform), mesh.uvs, mesh.materials}));
    return meshes_.back().get();
}

void Geometry::add_placement(RTCSceneTy* content, const glm::mat4& to_world, uint32_t id) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, content);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &to_world);
    attach(scene_.get(), geometry, id);
}

void Geometry::add_spheres() {
    if (spheres_.empty()) return;
    attach(scene_.get(), new_sphere_geometry(device_.get(), spheres_), instance_count());
}

} // namespace onde::reference
