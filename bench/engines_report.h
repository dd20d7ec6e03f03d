// Medians and spreads of whole frames: a table for people and a JSON file for machines.
#pragma once

#include "engines_contender.h"
#include "figures.h"

#include <filesystem>
#include <string>
#include <vector>

namespace onde::bench {

inline constexpr const char* NATIVE = "native";

/// All frames of one contender on one scene.
struct Result {
    std::string variant, settings;
    double compile_seconds = 0; ///< of the kernels, nothing cached; 0 for the native tracer
    Frame first;                ///< the warm-up; the rays of the others are as many
    Samples seconds{};

    double median() const;
    double fastest() const;
    double slowest() const;
};

struct SceneReport {
    std::string scene;
    uint64_t triangles = 0, spheres = 0;
    std::vector<Result> results{}; ///< the native tracer's last
};

/// What all scenes have in common.
struct Circumstances {
    std::string device, commit, date;
    FrameOptions frame;
    uint32_t native_threads = 0, repetitions = 0;
};

/// Date in UTC; the commit of the source folder, "unknown" when that is no checkout.
Circumstances describe_circumstances(const gpu::DeviceFacts& facts, const FrameOptions& frame,
                                     uint32_t native_threads, uint32_t repetitions);

void print_header(const Circumstances& circumstances);
void print_report(const SceneReport& report, const FrameOptions& frame);

/// A list of one object per scene and variant. Throws InputError when the file can't be written.
void write_json(const Circumstances& circumstances, const std::vector<SceneReport>& reports,
                const std::filesystem::path& path);

} // namespace onde::bench
