// Compiled programs on disk.
#include "gpu/program.h"
#include "gpu/temporary_folder.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::gpu;
namespace fs = std::filesystem;

namespace {

/// Sets a variable, or unsets it for null, until the end of the scope.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        set(value);
    }
    ~ScopedVariable() { set(old_ ? old_->c_str() : nullptr); }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

  private:
    void set(const char* value) const {
        if (value)
            setenv(name_, value, 1);
        else
            unsetenv(name_);
    }
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

TEST_CASE("what is stored is loaded, zeros and newlines included") {
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path() / "made" / "on" / "demand");
    const std::string binary("a\0b\nc", 5);
    CHECK_FALSE(cache.load("key"));
    cache.store("key", binary);
    CHECK(cache.load("key") == binary);
    CHECK_FALSE(cache.load("other"));
}

TEST_CASE("storing again replaces the entry and leaves no temporary file") {
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    cache.store("key", "old");
    cache.store("key", "new");
    CHECK(cache.load("key") == "new");
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("an entry that lost its end, its start or all of it is a miss") {
    const test::TemporaryFolder folder;
    const ProgramCache cache(folder.path());
    cache.store("key", "binary");
    const fs::path file = fs::directory_iterator(folder.path())->path();
    std::ifstream in(file, std::ios::binary);
    const std::string entry((std::istreambuf_iterator<char>(in)), {});
    for (const std::string& damaged :
         {entry.substr(0, entry.size() - 1), entry.substr(1), std::string()}) {
        folder.write(file.filename().string(), damaged);
        CHECK_FALSE(cache.load("key"));
    }
    folder.write(file.filename().string(), entry);
    CHECK(cache.load("key") == "binary");
}

TEST_CASE("the list names keys and sizes, and clearing removes entries and nothing else") {
    const test::TemporaryFolder folder;
    folder.write("notes.txt", "not ours");
    const ProgramCache cache(folder.path());
    cache.store("one", "1");
    cache.store("two", "22");
    REQUIRE(cache.list().size() == 2);
    for (const ProgramCache::Entry& entry : cache.list()) {
        CHECK((entry.key == "one" || entry.key == "two"));
        CHECK(entry.bytes > 0);
    }
    CHECK(cache.clear() == 2);
    CHECK(cache.list().empty());
    CHECK(fs::exists(folder.path() / "notes.txt"));
}

TEST_CASE("a folder that is not there is an empty cache") {
    const ProgramCache cache("/no/such/folder");
    CHECK(cache.list().empty());
    CHECK(cache.clear() == 0);
    CHECK_FALSE(cache.load("key"));
}

TEST_CASE("the folder is ONDE_CACHE_DIR, else XDG_CACHE_HOME/onde, else ~/.cache/onde, else none") {
    const ScopedVariable own("ONDE_CACHE_DIR", "/own");
    const ScopedVariable xdg("XDG_CACHE_HOME", "/xdg");
    const ScopedVariable home("HOME", "/home/me");
    CHECK(ProgramCache::default_folder() == "/own");
    const ScopedVariable no_own("ONDE_CACHE_DIR", nullptr);
    CHECK(ProgramCache::default_folder() == "/xdg/onde");
    const ScopedVariable no_xdg("XDG_CACHE_HOME", nullptr);
    CHECK(ProgramCache::default_folder() == "/home/me/.cache/onde");
    const ScopedVariable no_home("HOME", nullptr);
    CHECK(ProgramCache::default_folder().empty());
    const ProgramCache nowhere;
    nowhere.store("key", "binary");
    CHECK_FALSE(nowhere.load("key"));
    CHECK(nowhere.list().empty());
}
