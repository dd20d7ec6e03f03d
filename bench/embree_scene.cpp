#include "embree_scene.h"

#include "core/timer.h"

#include <fmt/format.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

namespace onde::bench {

namespace {

template <class T>
void set_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                const std::vector<T>& values) {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    if (memory) std::memcpy(memory, values.data(), values.size() * sizeof(T));
}

} // namespace

EmbreeScene::EmbreeScene(const Model& model, RTCBuildQuality quality)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_.get())) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, model.positions);
    set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, model.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_.get(), quality);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, memory_.get());
    check();
    const Timer timer;
    rtcCommitScene(scene_.get());
    build_seconds_ = timer.seconds();
    check();
}

void EmbreeScene::check() const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error != RTC_ERROR_NONE)
        throw std::runtime_error(fmt::format("Embree fails with error {}", int(error)));
}

bool EmbreeScene::count_bytes(void* memory, ssize_t bytes, bool) {
    Memory& count = *static_cast<Memory*>(memory);
    const int64_t now = std::atomic_ref(count.now) += bytes;
    const std::atomic_ref peak(count.peak);
    for (int64_t seen = peak; seen < now && !peak.compare_exchange_weak(seen, now);) {
    }
    return true;
}

} // namespace onde::bench
