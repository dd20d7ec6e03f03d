#include "scene/obj/mtl_map.h"

#include "scene/file_words.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace onde::mtl {

namespace {

using text::Words;

struct Option {
    std::string_view name, becomes; ///< the latter for the documentation
    size_t words;                   ///< that follow it at most
    bool numbers = false;           ///< whether they are numbers, of which some may be missing
    const char* note = nullptr;
};

constexpr std::string_view UNUSED = "ignored";

constexpr Option OPTIONS[] = {
    {"-s", "scale of texture coordinates: that of `map_Kd`, for all maps of its material", 3, true},
    {"-o", "offset of texture coordinates, likewise", 3, true},
    {"-clamp", "no repetition", 1},
    {"-bm", "strength of a normal map", 1, true},
    {"-t", NOTED, 3, true, "The turbulence of maps is ignored"},
    {"-mm", NOTED, 2, true, "Base and gain of maps are ignored"},
    {"-imfchan", NOTED, 1, false, "The choice of a map's channel is ignored"},
    {"-boost", UNUSED, 1, true},
    {"-texres", UNUSED, 1},
    {"-blendu", UNUSED, 1},
    {"-blendv", UNUSED, 1},
    {"-cc", UNUSED, 1},
    {"-type", UNUSED, 1},
    {"-colorspace", UNUSED, 1},
};

const Option* option_named(std::string_view word) {
    const auto found = std::ranges::find(OPTIONS, word, &Option::name);
    return found == std::end(OPTIONS) ? nullptr : found;
}

/// The number that a line begins with, which is then taken from it.
std::optional<double> take_number(Words& words) {
    Words ahead = words;
    const std::optional<double> number = text::number(ahead.next());
    if (!number || !std::isfinite(*number)) return std::nullopt;
    words = ahead;
    return number;
}

class MapReader {
  public:
    MapReader(const std::string& material, Notes& notes) : material_(material), notes_(notes) {}

    Map read(std::string_view line) {
        Words words(line);
        read_options(words);
        map_.file = text::trim(without_options(words.rest()));
        return std::move(map_);
    }

  private:
    /// Takes all options that the words begin with.
    void read_options(Words& words) {
        for (Words ahead = words; const Option* option = option_named(ahead.next());
             words = ahead) {
            if (option->numbers)
                apply(*option, take_numbers(ahead, option->words));
            else
                apply(*option, ahead.next());
        }
    }

    static std::vector<double> take_numbers(Words& words, size_t most) {
        std::vector<double> numbers;
        while (numbers.size() < most) {
            const auto number = take_number(words);
            if (!number) break;
            numbers.push_back(*number);
        }
        return numbers;
    }

    void apply(const Option& option, const std::vector<double>& numbers) {
        if (numbers.empty()) return;
        if (option.name == "-s") map_.scale = {numbers[0], numbers.size() > 1 ? numbers[1] : 1.0};
        if (option.name == "-o") map_.offset = {numbers[0], numbers.size() > 1 ? numbers[1] : 0.0};
        if (option.name == "-bm") map_.bump = float(numbers[0]);
        const bool plain_gain = option.name == "-mm" && numbers == std::vector{0.0, 1.0};
        const bool zero = std::ranges::all_of(numbers, [](double x) { return x == 0.0; });
        if (option.note && !plain_gain && !zero) notes_.add(option.note, material_);
    }

    void apply(const Option& option, std::string_view word) {
        if (option.name == "-clamp") map_.clamp = word == "on";
        if (option.note) notes_.add(option.note, material_);
    }

    /// Cuts off the options after the name, and takes them.
    std::string_view without_options(std::string_view name) {
        Words words(name);
        while (!words.next().empty()) { // the name has one word at least
            const Words options = words;
            if (!option_named(Words(options).next())) continue;
            read_options(words);
            return name.substr(0, name.size() - options.rest().size());
        }
        return name;
    }

    const std::string& material_;
    Notes& notes_;
    Map map_;
};

} // namespace

std::vector<FileWord> map_option_words() {
    std::vector<FileWord> words;
    for (const Option& option : OPTIONS) words.push_back({option.name, option.becomes});
    return words;
}

Map read_map(std::string_view text, const std::string& material, Notes& notes) {
    return MapReader(material, notes).read(text);
}

} // namespace onde::mtl
