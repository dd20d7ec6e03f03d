// The real program, run as a user runs it.
#pragma once

#include "support/folders.h"
#include "support/test_cache_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace onde::test {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;
using Environment = std::map<std::string, std::string>;

inline const std::string CORNELL = in_project("scenes/cornell.toml");

/// Small, and the same everywhere, so that one program is compiled for all tests.
inline Arguments render(const std::string& scene, const Arguments& more = {}) {
    Arguments all{"render", scene, "--lanes", "8"};
    for (const char* option : {"--size", "--spp"}) // unless the test has its own
        if (std::find(more.begin(), more.end(), option) == more.end()) {
            all.push_back(option);
            all.push_back(option == std::string("--size") ? "16x12" : "1");
        }
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

inline std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// A folder of its own, removed with everything in it.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "onde-app-test-XXXXXX").string();
        REQUIRE(mkdtemp(name.data()));
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    fs::path operator/(const std::string& name) const { return path_ / name; }
    const fs::path& path() const { return path_; }

    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << bytes;
    }

    /// Every file by its name in the folder, with what is in it.
    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(path_))
            all[entry.path().lexically_relative(path_)] =
                entry.is_regular_file() ? content(entry.path()) : "(a folder)";
        return all;
    }

  private:
    fs::path path_;
};

struct Outcome {
    int code = -1;  ///< exit code, or -1 when a signal ended it
    int signal = 0; ///< that signal
    std::string out, err;
};

/// A running onde, in the folder, with kernels cached in one place for all tests.
class Process {
  public:
    /// `launcher`: the words before those of onde itself, of a program that starts it.
    Process(const Folder& folder, const Arguments& arguments, const Environment& environment = {},
            const Arguments& launcher = {}) {
        pid_ = fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) become_onde(folder, arguments, environment, launcher);
    }
    ~Process() {
        if (pid_ > 0) wait();
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(int signal) const { kill(pid_, signal); }
    pid_t pid() const { return pid_; }

    /// Waits until the process has a handler for SIGINT, or none; false when that takes too long.
    bool wait_until_interrupt_is_caught(bool caught) const {
        for (int i = 0; i < 60000; ++i) {
            const std::string status = content("/proc/" + std::to_string(pid_) + "/status");
            const bool is_onde = status.starts_with("Name:\tonde\n"); // not our own fork any more
            if (is_onde && catches_interrupt(status) == caught) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }

    Outcome wait() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        Outcome outcome;
        if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
        outcome.out = content(streams_ / "out");
        outcome.err = content(streams_ / "err");
        return outcome;
    }

  private:
    static bool catches_interrupt(const std::string& status) {
        const size_t at = status.find("SigCgt:");
        if (at == std::string::npos) return false;
        return std::stoull(status.substr(at + 7), nullptr, 16) >> (SIGINT - 1) & 1;
    }

    [[noreturn]] void become_onde(const Folder& folder, const Arguments& arguments,
                                  const Environment& environment, const Arguments& launcher) const {
        const fs::path home = fs::path(built_program()).parent_path() / "home-of-app-tests";
        fs::create_directories(home);
        setenv("HOME", home.c_str(), 1);
        setenv("ONDE_CACHE_DIR", test_cache_folder().c_str(), 1);
        unsetenv("XDG_CACHE_HOME");
        for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
        fs::current_path(folder.path());
        redirect(STDOUT_FILENO, streams_ / "out");
        redirect(STDERR_FILENO, streams_ / "err");
        Arguments words = launcher;
        words.emplace_back(built_program());
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        execvp(argv.front(), argv.data());
        _exit(127);
    }

    static void redirect(int stream, const fs::path& path) {
        dup2(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    }

    Folder streams_;
    pid_t pid_ = -1;
};

inline Outcome onde(const Folder& folder, const Arguments& arguments,
                    const Environment& environment = {}) {
    return Process(folder, arguments, environment).wait();
}

/// What the program prints on standard output, when it ends with code 0 and complains of nothing.
inline std::string output_of(const Folder& folder, const Arguments& arguments,
                             const Environment& environment = {}) {
    const Outcome outcome = onde(folder, arguments, environment);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    return outcome.out;
}

/// Runs the program, which must do what it was asked.
inline Outcome succeed(const Folder& folder, const Arguments& arguments,
                       const Environment& environment = {}) {
    const Outcome outcome = onde(folder, arguments, environment);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    return outcome;
}

} // namespace onde::test
