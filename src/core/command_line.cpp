#include "core/command_line.h"

#include "core/error.h"
#include "core/nearest.h"

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace onde {
namespace {

/// "onde render", down to the last command that was recognised.
std::string command_name(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return app.get_name() + (chosen.empty() ? "" : " " + command_name(*chosen.back()));
}

/// The last command that was recognised.
const CLI::App& chosen_command(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : chosen_command(*chosen.back());
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

std::string did_you_mean_one_of(std::string_view text, const std::vector<std::string>& names) {
    const std::vector<std::string_view> views(names.begin(), names.end());
    return did_you_mean(text, views);
}

/// Of a word that no command takes.
std::string unknown_word(const CLI::App& app, const std::string& word) {
    const CLI::App& command = chosen_command(app);
    const bool is_option = word.starts_with("-");
    const std::string name = word.substr(0, word.find('='));
    if (is_option)
        return fmt::format("{}: no such option{}", name,
                           did_you_mean_one_of(name, option_names(command)));
    const std::vector<std::string> commands = command_names(command);
    if (commands.empty())
        return fmt::format("{}: one word more than {} takes", word, command_name(app));
    return fmt::format("{}: no such command{}", word, did_you_mean_one_of(word, commands));
}

/// "--spp: 1 required N missing", "--spp: At Most 1 required but received 2".
std::string wrong_count(const std::string& text) {
    const std::string option = text.substr(0, text.find(": "));
    if (text.ends_with(" missing")) return option + " needs a value behind it";
    if (text.find("At Most 1 ") != std::string::npos)
        return option + " is given twice; give it once";
    return text;
}

std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    // CLI11 finds a missing command before it finds the word that was meant to be one.
    const bool incomplete = dynamic_cast<const CLI::RequiredError*>(&error) ||
                            dynamic_cast<const CLI::ExtrasError*>(&error);
    const std::vector<std::string> unknown = app.remaining(true);
    if (incomplete && !unknown.empty()) return unknown_word(app, unknown.front());
    const std::vector<std::string> commands = command_names(chosen_command(app));
    if (dynamic_cast<const CLI::RequiredError*>(&error) && !commands.empty())
        return fmt::format("a command is missing; use one of {}", fmt::join(commands, ", "));
    constexpr std::string_view CONVERSION = "Could not convert: "; // "--spp = x" follows
    const std::string text = error.what();
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return wrong_count(text);
    if (text.starts_with(CONVERSION))
        return text.substr(CONVERSION.size()) + ": not a value that this option takes";
    return text;
}

/// Refuses what is often a variable that is not set.
CLI::Validator not_empty() {
    const auto refuse = [](const std::string& text) {
        return std::string(text.empty() ? "has an empty value; leave it out or give one" : "");
    };
    return CLI::Validator(refuse, "");
}

/// Refuses all other words.
CLI::Validator one_of(const std::vector<std::string>& words) {
    const auto refuse = [words](const std::string& text) {
        if (std::ranges::find(words, text) != words.end()) return std::string();
        return fmt::format("{} is none of {}{}", text, fmt::join(words, ", "),
                           did_you_mean_one_of(text, words));
    };
    return CLI::Validator(refuse, fmt::format("{{{}}}", fmt::join(words, ",")));
}

/// Refuses numbers outside; what is no number is left to the conversion.
CLI::Validator range(double least, double most) {
    const auto refuse = [=](const std::string& text) {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        const bool is_number = end != text.c_str() && *end == '\0';
        if (!is_number || (number >= least && number <= most)) return std::string();
        return fmt::format("{} is out of range; use {} to {}", text, least, most);
    };
    return CLI::Validator(refuse, fmt::format("{} to {}", least, most));
}

/// Refuses what the conversion to the field's numbers would make infinite, or name without a
/// reason.
template <class Number>
CLI::Validator representable() {
    const auto refuse = [](const std::string& text) {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        const bool is_number = end != text.c_str() && *end == '\0';
        constexpr Number LEAST = std::numeric_limits<Number>::lowest();
        constexpr Number MOST = std::numeric_limits<Number>::max();
        const bool says_infinity = text.find_first_of("0123456789") == std::string::npos;
        if (!is_number || says_infinity || (number >= double(LEAST) && number <= double(MOST)))
            return std::string();
        return fmt::format("{} is out of range; use {} to {}", text, LEAST, MOST);
    };
    return CLI::Validator(refuse, "");
}

template <class T>
struct NumberOf {
    using Type = T;
};
template <class T>
struct NumberOf<std::optional<T>> {
    using Type = T;
};

/// The words after the program's name, each option that stands alone with the value that it means.
std::vector<std::string> with_values(std::vector<std::string> words, const AloneOptions& options) {
    for (size_t i = 0; i < words.size() && words[i] != "--"; ++i) {
        const auto found = options.find(words[i]);
        if (found == options.end()) continue;
        const AloneOption& option = found->second;
        if (i + 1 == words.size() || std::ranges::count(option.words, words[i + 1]) == 0)
            words[i] += "=" + option.alone;
    }
    return words;
}

void apply(const OptionRules& rules, CLI::Option& option) {
    if (rules.value) option.type_name(rules.value);
    option.required(rules.required);
    if (rules.show_default) option.capture_default_str();
    if (rules.delimiter) option.delimiter(rules.delimiter)->allow_extra_args(false);
    if (std::isfinite(rules.least) || std::isfinite(rules.most))
        option.check(range(rules.least, rules.most));
    if (!rules.words.empty()) option.check(one_of(rules.words));
}

} // namespace

Command Command::add_command(const std::string& name, const std::string& help) {
    return Command(*app_->add_subcommand(name, help), *alone_);
}

void Command::require_command() {
    app_->require_subcommand(1);
}

void Command::option(const std::string& name, OptionField field, const std::string& help,
                     const OptionRules& rules) {
    const auto declare = [&]<class Value>(Value* value) {
        CLI::Option& option = *app_->add_option(name, *value, help);
        using Number = typename NumberOf<Value>::Type;
        const bool has_range = std::isfinite(rules.least) || std::isfinite(rules.most);
        if constexpr (std::is_arithmetic_v<Number>)
            if (!has_range) option.check(representable<Number>());
        constexpr bool IS_LIST = std::is_same_v<Value, std::vector<std::string>> ||
                                 std::is_same_v<Value, std::vector<std::filesystem::path>>;
        if constexpr (!IS_LIST) option.check(not_empty()); // who takes a list names the wrong one
        apply(rules, option);
    };
    std::visit(declare, field);
}

void Command::flag(const std::string& name, bool& field, const std::string& help) {
    app_->add_flag(name, field, help);
}

void Command::option_function(const std::string& name, std::function<void(const std::string&)> take,
                              const std::string& help, const OptionRules& rules) {
    apply(rules, *app_->add_option_function<std::string>(name, take, help));
}

void Command::on_run(std::function<void()> run) {
    app_->callback(std::move(run));
}

CommandLine::CommandLine(const std::string& name, const std::string& help,
                         const std::string& version)
    : app_(std::make_unique<CLI::App>(help, name)) {
    if (!version.empty()) app_->set_version_flag("--version", version);
}

CommandLine::~CommandLine() = default;

bool CommandLine::run(int argc, char** argv) try {
    std::vector<std::string> words = with_values({argv + std::min(argc, 1), argv + argc}, alone_);
    std::ranges::reverse(words); // as the library takes them
    app_->parse(std::move(words));
    return true;
} catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) {
        const std::string sentence = complaint(*app_, error);
        throw InputError("{}{} {} --help", sentence, sentence.ends_with('?') ? " See" : "; see",
                         command_name(*app_));
    }
    app_->exit(error); // prints what was asked for
    return false;
}

std::optional<std::pair<uint32_t, uint32_t>> parse_pair(std::string_view text, char separator,
                                                        std::string_view option) {
    std::pair<uint32_t, uint32_t> pair;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, pair.first);
    if (first.ec == std::errc::invalid_argument || first.ptr == end || *first.ptr != separator)
        return {};
    const auto second = std::from_chars(first.ptr + 1, end, pair.second);
    if (second.ec == std::errc::invalid_argument || second.ptr != end) return {};
    if (first.ec != std::errc() || second.ec != std::errc())
        throw InputError("{} {} has a number that is too large; use at most {}", option, text,
                         std::numeric_limits<uint32_t>::max());
    return pair;
}

} // namespace onde
