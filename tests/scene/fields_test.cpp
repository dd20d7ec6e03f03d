// What follows from the tables of fields, for each member that they list.
#include "scratch.h"

#include "scene/merge.h"
#include "shared/scene.h"

#include <limits>
#include <set>

using namespace onde;

namespace {

struct Fog {
    float density = 0.5f;
    std::optional<glm::vec3> color;
    uint32_t material = 0;
};

constexpr auto fields_of(TypeTag<Fog>) {
    return std::tuple{
        field("density", &Fog::density, "per metre", {.range = UNIT, .alias = "thickness"}),
        LoaderKey{"file", "text", "", ""}, field("color", &Fog::color, "", {.form = Form::color}),
        field_without_key(&Fog::material, "material", {.form = Form::material})};
}

struct Five {
    std::string a;
    glm::mat4 b;
    std::optional<ScreenWindow> c;
    std::vector<float> d;
    Fog e;
};
static_assert(fields_detail::count_members<Five>() == 5);
static_assert(fields_detail::count_members<Fog>() == 3);

Scene one_of_each() {
    Scene scene;
    scene.materials.resize(2);
    scene.textures.push_back({"t", {1, 1, {0, 0, 0, 0}}});
    scene.spheres.push_back({glm::vec3(0), 1.0f, 0});
    scene.shapes.emplace_back();
    scene.point_lights.emplace_back();
    scene.directional_lights.emplace_back();
    scene.cameras.emplace_back();
    scene.cameras[0].screen.emplace();
    scene.chapter.phong[0] = {};
    scene.chapter.area_lights.emplace_back();
    return scene;
}

/// Another value of the same type that is in range.
void change(bool& value) {
    value = !value;
}
void change(float& value) {
    value = value == 0.5f ? 0.25f : 0.5f;
}
void change(uint32_t& value) {
    value = value == 3 ? 4 : 3;
}
void change(int32_t& value) {
    value = value == 0 ? NO_TEXTURE : 0;
}
void change(std::string& value) {
    value = value == "renamed" ? "again" : "renamed";
}
void change(std::vector<std::string>& value) {
    value.emplace_back("one");
}
void change(glm::mat4& value) {
    value[3].x += 1.0f;
}
void change(Image& image) {
    image = Image(1, 1, 3);
}
template <glm::length_t N>
void change(glm::vec<N, float>& value) {
    change(value[0]);
}
template <WordedEnum Enum>
void change(Enum& value) {
    value = value == WORDS_OF<Enum>[0].value ? WORDS_OF<Enum>[1].value : WORDS_OF<Enum>[0].value;
}
template <class T>
void change(std::optional<T>& value);
template <Fielded T>
void change(T& value) {
    for_each_field(value, [](const auto&, auto& member) { change(member); });
}
template <class T>
void change(std::optional<T>& value) {
    if (value)
        change(*value);
    else
        value.emplace();
}

/// Each member of a thing of the scene, changed alone, makes another hash; names don't, but for
/// those of groups.
template <class Find>
void check_hash(const Find& find) {
    Scene scene = one_of_each();
    std::set<std::string> hashes{scene_hash(scene)};
    size_t members = 0;
    for_each_field(find(scene), [&]<class Value>(const auto& field, Value& value) {
        const Value before = value;
        INFO(name_of(field));
        change(value);
        const bool is_text = std::is_same_v<Value, std::string>;
        const bool is_name = field.rules.form == Form::name;
        if (is_name || (is_text && field.rules.form != Form::group))
            CHECK(hashes.contains(scene_hash(scene)));
        else
            CHECK(hashes.insert(scene_hash(scene)).second);
        value = before;
        ++members;
    });
    CHECK(members >= 2);
}

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/// A NaN in any member of a thing is refused by the member's name.
template <class Find>
void check_nan(const Find& find) {
    Scene scene = one_of_each();
    for_each_field(find(scene), [&]<class Value>(const auto& field, Value& value) {
        const Value before = value;
        if constexpr (std::is_same_v<Value, float>)
            value = NOT_A_NUMBER;
        else if constexpr (std::is_same_v<Value, glm::vec3>)
            value.y = NOT_A_NUMBER;
        else
            return;
        CHECK_THROWS_WITH(check_scene(scene),
                          Catch::Contains(std::string(name_of(field)) + " must"));
        value = before;
    });
}

template <class Check>
void for_each_thing(const Check& check) {
    check([](Scene & s) -> auto& { return s.materials[0]; });
    check([](Scene & s) -> auto& { return s.spheres[0]; });
    check([](Scene & s) -> auto& { return s.shapes[0]; });
    check([](Scene & s) -> auto& { return s.point_lights[0]; });
    check([](Scene & s) -> auto& { return s.directional_lights[0]; });
    check([](Scene & s) -> auto& { return s.environment; });
    check([](Scene & s) -> auto& { return s.cameras[0]; });
    check([](Scene & s) -> auto& { return *s.cameras[0].screen; });
    check([](Scene & s) -> auto& { return s.chapter.phong[0]; });
    check([](Scene & s) -> auto& { return s.chapter.area_lights[0]; });
    check([](Scene & s) -> auto& { return s.chapter.whitted; });
}

} // namespace

