#include "figures.h"

#include "core/output.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>

namespace onde::bench {

double median(Samples samples) {
    const auto middle = samples.begin() + std::ptrdiff_t(samples.size() / 2);
    std::ranges::nth_element(samples, middle);
    return *middle;
}

double spread(const Samples& samples) {
    const auto [smallest, largest] = std::ranges::minmax(samples);
    return (largest - smallest) / median(samples);
}

std::string source_commit() {
    constexpr const char* COMMAND = "GIT_OPTIONAL_LOCKS=0 git -C '" ONDE_SOURCE_DIR
                                    "' describe --always --dirty --abbrev=12 --exclude='*' "
                                    "2>/dev/null";
    const std::unique_ptr<FILE, int (*)(FILE*)> git(popen(COMMAND, "r"), pclose);
    std::array<char, 64> line{};
    if (!git || !std::fgets(line.data(), line.size(), git.get())) return "unknown";
    const std::string commit = line.data();
    return commit.substr(0, commit.find('\n'));
}

void write_json(const Json& json, const std::filesystem::path& path) {
    write_file(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

} // namespace onde::bench
