#include "traversal_embree.h"

#include "traversal_batch.h"

#include <tbb/parallel_for.h>

#ifdef __SSE__
    #include <xmmintrin.h>
#endif

namespace onde::bench {

namespace {

/// Flushes denormal numbers to zero in this thread while it lives.
class FlushDenormals {
#ifdef __SSE__
  public:
    FlushDenormals() {
        _mm_setcsr(before_ | 0x8040);
    }
    ~FlushDenormals() {
        _mm_setcsr(before_);
    }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned before_ = _mm_getcsr();
#endif
};

template <class Batch, class Answer>
void answer_range(RTCScene scene, RTCIntersectContextFlags flags, std::span<const Ray> rays,
                  std::span<Answer> answers) {
    [[maybe_unused]] const FlushDenormals flush;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    Batch batch;
    for (size_t first = 0; first < rays.size(); first += Batch::SIZE) {
        const size_t count = std::min(Batch::SIZE, rays.size() - first);
        batch.load(rays.subspan(first, count));
        batch.ask(scene, context);
        for (size_t i = 0; i < count; ++i) answers[first + i] = batch.answer(i);
    }
}

template <class Batch, class Answer>
void answer(RTCScene scene, EmbreeMode mode, std::span<const Ray> rays, std::span<Answer> answers) {
    constexpr size_t RANGE = 1024; // no packet is cut but the last
    static_assert(RANGE % Batch::SIZE == 0);
    tbb::parallel_for(size_t(0), (rays.size() + RANGE - 1) / RANGE, [&](size_t i) {
        const size_t first = i * RANGE, count = std::min(RANGE, rays.size() - first);
        answer_range<Batch, Answer>(scene, mode.flags, rays.subspan(first, count),
                                    answers.subspan(first, count));
    });
}

template <class Query, class Query8, class Query16, class Answer>
void answer_by(RTCScene scene, EmbreeMode mode, std::span<const Ray> rays,
               std::span<Answer> answers) {
    switch (mode.call) {
    case EmbreeCall::single:
        return answer<Single<Query>>(scene, mode, rays, answers);
    case EmbreeCall::packet8:
        return answer<Packet<Query8, 8>>(scene, mode, rays, answers);
    case EmbreeCall::packet16:
        return answer<Packet<Query16, 16>>(scene, mode, rays, answers);
    case EmbreeCall::stream64:
        return answer<Stream<Query>>(scene, mode, rays, answers);
    }
}

} // namespace

std::string EmbreeMode::name() const {
    constexpr const char* NAMES[] = {"embree single", "embree packet8", "embree packet16",
                                     "embree stream64"};
    const std::string name = NAMES[size_t(call)];
    if (call == EmbreeCall::single) return name;
    return name + (flags == RTC_INTERSECT_CONTEXT_FLAG_COHERENT ? " coherent" : " incoherent");
}

std::vector<EmbreeMode> embree_modes(const EmbreeScene& scene) {
    std::vector<EmbreeMode> modes = {EMBREE_SINGLE};
    for (EmbreeCall call : {EmbreeCall::packet8, EmbreeCall::packet16, EmbreeCall::stream64}) {
        if (call == EmbreeCall::stream64 &&
            !rtcGetDeviceProperty(scene.device(), RTC_DEVICE_PROPERTY_RAY_STREAM_SUPPORTED))
            continue;
        modes.push_back({call, RTC_INTERSECT_CONTEXT_FLAG_COHERENT});
        modes.push_back({call, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT});
    }
    return modes;
}

void embree_closest(const EmbreeScene& scene, EmbreeMode mode, std::span<const Ray> rays,
                    std::span<Hit> hits) {
    answer_by<RTCRayHit, RTCRayHit8, RTCRayHit16>(scene.get(), mode, rays, hits);
}

void embree_occluded(const EmbreeScene& scene, EmbreeMode mode, std::span<const Ray> rays,
                     std::span<uint32_t> blocked) {
    answer_by<RTCRay, RTCRay8, RTCRay16>(scene.get(), mode, rays, blocked);
}

} // namespace onde::bench
