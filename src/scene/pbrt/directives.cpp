// The statements of a pbrt file, one after the other, and those that are no shapes or transforms.
#include "scene/pbrt/reader.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/pbrt/view.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace onde::pbrt {
namespace fs = std::filesystem;

static constexpr size_t MAX_DEPTH = 16; ///< of included files

const Reader::Directive Reader::DIRECTIVES[] = {
    {"Identity", &Reader::identity, "as in pbrt"},
    {"Translate", &Reader::translate, "as in pbrt"},
    {"Scale", &Reader::scale, "as in pbrt"},
    {"Rotate", &Reader::rotate, "as in pbrt"},
    {"LookAt", &Reader::look_at, "as in pbrt"},
    {"Transform", &Reader::transform, "as in pbrt"},
    {"ConcatTransform", &Reader::concat_transform, "as in pbrt"},
    {"CoordinateSystem", &Reader::coordinate_system, "as in pbrt"},
    {"CoordSysTransform", &Reader::coordinate_system_transform, "as in pbrt"},
    {"AttributeBegin", &Reader::attribute_begin, "as in pbrt"},
    {"AttributeEnd", &Reader::attribute_end, "as in pbrt"},
    {"TransformBegin", &Reader::attribute_begin, "as in pbrt"},
    {"TransformEnd", &Reader::transform_end, "as in pbrt"},
    {"ReverseOrientation", &Reader::reverse_orientation, "as in pbrt"},
    {"ObjectBegin", &Reader::object_begin, "as in pbrt"},
    {"ObjectEnd", &Reader::object_end, "as in pbrt"},
    {"ObjectInstance", &Reader::object_instance, "as in pbrt"},
    {"Include", &Reader::include, "as in pbrt"},
    {"Import", &Reader::import, "as in pbrt"},
    {"WorldBegin", &Reader::world_begin, "as in pbrt"},
    {"ActiveTransform", &Reader::active_transform, "the start's transforms alone, with a note"},
    {"TransformTimes", &Reader::transform_times, "nothing"},
    {"Camera", &Reader::camera,
     "a camera: `perspective` or `orthographic`; others are perspective, with a note"},
    {"Film", &Reader::setting, "the picture's size"},
    {"Sampler", &Reader::setting, "samples per pixel"},
    {"Integrator", &Reader::setting, "one more surface than its `maxdepth`, which counts bounces"},
    {"PixelFilter", &Reader::setting,
     "the filter of that name or the nearest, of Onde's own width"},
    {"Accelerator", &Reader::no_setting, "nothing"},
    {"Option", &Reader::named_option, "nothing"},
    {"Attribute", &Reader::attribute, "ignored, with a note"},
    {"ColorSpace", &Reader::color_space, "sRGB, with a note where it is another"},
    {"Material", &Reader::material, "a material, see below"},
    {"MakeNamedMaterial", &Reader::make_named_material, "a material, see below"},
    {"NamedMaterial", &Reader::named_material, "a material, see below"},
    {"Texture", &Reader::texture,
     "`imagemap`, `constant`, `scale`, `mix`, `checkerboard`; others are grey, with a note"},
    {"LightSource", &Reader::light_source,
     "`point`, `spot`, `distant`, `infinite`, `goniometric`; others are left out, with a note"},
    {"AreaLightSource", &Reader::area_light_source, "emission of the front, or of both sides"},
    {"Shape", &Reader::shape,
     "`trianglemesh`, `plymesh`, `sphere`, `disk`, `cylinder`, `bilinearmesh` and `loopsubdiv` by "
     "their corners; others are left out, with a note"},
    {"MakeNamedMedium", &Reader::make_named_medium,
     "`homogeneous`, `uniformgrid` and `nanovdb` by their density; others are left out, with a "
     "note"},
    {"MediumInterface", &Reader::medium_interface,
     "what is inside of shapes that let light in, and around the camera"}};

Reader::Reader(const fs::path& path, LoadContext& context)
    : path_(path), name_(path.string()), context_(context), cost_(context, name_),
      notes_(context.notes_of(path)),
      files_(path.has_parent_path() ? path.parent_path() : fs::path("."), context),
      sources_{context, files_, notes_}, scene_(context, name_),
      textures_(scene_.assets(), sources_) {
    materials_.push_back({"default", "diffuse", {}});
}

std::vector<FileWord> Reader::directive_words() {
    std::vector<FileWord> words;
    for (const Directive& directive : DIRECTIVES)
        words.push_back({directive.name, directive.becomes});
    return words;
}

Scene Reader::read() {
    read_file(path_);
    if (!saved_.empty()) notes_.wrong("Attributes that begin and do not end go to the file's end");
    convert_looks();
    // Pictures are mirrored by a left-handed camera, unless the world is too.
    const bool is_mirrored = !camera_to_world_ || glm::determinant(*camera_to_world_) > 0.0;
    glm::dmat4 to_ours(1.0);
    if (is_mirrored) to_ours[2].z = -1.0;
    if (is_mirrored) notes_.add("The world is left-handed: its z is turned around");
    Scene& assets = scene_.assets();
    for (SkyLight& light : sky_) light.light_to_world = glm::dmat3(to_ours) * light.light_to_world;
    if (!sky_.empty()) assets.environment = environment_of(std::move(sky_), context_, name_);
    Scene scene = scene_.finish(to_ours);
    const std::vector<std::string> sentences = notes_.sentences();
    scene.notes.insert(scene.notes.begin(), sentences.begin(), sentences.end());
    return scene;
}

