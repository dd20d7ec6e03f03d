#include "scene/ply/words.h"

#include <algorithm>
#include <array>

namespace onde::ply {

namespace {

struct NumberWord {
    Slot slot;
    std::string_view word, becomes;
};

constexpr std::string_view NORMALS =
    "normals, made unit; without all three, shading is flat; a bad one is replaced by a face's, "
    "with a note";
constexpr std::string_view UVS = "texture coordinates; `v` is flipped to glTF's convention";
constexpr std::string_view COLORS = "colours (sRGB), as bytes, 16-bit numbers or 0 to 1, which "
                                    "multiply the base colour, then white; without all of red, "
                                    "green and blue ignored, with a note";

constexpr NumberWord NUMBERS[] = {
    {X, "x", "positions"}, {Y, "y", "positions"}, {Z, "z", "positions"}, {NX, "nx", NORMALS},
    {NY, "ny", NORMALS},   {NZ, "nz", NORMALS},   {U, "u", UVS},         {V, "v", UVS},
    {U, "s", UVS},         {V, "t", UVS},         {U, "texture_u", UVS}, {V, "texture_v", UVS},
    {U, "texture_s", UVS}, {V, "texture_t", UVS}, {R, "red", COLORS},    {G, "green", COLORS},
    {B, "blue", COLORS},   {A, "alpha", COLORS}};

constexpr std::string_view CORNERS = "a list of integers: the vertices of a face or strip";
constexpr std::array CORNER_LISTS{FileWord{"vertex_indices", CORNERS},
                                  FileWord{"vertex_index", CORNERS}};
constexpr FileWord CORNER_UVS{"texcoord",
                              "a list, as MeshLab writes it: texture coordinates of the corners "
                              "of a face"};

} // namespace

Slot slot_of(const Property& property) {
    const auto found = std::ranges::find(NUMBERS, property.name, &NumberWord::word);
    return property.count_type || found == std::end(NUMBERS) ? UNUSED : found->slot;
}

bool is_corner_list(const Property& property) {
    return property.count_type &&
           std::ranges::find(CORNER_LISTS, property.name, &FileWord::word) != CORNER_LISTS.end();
}

bool is_corner_uvs(const Property& property) {
    return property.count_type && property.name == CORNER_UVS.word;
}

std::vector<FileWord> element_words() {
    return {{VERTEX, "vertices, of at least `x`, `y` and `z`, of any type; before the faces"},
            {FACE, "polygons of any number of corners, triangulated; points and lines, and faces "
                   "with positions that are no finite numbers, are skipped, with a note"},
            {STRIPS, "triangle strips; -1 ends one"}};
}

std::vector<FileWord> property_words() {
    std::vector<FileWord> words;
    for (const NumberWord& number : NUMBERS) words.push_back({number.word, number.becomes});
    words.insert(words.end(), CORNER_LISTS.begin(), CORNER_LISTS.end());
    words.push_back(CORNER_UVS);
    return words;
}

} // namespace onde::ply
