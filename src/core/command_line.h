// Commands and their options: declared once, then parsed, checked and listed by --help.
// Only command_line.cpp sees the library behind it, which takes seconds to compile.
#pragma once

#include "core/enum_words.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace onde {

/// Where the value of an option goes. It must outlive the parsing; lists take several values.
using OptionField =
    std::variant<std::string*, std::filesystem::path*, uint32_t*, float*, double*,
                 std::optional<uint32_t>*, std::optional<float>*, std::optional<double>*,
                 std::vector<std::string>*, std::vector<std::filesystem::path>*>;

/// What --help says of a value beside its meaning, and what is refused.
struct OptionRules {
    const char* value = nullptr; ///< a word for it, such as FILE; else that of its type
    bool required = false;
    bool show_default = false;
    char delimiter = 0; ///< stands between the values of a list that is one word
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    std::vector<std::string> words = {}; ///< the only ones that are taken, if not empty
};

/// Options that may stand alone, with the words that they take and the one that they mean then.
struct AloneOption {
    std::string alone;
    std::vector<std::string> words;
};
using AloneOptions = std::map<std::string, AloneOption>;

/// A handle to a command, which lives as long as its CommandLine.
class Command {
  public:
    Command(CLI::App& app, AloneOptions& alone) : app_(&app), alone_(&alone) {}

    Command add_command(const std::string& name, const std::string& help);
    /// Without one of its commands, a group of them is wrong.
    void require_command();

    /// `name` is "--long", "-s,--long", or without dashes that of a word by its position.
    void option(const std::string& name, OptionField field, const std::string& help,
                const OptionRules& rules = {});
    /// True when it is there.
    void flag(const std::string& name, bool& field, const std::string& help);

    /// An option that takes one of an enum's words.
    template <class Enum>
    requires WordedEnum<Enum>
    void choice(const std::string& name, Enum& field, const std::string& help) {
        choose<Enum>(
            name, [&field](Enum value) { field = value; }, help);
    }
    template <class Enum>
    requires WordedEnum<Enum>
    void choice(const std::string& name, std::optional<Enum>& field, const std::string& help) {
        choose<Enum>(
            name, [&field](Enum value) { field = value; }, help);
    }

    /// The same of "--name", which may stand alone for `alone`: what comes behind it and is none of
    /// the words is not its value. An option has the same words in every command.
    template <class Enum>
    requires WordedEnum<Enum>
    void choice_or_alone(const std::string& name, std::optional<Enum>& field, Enum alone,
                         const std::string& help) {
        choice(name, field, help);
        const std::vector<std::string_view> words = all_words<Enum>();
        (*alone_)[name] = {std::string(word_of(alone)), {words.begin(), words.end()}};
    }

    /// An option that takes one of a few words. `words` must outlive the parsing.
    template <class T, class Field>
    void choice(const std::string& name, Field& field, const std::map<std::string, T>& words,
                const std::string& help) {
        OptionRules rules{.value = "WORD"};
        for (const auto& [word, value] : words) rules.words.push_back(word);
        option_function(
            name, [&field, &words](const std::string& word) { field = words.at(word); }, help,
            rules);
    }

    /// What the command does, once everything on the line has been parsed.
    void on_run(std::function<void()> run);

  private:
    template <class Enum, class Take>
    void choose(const std::string& name, const Take& take, const std::string& help) {
        OptionRules rules{.value = "WORD"};
        for (const EnumWord<Enum>& line : WORDS_OF<Enum>) rules.words.emplace_back(line.word);
        option_function(
            name, [take](const std::string& word) { take(*value_of<Enum>(word)); }, help, rules);
    }

    void option_function(const std::string& name, std::function<void(const std::string&)> take,
                         const std::string& help, const OptionRules& rules);

    CLI::App* app_;
    AloneOptions* alone_;
};

/// A program's commands, or its options if it has none.
class CommandLine {
  public:
    CommandLine(const std::string& name, const std::string& help, const std::string& version = {});
    ~CommandLine();

    Command root() { return Command(*app_, alone_); }

    /// Parses and runs the command. False when --help or --version was asked for, and printed.
    /// Throws InputError, one sentence that names what is wrong, and what the command throws.
    bool run(int argc, char** argv);

  private:
    std::unique_ptr<CLI::App> app_;
    AloneOptions alone_;
};

/// The numbers of "640x480" or "3,4", the value of `option`; nothing for any other text. Throws
/// InputError where they are too large.
std::optional<std::pair<uint32_t, uint32_t>> parse_pair(std::string_view text, char separator,
                                                        std::string_view option);

} // namespace onde
