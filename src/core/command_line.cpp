#include "core/command_line.h"

#include "core/error.h"

#include <CLI/CLI.hpp>

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

std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
    // CLI11 finds a missing command before it finds the word that was meant to be one.
    const bool incomplete = dynamic_cast<const CLI::RequiredError*>(&error) ||
                            dynamic_cast<const CLI::ExtrasError*>(&error);
    const std::vector<std::string> unknown = app.remaining(true);
    if (incomplete && !unknown.empty())
        return fmt::format("{}: no such option or command", unknown.front());
    constexpr std::string_view CONVERSION = "Could not convert: "; // "--spp = x" follows
    const std::string text = error.what();
    if (text.starts_with(CONVERSION))
        return text.substr(CONVERSION.size()) + ": not a value that this option takes";
    return text;
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
    if (!rules.words.empty()) option.check(CLI::IsMember(rules.words));
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
    if (error.get_exit_code() != 0)
        throw InputError("{}; see {} --help", complaint(*app_, error), command_name(*app_));
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