void Reader::read_file(const fs::path& path) {
    const fs::path self = fs::weakly_canonical(path);
    if (std::ranges::find(ancestors_, self) != ancestors_.end())
        throw InputError("{}: includes itself, directly or through another file; break the cycle",
                         path.string());
    if (ancestors_.size() >= MAX_DEPTH)
        throw InputError("{}: files are included more than {} deep; flatten them", path.string(),
                         MAX_DEPTH);
    inclusions_.add(path);
    ancestors_.push_back(self);
    const std::string file_name = path.string();
    const auto text = text::decode(read_file_within(context_, path));
    if (!text) throw InputError("{}: not a text file; a .pbrt must be ASCII or UTF-8", file_name);
    Tokens tokens(file_name, *text);
    Tokens* const outer = std::exchange(tokens_, &tokens);
    read_directives();
    tokens_ = outer;
    ancestors_.pop_back();
}

void Reader::read_directives() {
    constexpr uint64_t DIRECTIVE_BYTES = 512; // at most, of a material or a name and its transform
    while (const auto token = tokens_->next()) {
        cost_.add(DIRECTIVE_BYTES);
        directive_ = token->text;
        const auto known = std::ranges::find(DIRECTIVES, directive_, &Directive::name);
        if (token->kind != Token::Kind::word)
            fail("stands where a directive should; close what comes before it");
        if (known != std::end(DIRECTIVES))
            (this->*known->read)();
        else
            skip_directive(directive_);
    }
}

/// Up to the next word that no number is.
void Reader::skip_directive(std::string_view name) {
    notes_.wrong("Directives that pbrt-v4 does not have are left out", std::string(name));
    while (const auto token = tokens_->peek()) {
        const bool is_word = token->kind == Token::Kind::word && !text::number(token->text) &&
                             token->text != "true" && token->text != "false";
        if (is_word) return;
        tokens_->next();
    }
}

void Reader::fail(const std::string& problem) const {
    throw InputError("{}: {}: {}", tokens_->where(), shown(directive_), problem);
}

Token Reader::require(Token::Kind kind, const char* what) {
    const auto token = tokens_->next();
    if (!token || token->kind != kind) fail(fmt::format("{} should follow; add it", what));
    return *token;
}

std::string Reader::text(const char* what) {
    return unescaped(require(Token::Kind::text, what).text);
}

double Reader::number() {
    const Token token = require(Token::Kind::word, "a number");
    const auto value = text::number(token.text);
    if (!value || !std::isfinite(*value))
        fail(fmt::format("'{}' is no finite number", shown(token.text)));
    return *value;
}

template <int N>
std::array<double, N> Reader::numbers() {
    std::array<double, N> values;
    for (double& value : values) value = number();
    return values;
}

glm::dvec3 Reader::vector() {
    const auto v = numbers<3>();
    return {v[0], v[1], v[2]};
}

glm::dmat4 Reader::matrix() {
    const bool has_brackets = tokens_->peek() && tokens_->peek()->kind == Token::Kind::open;
    if (has_brackets) tokens_->next();
    const auto values = numbers<16>();
    if (has_brackets) require(Token::Kind::close, "a closing bracket after 16 numbers");
    glm::dmat4 m;
    for (size_t i = 0; i < values.size(); ++i)
        m[glm::length_t(i / 4)][glm::length_t(i % 4)] = values[i]; // both are stored by columns
    return m;
}

void Reader::camera() {
    const std::string kind = text("a kind of camera");
    const Parameters p = parameters();
    coordinate_systems_["camera"] = glm::inverse(state_.transform);
    const glm::dmat4& to_world = coordinate_systems_["camera"];
    const double volume = std::abs(glm::determinant(glm::dmat3(to_world)));
    if (!(volume > 0.0) || !std::isfinite(volume)) fail("has a transform without an inverse");
    if (camera_to_world_) return notes_.wrong("Of several cameras the first counts");
    camera_to_world_ = to_world;
    around_camera_ = state_.outside;
    glm::dmat4 looks_back = to_world;
    looks_back[2] = -looks_back[2];
    scene_.place_camera(camera_of(kind, p, scene_.assets().settings, notes_), looks_back);
    for (const std::string& unused : p.unused())
        notes_.add("Other parameters of cameras are ignored", unused);
}

void Reader::setting() {
    const std::string_view directive = directive_;
    const std::string kind = text("a kind");
    const Parameters p = parameters();
    read_setting(directive, kind, p, scene_.assets().settings, notes_);
    for (const std::string& unused : p.unused())
        notes_.add(fmt::format("Other parameters of {} are ignored", directive), unused);
}

void Reader::no_setting() {
    text("a kind");
    parameters();
}

void Reader::named_option() {
    parameters();
}

void Reader::attribute() {
    text("what it is of");
    parameters();
    notes_.add("Defaults that Attribute gives to what follows are ignored");
}

void Reader::color_space() {
    if (const std::string name = text("a name"); name != "srgb")
        notes_.add("Colours of other colour spaces are taken as sRGB", name);
}

void Reader::world_begin() {
    complete_settings(scene_.assets().settings);
    state_.transform = glm::dmat4(1.0);
    state_.moves_start = true;
    coordinate_systems_["world"] = state_.transform;
}

void Reader::include() {
    const std::string file = text("a file");
    const auto found = files_.find(file);
    if (!found && files_.may_use(file))
        fail(fmt::format("names '{}', which does not exist; check the name", shown(file)));
    read_file(context_.resolve(files_.folder(), found.value_or(file), tokens_->where()));
}

void Reader::import() {
    const State kept = state_;
    const size_t depth = saved_.size();
    include();
    saved_.resize(std::min(saved_.size(), depth));
    state_ = kept;
}

} // namespace onde::pbrt
