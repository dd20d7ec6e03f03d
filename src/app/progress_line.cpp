#include "app/progress_line.h"

#include <fmt/format.h>

#include <cstdio>
#include <unistd.h>

namespace onde::app {

/// "1:02:03", "2:03" or "3.4 s".
static std::string duration(double seconds) {
    const auto whole = uint64_t(seconds);
    if (whole >= 3600)
        return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    if (whole >= 60) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{:.1f} s", seconds);
}

ProgressLine::ProgressLine(bool quiet, const std::string& name)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO)), name_(name.empty() ? "" : name + ": ") {}

void ProgressLine::show(const Progress& p) {
    if (quiet_) return;
    const std::string line = fmt::format(
        "{}{:3.0f} %  {:.4g} of {:.4g} samples  {:.2f} Mrays/s  {} left", name_, 100 * p.fraction,
        p.samples, p.target_samples, p.rays_per_second * 1e-6, duration(p.seconds_left));
    if (terminal_) {
        std::fprintf(stderr, "\ronde: %s\033[K", line.c_str());
        std::fflush(stderr);
        open_ = true;
    } else if (p.seconds >= next_plain_line_) {
        std::fprintf(stderr, "onde: %s\n", line.c_str());
        next_plain_line_ = p.seconds * 1.5; // fewer and fewer: a day's log stays short
    }
}

void ProgressLine::finish() {
    if (open_) std::fputc('\n', stderr);
    open_ = false;
}

} // namespace onde::app
