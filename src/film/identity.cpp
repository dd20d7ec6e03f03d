#include "film/identity.h"

#include "core/error.h"
#include "core/hash.h"
#include "film/planes.h"
#include "gpu/device.h"
#include "scene/light_groups.h"
#include "scene/load.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace onde {
namespace {

const std::string PREFIX = "onde:";

/// Of a field's name, as attributes are called.
std::string key_of(std::string_view name) {
    std::string key = PREFIX + std::string(name);
    for (char& c : key)
        if (c == ' ') c = '_';
    return key;
}

std::string text_of(const std::string& value) {
    return value;
}
std::string text_of(uint32_t value) {
    return std::to_string(value);
}
std::string text_of(float value) {
    return fmt::format("{}", value); // the shortest that is read as the same number
}
std::string text_of(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, ","));
}
std::string text_of(bool value) {
    return value ? "true" : "false";
}
template <WordedEnum Enum>
std::string text_of(Enum value) {
    return std::string(word_of(value));
}

[[noreturn]] void throw_meaningless(const std::string& key, const std::string& text) {
    throw std::runtime_error("its " + key + " is \"" + printable(text, LONGEST_NAME) + "\"");
}

/// A value out of texts.
class Texts {
  public:
    explicit Texts(const HeaderTexts& texts) : texts_(texts) {}

    void read(const std::string& key, std::string& value) const { value = text(key); }
    template <class Number>
    requires(std::is_arithmetic_v<Number>) void read(const std::string& key, Number& value) const {
        const std::string& word = text(key);
        const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
        if (result.ec != std::errc() || result.ptr != word.data() + word.size())
            throw_meaningless(key, word);
    }
    void read(const std::string& key, bool& value) const {
        value = text(key) == "true";
        if (!value && text(key) != "false") throw_meaningless(key, text(key));
    }
    /// Names of groups of lights, each another.
    void read(const std::string& key, std::vector<std::string>& values) const {
        std::istringstream all(text(key));
        for (std::string name; std::getline(all, name, ','); values.push_back(name))
            if (name.empty() || !why_no_group(name).empty() || std::ranges::count(values, name) > 0)
                throw_meaningless(key, text(key));
        if (values.size() > MOST_LIGHT_GROUPS + 1) throw_meaningless(key, text(key));
    }
    template <WordedEnum Enum>
    void read(const std::string& key, Enum& value) const {
        const std::optional<Enum> known = value_of<Enum>(text(key));
        if (!known) throw_meaningless(key, text(key));
        value = *known;
    }
    const std::string& text(const std::string& key) const {
        const auto found = texts_.find(key);
        if (found == texts_.end()) throw std::runtime_error("it has no " + key);
        return found->second;
    }

  private:
    const HeaderTexts& texts_;
};

/// Calls visit(key, names) for each list of names.
template <class Names, class Visit>
void for_each_list(Names& names, const Visit& visit) {
    visit(PREFIX + "objects", names.objects);
    visit(PREFIX + "assets", names.assets);
    visit(PREFIX + "materials", names.materials);
}

/// JSON, as any reader of headers can make use of.
std::string json_of(const std::vector<std::string>& names) {
    return nlohmann::json(names).dump();
}

std::vector<std::string> names_of(const std::string& key, const std::string& text) {
    const auto is_flat = [](int depth, auto, auto&) { return depth <= 1; };
    const nlohmann::json list = nlohmann::json::parse(text, is_flat, false);
    std::vector<std::string> names;
    if (!list.is_array()) throw_meaningless(key, text);
    for (const nlohmann::json& name : list) {
        if (!name.is_string()) throw_meaningless(key, text);
        names.push_back(name.get<std::string>());
    }
    return names;
}

template <class Member>
bool is_aovs(Member member) {
    if constexpr (std::is_same_v<Member, uint32_t FilmIdentity::*>)
        return member == &FilmIdentity::aovs;
    return false;
}

} // namespace

