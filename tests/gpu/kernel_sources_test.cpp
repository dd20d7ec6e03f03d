// Kernel files and their #includes.
#include "core/error.h"
#include "gpu/program.h"
#include "gpu/temporary_folder.h"
#include "support/folders.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using namespace onde;
using namespace onde::gpu;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

static std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

TEST_CASE("every kernel file is embedded, byte by byte") {
    const fs::path kernels = fs::path(onde::test::in_project("kernels"));
    size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kernels)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cl") continue;
        const std::string name = fs::relative(entry.path(), kernels).string();
        INFO(name);
        CHECK(KernelSources::embedded().read(name) == text_of(entry.path()));
        ++count;
    }
    CHECK(count >= 4); // kernels/shared alone has as many
}

TEST_CASE("includes are replaced by their files, nested ones too, relative to kernels/") {
    test::TemporaryFolder folder;
    folder.write("path/a.cl", "before\n#include \"lib/b.h\"\nafter\n");
    folder.write("lib/b.h", "  #  include \"lib/c.h\" // why\nb");
    folder.write("lib/c.h", "c\n");
    CHECK(KernelSources::folder(folder.path()).flatten("path/a.cl") ==
          "#line 1 \"kernels/path/a.cl\"\nbefore\n"
          "#line 1 \"kernels/lib/b.h\"\n"
          "#line 1 \"kernels/lib/c.h\"\nc\n"
          "#line 2 \"kernels/lib/b.h\"\nb\n"
          "#line 3 \"kernels/path/a.cl\"\nafter\n");
}

TEST_CASE("a file is taken in once, so that cycles end") {
    test::TemporaryFolder folder;
    folder.write("a.cl", "#include \"b.h\"\n#include \"b.h\"\na\n");
    folder.write("b.h", "#include \"a.cl\"\n#include \"b.h\"\nb\n");
    CHECK(KernelSources::folder(folder.path()).flatten("a.cl") == "#line 1 \"kernels/a.cl\"\n"
                                                                  "#line 1 \"kernels/b.h\"\n"
                                                                  "#line 2 \"kernels/b.h\"\n"
                                                                  "#line 3 \"kernels/b.h\"\nb\n"
                                                                  "#line 2 \"kernels/a.cl\"\n"
                                                                  "#line 3 \"kernels/a.cl\"\na\n");
}

TEST_CASE("includes in angle brackets and in comments stay as they are") {
    test::TemporaryFolder folder;
    folder.write("a.cl", "#include <cstdint>\n// #include \"none.h\"\n");
    CHECK_THAT(KernelSources::folder(folder.path()).flatten("a.cl"),
               Contains("#include <cstdint>\n// #include \"none.h\"\n"));
}

TEST_CASE("a missing include names the file and line that ask for it") {
    test::TemporaryFolder folder;
    folder.write("a.cl", "#include \"b.h\"\n");
    folder.write("b.h", "\n\n#include \"lib/none.h\"\n");
    const KernelSources sources = KernelSources::folder(folder.path());
    CHECK_THROWS_AS(sources.flatten("a.cl"), DeviceError);
    CHECK_THROWS_WITH(sources.flatten("a.cl"),
                      Contains("kernels/b.h:3:") && Contains("\"lib/none.h\""));
}

TEST_CASE("a kernel file that is not there is an error that names it") {
    CHECK_THROWS_AS(KernelSources::embedded().read("none.cl"), DeviceError);
    CHECK_THROWS_WITH(KernelSources::embedded().read("none.cl"), Contains("none.cl"));
}

TEST_CASE("a kernel folder that is not there is wrong input") {
    CHECK_THROWS_AS(KernelSources::folder("/no/such/folder"), InputError);
}

TEST_CASE("the hash of kernels is that of their texts, wherever they are from") {
    const std::string embedded = KernelSources::embedded().hash();
    CHECK(KernelSources::folder(onde::test::in_project("kernels")).hash() == embedded);
    test::TemporaryFolder folder;
    folder.write("a.cl", "// one");
    const std::string one = KernelSources::folder(folder.path()).hash();
    CHECK(one != embedded);
    folder.write("a.cl", "// two");
    CHECK(KernelSources::folder(folder.path()).hash() != one);
}