TEST_CASE("a table's keys are those of members, their aliases and those that loaders read") {
    CHECK(keys_of<Fog>() == std::vector<std::string_view>{"density", "thickness", "file", "color"});
    std::string names;
    Fog fog;
    for_each_field(fog,
                   [&](const auto& field, auto&) { names += std::string(name_of(field)) + " "; });
    CHECK(names == "density color material ");
}

TEST_CASE("the scene that tests of fields start from is valid") {
    CHECK_NOTHROW(check_scene(one_of_each()));
}

TEST_CASE("every member of what a scene holds is in its hash, but for names") {
    for_each_thing([](const auto& find) { check_hash(find); });
}

TEST_CASE("every number of what a scene holds is checked") {
    for_each_thing([](const auto& find) { check_nan(find); });
}

TEST_CASE("every texture slot is checked, and moved with the textures of its scene") {
    size_t slots = 0;
    Material material;
    for_each_texture(material, [&](const auto& field, int32_t&) {
        Scene scene = one_of_each();
        scene.materials[0].*field.member = 1;
        CHECK_THROWS_WITH(check_scene(scene), Catch::Contains(std::string(field.key)));
        scene.materials[0].*field.member = 0;
        Scene whole = one_of_each();
        append(whole, std::move(scene));
        CHECK(whole.materials[2].*field.member == 1);
        CHECK(whole.materials[3].*field.member == NO_TEXTURE);
        ++slots;
    });
    CHECK(slots == TEXTURE_COUNT);
}

TEST_CASE("every render setting is taken from a part where the whole has none") {
    Scene part = one_of_each(), whole = one_of_each(), own = one_of_each();
    change(part.settings);
    own.settings.seed = 9;
    append(own, Scene(part));
    CHECK(own.settings.seed == 9u);
    append(whole, Scene(part));
    for_each_entry<RenderSettings>([&](const auto& field) {
        INFO(name_of(field));
        CHECK(whole.settings.*field.member == part.settings.*field.member);
        CHECK(whole.settings.*field.member);
    });
}

TEST_CASE("what the chapter states of materials and lights moves with them") {
    Scene whole = one_of_each(), part = one_of_each();
    part.chapter.phong[1].exponent = 7;
    part.chapter.intensities.point_lights[0] = glm::vec3(2);
    append(whole, std::move(part));
    CHECK(whole.chapter.phong.at(3).exponent == 7);
    CHECK(whole.chapter.intensities.point_lights.at(1) == glm::vec3(2));
    CHECK_FALSE(whole.chapter.intensities.point_lights.contains(0));
    CHECK(whole.chapter.area_lights[1].material == 2);
}