std::string hash_of_names(const IdNames& names) {
    Hasher hasher;
    for (const auto& list : {names.objects, names.assets, names.materials}) {
        hasher.value(uint64_t(list.size()));
        for (const std::string& name : list) hasher.text(name);
    }
    return hasher.hex();
}

FilmIdentity film_identity(const Scene& scene, const RenderOptions& options, const BvhOptions& bvh,
                           LightSampler lights) {
    return {scene_hash(scene),
            options.camera,
            options.width,
            options.height,
            options.depth,
            options.roulette_start,
            options.seed,
            options.filter,
            options.integrator,
            options.background,
            options.aovs,
            options.light_groups,
            options.ids ? hash_of_names(id_names(scene)) : NO_IDS,
            options.clamp,
            options.noise,
            options.noise_exposure,
            bvh.watertight,
            lights};
}

std::string device_class(const gpu::DeviceFacts& facts) {
    return fmt::format("{}, {}, driver {}", facts.platform, facts.is_cpu ? "CPU" : facts.name,
                       facts.driver_version);
}

void check_same(const FilmHeader& film, const FilmHeader& wanted, const std::string& name) {
    const std::string what = name.empty() ? "the film" : name + ": this film";
    for_each_field(wanted.identity, [&](const auto& field, const auto& value) {
        if (film.identity.*field.member != value)
            throw InputError("{} is of another {}; go on with what it was begun with", what,
                             name_of(field));
    });
    for_each_field(wanted.maker, [&](const auto& field, const std::string& value) {
        if (film.maker.*field.member != value)
            throw InputError("{} is of another {}, {} instead of {}, so that its samples may have "
                             "other bits; go on with what it was begun with",
                             what, name_of(field), film.maker.*field.member, value);
    });
}

HeaderTexts texts_of(const FilmHeader& header) {
    HeaderTexts texts;
    for_each_field(header.identity, [&](const auto& field, const auto& value) {
        texts[key_of(name_of(field))] =
            is_aovs(field.member) ? aov_words_of(header.identity.aovs) : text_of(value);
    });
    for_each_field(header.maker, [&](const auto& field, const std::string& value) {
        texts[key_of(name_of(field))] = value;
    });
    if (header.identity.has_ids())
        for_each_list(header.names, [&](const std::string& key, const auto& names) {
            texts[key] = json_of(names);
        });
    texts[PREFIX + "device"] = header.device;
    texts[PREFIX + "samples"] = text_of(header.samples);
    texts[PREFIX + "exposure"] = text_of(header.display.exposure);
    texts[PREFIX + "tone_map"] = text_of(header.display.tone_map);
    return texts;
}

FilmHeader header_of(const HeaderTexts& all) {
    const Texts texts(all);
    FilmHeader header{};
    for_each_field(header.identity, [&](const auto& field, auto& value) {
        const std::string key = key_of(name_of(field));
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, uint32_t>)
            if (is_aovs(field.member)) {
                const std::optional<uint32_t> aovs = aovs_of(texts.text(key));
                if (!aovs) throw_meaningless(key, texts.text(key));
                value = *aovs;
                return;
            }
        texts.read(key, value);
    });
    for_each_field(header.maker, [&](const auto& field, std::string& value) {
        texts.read(key_of(name_of(field)), value);
    });
    if (header.identity.has_ids()) {
        for_each_list(header.names, [&](const std::string& key, auto& names) {
            names = names_of(key, texts.text(key));
        });
        if (header.identity.ids != hash_of_names(header.names) ||
            header.names.objects.size() != header.names.assets.size())
            throw std::runtime_error("its names have another hash");
    }
    texts.read(PREFIX + "device", header.device);
    texts.read(PREFIX + "samples", header.samples);
    texts.read(PREFIX + "exposure", header.display.exposure);
    texts.read(PREFIX + "tone_map", header.display.tone_map);
    return header;
}

} // namespace onde
