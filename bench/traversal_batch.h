// Rays as Embree's calls take them: alone, in packets as structures of arrays, in streams. A batch
// loads up to SIZE rays, asks about them, and gives its answer to each: a Hit, or 1 where the ray
// is blocked. The names of Embree's calls differ by their structures only, hence the overloads.
#pragma once

#include "traversal_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

namespace onde::bench {

inline void load(RTCRay& query, const Ray& ray) {
    const glm::vec3 o = ray.origin, d = ray.direction;
    query = {o.x, o.y, o.z, ray.t_min, d.x, d.y, d.z, 0.0f, ray.t_max, ~0u, 0, 0};
}
inline void load(RTCRayHit& query, const Ray& ray) {
    load(query.ray, ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = BVH_NONE;
}

inline Hit answer_of(const RTCRayHit& query) {
    return {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID, BVH_NONE};
}
inline uint32_t answer_of(const RTCRay& query) {
    return query.tfar < 0.0f;
}

template <class Query> // RTCRayHit or RTCRay
class Single {
  public:
    static constexpr size_t SIZE = 1;

    void load(std::span<const Ray> rays) { bench::load(query_, rays.front()); }
    void ask(RTCScene scene, RTCIntersectContext& context) { ask(scene, context, query_); }
    auto answer(size_t) const { return answer_of(query_); }

  private:
    static void ask(RTCScene scene, RTCIntersectContext& context, RTCRayHit& query) {
        rtcIntersect1(scene, &context, &query);
    }
    static void ask(RTCScene scene, RTCIntersectContext& context, RTCRay& query) {
        rtcOccluded1(scene, &context, &query);
    }
    Query query_;
};

template <class Query> // RTCRayHit or RTCRay
class Stream {
  public:
    static constexpr size_t SIZE = 64;

    void load(std::span<const Ray> rays) {
        count_ = unsigned(rays.size());
        for (size_t i = 0; i < rays.size(); ++i) bench::load(queries_[i], rays[i]);
    }
    void ask(RTCScene scene, RTCIntersectContext& context) { ask(scene, context, queries_.data()); }
    auto answer(size_t i) const { return answer_of(queries_[i]); }

  private:
    void ask(RTCScene scene, RTCIntersectContext& context, RTCRayHit* queries) const {
        rtcIntersect1M(scene, &context, queries, count_, sizeof(Query));
    }
    void ask(RTCScene scene, RTCIntersectContext& context, RTCRay* queries) const {
        rtcOccluded1M(scene, &context, queries, count_, sizeof(Query));
    }
    alignas(64) std::array<Query, SIZE> queries_;
    unsigned count_ = 0;
};

/// Eight numbers of a ray in each row, or one number of eight rays.
struct EightRays {
    using Row = float __attribute__((vector_size(32)));
    Row rows[8];
};

/// From rays to columns by three perfect shuffles: left to itself, g++ moves number by number.
inline EightRays transposed(const Ray* rays) {
    using Order = int __attribute__((vector_size(32)));
    static_assert(sizeof(Ray) == sizeof(EightRays::Row));
    EightRays from, to;
    std::memcpy(from.rows, rays, sizeof(from));
    for (int stage = 0; stage < 3; ++stage) {
        for (size_t i = 0; i < 4; ++i) {
            const EightRays::Row a = from.rows[i], b = from.rows[i + 4];
            to.rows[2 * i] = __builtin_shuffle(a, b, Order{0, 8, 1, 9, 2, 10, 3, 11});
            to.rows[2 * i + 1] = __builtin_shuffle(a, b, Order{4, 12, 5, 13, 6, 14, 7, 15});
        }
        from = to;
    }
    return from;
}

template <class Query, size_t LANES> // RTCRayHit8, RTCRayHit16, RTCRay8 or RTCRay16
class Packet {
    static constexpr bool CLOSEST = requires(Query query) { query.hit; };

  public:
    static constexpr size_t SIZE = LANES;

    /// Where there are fewer than SIZE, the last ray again in lanes that are not valid.
    void load(std::span<const Ray> rays) {
        if (rays.size() == SIZE) {
            valid_.fill(-1);
            return load_lanes(rays.data());
        }
        std::array<Ray, SIZE> padded;
        padded.fill(rays.back());
        std::ranges::copy(rays, padded.begin());
        for (size_t lane = 0; lane < SIZE; ++lane) valid_[lane] = lane < rays.size() ? -1 : 0;
        load_lanes(padded.data());
    }

    void ask(RTCScene scene, RTCIntersectContext& context) {
        ask(valid_.data(), scene, context, query_);
    }

    auto answer(size_t lane) const {
        if constexpr (CLOSEST)
            return Hit{query_.ray.tfar[lane], query_.hit.u[lane], query_.hit.v[lane],
                       query_.hit.primID[lane], BVH_NONE};
        else
            return uint32_t(query_.tfar[lane] < 0.0f);
    }

  private:
    void load_lanes(const Ray* rays) {
        if constexpr (CLOSEST) {
            std::ranges::fill(query_.hit.geomID, RTC_INVALID_GEOMETRY_ID);
            std::ranges::fill(query_.hit.primID, BVH_NONE);
            load_lanes(query_.ray, rays);
        } else {
            load_lanes(query_, rays);
        }
    }

    static void load_lanes(auto& query, const Ray* rays) {
        float* const columns[] = {query.org_x, query.org_y, query.org_z, query.tnear,
                                  query.dir_x, query.dir_y, query.dir_z, query.tfar};
        for (size_t lane = 0; lane < SIZE; lane += 8) {
            const EightRays turned = transposed(rays + lane);
            for (size_t i = 0; i < 8; ++i) std::memcpy(columns[i] + lane, &turned.rows[i], 32);
        }
        std::ranges::fill(query.time, 0.0f);
        std::ranges::fill(query.mask, ~0u);
        std::ranges::fill(query.id, 0u);
        std::ranges::fill(query.flags, 0u);
    }

    using Context = RTCIntersectContext;
    static void ask(const int* valid, RTCScene scene, Context& context, RTCRayHit8& query) {
        rtcIntersect8(valid, scene, &context, &query);
    }
    static void ask(const int* valid, RTCScene scene, Context& context, RTCRayHit16& query) {
        rtcIntersect16(valid, scene, &context, &query);
    }
    static void ask(const int* valid, RTCScene scene, Context& context, RTCRay8& query) {
        rtcOccluded8(valid, scene, &context, &query);
    }
    static void ask(const int* valid, RTCScene scene, Context& context, RTCRay16& query) {
        rtcOccluded16(valid, scene, &context, &query);
    }

    alignas(64) std::array<int, SIZE> valid_;
    Query query_;
};

} // namespace onde::bench
