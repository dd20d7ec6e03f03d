// The scene that a pbrt file is being read into: directive by directive, as the file goes on.
// Statements in directives.cpp, transforms in transforms.cpp, materials and what else attributes
// hold in attributes.cpp, media in media.cpp, shapes and objects in world.cpp.
#pragma once

#include "scene/exact_scene.h"
#include "scene/file_words.h"
#include "scene/inclusion_count.h"
#include "scene/mesh_parts.h"
#include "scene/pbrt/light.h"
#include "scene/pbrt/material.h"

#include <filesystem>
#include <map>
#include <set>

namespace onde::pbrt {

class Reader {
  public:
    /// All errors are InputErrors that name the file and the line.
    Reader(const std::filesystem::path& path, LoadContext& context);

    Scene read();

    /// The directives, and what becomes of each.
    static std::vector<FileWord> directive_words();

  private:
    /// What directives change and AttributeEnd restores.
    struct State {
        glm::dmat4 transform{1.0};
        bool is_reversed = false;
        uint32_t material = 0;           ///< of materials_
        int64_t area_light = -1;         ///< of area_lights_
        std::string inside{}, outside{}; ///< media
        bool moves_start = true;         ///< whether transforms are those of the shutter's opening
    };
    struct Directive {
        std::string_view name;
        void (Reader::*read)();
        std::string_view becomes;
    };
    /// Something of an object that is placed later.
    struct Part {
        bool is_mesh;
        uint32_t of; ///< a mesh or a material of the scene
        ShapeKind kind;
        glm::dmat4 place;
    };
    using Parts = std::vector<Part>;
    /// What a surface looks like: its material, light and alpha.
    struct Look {
        uint32_t material = 0;
        int64_t area_light = -1;
        double alpha = 1.0;
        std::string alpha_texture{};
        std::string inside{}; ///< a medium

        auto operator<=>(const Look&) const = default;
    };

    static const Directive DIRECTIVES[];

    void read_file(const std::filesystem::path& path);
    void read_directives();
    void skip_directive(std::string_view name);

    // The arguments of a directive.
    Token require(Token::Kind kind, const char* what);
    std::string text(const char* what);
    double number();
    template <int N>
    std::array<double, N> numbers();
    glm::dvec3 vector();
    glm::dmat4 matrix();
    Parameters parameters() { return Parameters(*tokens_, cost_); }
    [[noreturn]] void fail(const std::string& problem) const;

    // Directives.
    void identity();
    void translate();
    void scale();
    void rotate();
    void look_at();
    void transform();
    void concat_transform();
    void coordinate_system();
    void coordinate_system_transform();
    void active_transform();
    void transform_times();
    void camera();
    void setting();
    void no_setting();
    void named_option();
    void color_space();
    void world_begin();
    void attribute_begin();
    void attribute_end();
    void transform_end();
    void attribute();
    void reverse_orientation();
    void material();
    void make_named_material();
    void named_material();
    void texture();
    void area_light_source();
    void light_source();
    void make_named_medium();
    void medium_interface();
    void shape();
    void object_begin();
    void object_end();
    void object_instance();
    void include();
    void import();

    void apply(const glm::dmat4& by);
    void save(char kind);
    void restore(char kind);
    void place(const Part& part);
    Look look(const Parameters& parameters);
    uint32_t material_of(const Look& look);
    void add_mesh(JoinedMesh joined, const Parameters& parameters);
    void add_mesh_file(const Parameters& parameters);
    void add_sphere(const Parameters& parameters);
    void add_disk(const Parameters& parameters);
    void add_cylinder(const Parameters& parameters);
    uint32_t number_of_material(const std::string& name);
    const Medium* find_medium(const std::string& name);
    /// Of the scene's grids; nothing, with a note, where there is none.
    std::optional<uint32_t> uniform_grid(const Parameters& parameters);
    std::optional<uint32_t> grid_file(const Parameters& parameters);
    uint32_t add_grid(DensityGrid grid);
    bool place_grid(Medium& medium, uint32_t grid);
    void set_emission(Medium& medium, const Parameters& parameters);
    void convert_looks();
    void add_opacity(const Look& look, Material& material);
    void report();

    std::filesystem::path path_;
    std::string name_;
    LoadContext& context_;
    GradualSpending cost_;
    Notes notes_;
    FileFinder files_;
    Sources sources_;
    ExactScene scene_;
    Textures textures_;
    std::vector<SkyLight> sky_;
    std::optional<glm::dmat4> camera_to_world_; ///< of pbrt's, which looks along +Z

    // Of the file in work.
    Tokens* tokens_ = nullptr;
    std::string_view directive_;
    std::vector<std::filesystem::path> ancestors_;
    InclusionCount inclusions_;

    State state_;
    std::vector<std::pair<char, State>> saved_;
    std::map<std::string, glm::dmat4> coordinate_systems_;
    MaterialSources materials_;
    std::map<std::string, uint32_t> material_of_name_;
    std::vector<AreaLight> area_lights_;
    std::map<std::string, Medium> media_;
    std::map<std::string, uint32_t> grid_files_; ///< to grids of the scene
    std::string around_camera_;                  ///< a medium
    std::map<Look, uint32_t> looks_;             ///< to materials of the scene
    struct KnownMesh {
        uint32_t mesh;
        glm::dvec3 origin;
    };
    std::map<std::tuple<std::string, uint32_t, bool>, KnownMesh> mesh_files_;
    std::map<std::string, Parts> objects_;
    Parts* object_ = nullptr; ///< that is being defined
};

} // namespace onde::pbrt
