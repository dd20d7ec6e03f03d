#include "traversal_embree.h"

#include "core/timer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstring>

namespace onde::bench {

namespace {

bool count_bytes(void* total, ssize_t bytes, bool) {
    std::atomic_ref(*static_cast<int64_t*>(total)) += bytes;
    return true;
}

template <class T>
void set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                const std::vector<T>& values) {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    std::memcpy(memory, values.data(), values.size() * sizeof(T));
}

template <class Body>
void for_chunks(size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 2048), [&](const auto& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
}

RTCRay embree_ray(const Ray& ray) {
    return {ray.origin.x,
            ray.origin.y,
            ray.origin.z,
            ray.t_min,
            ray.direction.x,
            ray.direction.y,
            ray.direction.z,
            0.0f,
            ray.t_max,
            ~0u,
            0,
            0};
}

} // namespace

EmbreeTracer::EmbreeTracer(const Model& model, RTCBuildQuality quality)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, model.positions);
    set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, model.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_.get(), quality);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, bytes_.get());
    const Timer timer;
    rtcCommitScene(scene_.get());
    build_seconds_ = timer.seconds();
}

void EmbreeTracer::closest(std::span<const Ray> rays, std::span<Hit> hits) const {
    for_chunks(rays.size(), [&](size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        query.ray = embree_ray(rays[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = BVH_NONE;
        rtcIntersect1(scene_.get(), &context, &query);
        hits[i] = {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, BVH_NONE};
    });
}

void EmbreeTracer::occluded(std::span<const Ray> rays, std::span<uint32_t> blocked) const {
    for_chunks(rays.size(), [&](size_t i) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay query = embree_ray(rays[i]);
        rtcOccluded1(scene_.get(), &context, &query);
        blocked[i] = query.tfar < 0.0f;
    });
}

} // namespace onde::bench
