#include "denoise/find_oidn.h"

#include "core/error.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>

using namespace onde;
using namespace onde::test;

namespace {

/// A variable of the environment with another value while it lives.
class Changed {
  public:
    Changed(const char* name, const std::string& value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        setenv(name, value.c_str(), 1);
    }
    ~Changed() { setenv(name_, old_.c_str(), 1); }
    Changed(const Changed&) = delete;
    Changed& operator=(const Changed&) = delete;

  private:
    const char* name_;
    std::string old_;
};

} // namespace

TEST_CASE("Open Image Denoise is found in a file, a folder, its lib and a Python package") {
    const TemporaryFolder folder;
    for (const char* place : {"plain", "rooted/lib", "packages/pyoidn/oidn/lib"})
        folder.write(std::string(place) + "/" + OIDN_LIBRARY, "library");
    const auto found = [&](const std::string& place) {
        return named_oidn(folder.path() / place, "--denoiser-library");
    };
    CHECK(found("plain") == folder.path() / "plain" / OIDN_LIBRARY);
    CHECK(found(std::string("plain/") + OIDN_LIBRARY) == folder.path() / "plain" / OIDN_LIBRARY);
    CHECK(found("rooted") == folder.path() / "rooted/lib" / OIDN_LIBRARY);
    CHECK(found("packages") == folder.path() / "packages/pyoidn/oidn/lib" / OIDN_LIBRARY);
    CHECK(found("packages/pyoidn") == folder.path() / "packages/pyoidn/oidn/lib" / OIDN_LIBRARY);
}

TEST_CASE("a named place without Open Image Denoise is refused with a sentence") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(named_oidn(folder.path(), "--denoiser-library"),
                      Catch::StartsWith("--denoiser-library " + folder.path().string()) &&
                          Catch::Contains("has no libOpenImageDenoise.so.2"));
    CHECK_THROWS_AS(named_oidn(folder.path() / "none", "--denoiser-library"), InputError);
}

TEST_CASE("Python's package is found beside the python3 of the path, without running it") {
    const TemporaryFolder folder;
    folder.write("v/bin/python3", "never run");
    folder.write(std::string("v/lib/python3.11/site-packages/pyoidn/oidn/lib/") + OIDN_LIBRARY, "");
    const Changed path("PATH", "/nowhere:" + (folder.path() / "v/bin").string());
    const auto library = installed_oidn();
    REQUIRE(library);
    CHECK(*library ==
          folder.path() / "v/lib/python3.11/site-packages/pyoidn/oidn/lib" / OIDN_LIBRARY);
}

TEST_CASE("the user's packages and those of PYTHONPATH are looked at") {
    const TemporaryFolder folder;
    folder.write("home/.local/lib/python3.9/site-packages/x", "");
    const Changed home("HOME", (folder.path() / "home").string());
    const Changed path("PYTHONPATH", "/a:/b");
    const auto folders = python_package_folders();
    for (const std::filesystem::path& wanted :
         {std::filesystem::path("/a"), std::filesystem::path("/b"),
          folder.path() / "home/.local/lib/python3.9/site-packages"})
        CHECK(std::ranges::count(folders, wanted) == 1);
}
