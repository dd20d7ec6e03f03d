// Doctor passes the kernels as they are, and finds what is planted in a copy of them.
#include "doctor/check.h"
#include "doctor/faults.h"
#include "support/folders.h"
#include "support/programs.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace onde::test {
namespace {

namespace fs = std::filesystem;

const fs::path KERNELS = fs::path(in_project("kernels"));

/// A folder of kernels with a fault; removed with everything in it.
class FaultyFolder {
  public:
    explicit FaultyFolder(const Fault& fault) {
        std::string name = (fs::temp_directory_path() / "onde-doctor-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()));
        path_ = name;
        fs::copy(KERNELS, path_, fs::copy_options::recursive);
        std::ostringstream text;
        text << std::ifstream(path_ / fault.file).rdbuf();
        std::string content = text.str();
        const size_t at = content.find(fault.right);
        INFO(fault.file << " has its line once");
        REQUIRE(at != std::string::npos);
        REQUIRE(content.find(fault.right, at + 1) == std::string::npos);
        content.replace(at, std::string_view(fault.right).size(), fault.wrong);
        std::ofstream(path_ / fault.file) << content;
    }
    ~FaultyFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    FaultyFolder(const FaultyFolder&) = delete;
    FaultyFolder& operator=(const FaultyFolder&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// The first check that fails; empty when none does.
std::string first_failure(gpu::Programs& all, std::string& text) {
    for (const doctor::Check& check : doctor::all_checks()) {
        const doctor::Finding finding = examine(check, {all, true});
        text = finding.text;
        if (!finding.passed) return check.name;
    }
    return {};
}

/// Those of every run, or all where ONDE_ALL_FAULTS is set.
bool is_planted(const Fault& fault) {
    return fault.often || std::getenv("ONDE_ALL_FAULTS");
}

} // namespace

TEST_CASE("doctor finds each planted fault by the check nearest to it") {
    for (const Fault& fault : FAULTS) {
        if (!is_planted(fault)) continue;
        const FaultyFolder folder(fault);
        gpu::Programs all(device(), gpu::KernelSources::folder(folder.path()), test_cache());
        std::string text;
        const std::string failure = first_failure(all, text);
        if (std::getenv("ONDE_ALL_FAULTS"))
            fmt::print("{}: {}: {}\n", fault.what, failure.empty() ? "not found" : failure, text);
        INFO(fault.what << ": " << text);
        CHECK(failure == fault.check);
    }
}

TEST_CASE("doctor finds nothing wrong with the kernels as they are") {
    for (const doctor::Check& check : doctor::all_checks()) {
        const doctor::Finding finding = examine(check, {programs(), true});
        INFO(check.name << ": " << finding.value << " " << finding.unit << ": " << finding.text);
        CHECK(finding.passed);
    }
}

TEST_CASE("a check that throws has failed, with what it threw") {
    const doctor::Check broken{"broken", "", [](const doctor::CheckContext&) -> doctor::Finding {
                                   throw std::runtime_error("no such kernel");
                               }};
    const doctor::Finding finding = examine(broken, {programs(), true});
    CHECK_FALSE(finding.passed);
    CHECK(finding.text == "no such kernel");
}

} // namespace onde::test
