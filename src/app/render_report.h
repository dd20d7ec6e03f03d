// The numbers of a render, for people (--stats) and for scripts (--json).
#pragma once

#include "session/session.h"

#include <cstdio>
#include <filesystem>
#include <string>

namespace onde::app {

/// What a session does not know of its render.
struct RenderReport {
    std::string scene{}, scene_hash{};
    double load_seconds = 0, write_seconds = 0, total_seconds = 0;
    double kernel_seconds = -1; ///< of the kernels that were told, so that they are told once
    RenderOutcome outcome{};
};

/// Several lines to that stream.
void print_report(Session& session, const RenderReport& report, std::FILE* to);

/// The report as a JSON object, as write_file writes.
void write_report(Session& session, const RenderReport& report, const std::filesystem::path& path);

} // namespace onde::app
