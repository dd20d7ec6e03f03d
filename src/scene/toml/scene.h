// The scene that a TOML file is being read into: settings, cameras and materials in toml.cpp,
// geometry and lights in toml_shapes.cpp, other files in toml_includes.cpp.
#pragma once

#include "scene/merge.h"
#include "scene/references.h"
#include "scene/toml/motion.h"
#include "scene/toml/reader.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace onde {

/// Reads one file. All errors are InputErrors that name the file, the line and the key.
class TomlScene {
  public:
    /// Throws when the file is one of its own ancestors or lies too deep.
    TomlScene(const std::filesystem::path& path, LoadContext& context,
              std::vector<std::filesystem::path> ancestors);

    Scene read(const TableReader& root);

  private:
    /// A file that was included: its assets lie in the scene, ready to be placed again.
    struct Part {
        Scene placed; ///< without assets
        AssetOffsets offsets;
    };

    void read_settings(const TableReader& root);
    /// Reads whatever has a place, counted from the root's origin.
    void read_places(const TableReader& root);
    void forget_places();
    void read_camera(const TableReader& table);
    /// All of it but its textures.
    void read_material(const TableReader& table);
    /// Which of them are blended with which.
    void read_blends(const TableReader& root);
    /// Those of the materials that something in the scene has.
    void read_textures(const TableReader& root);
    void read_environment(const TableReader& root);
    /// Those of its own media, and where they lie, counted from the root's origin.
    void read_grids(const TableReader& root);
    uint32_t grid(const TableReader& medium);
    /// Calls visit(medium, its table) for each that has a density.
    template <class Visit>
    void for_each_grid(const TableReader& root, const Visit& visit);
    void read_shape(const TableReader& table);
    void read_light(const TableReader& table);
    void read_includes(const TableReader& root);

    void add_rectangle(const TableReader& table, uint32_t material);
    void add_sphere(const TableReader& table, uint32_t material);
    void add_box(const TableReader& table, uint32_t material);
    void add_plane(const TableReader& table, uint32_t material);
    void add_disk(const TableReader& table, uint32_t material);
    void add_round(const TableReader& table, ShapeKind kind, uint32_t material);
    void add_torus(const TableReader& table, uint32_t material);
    void add_ellipsoid(const TableReader& table, uint32_t material);
    void add_placed(const TableReader& table, Shape shape, const glm::vec3& size);
    void add_baked(const TableReader& table, Mesh mesh, const glm::mat4& transform);
    void add_mesh(const TableReader& table);
    void add_inline_mesh(const TableReader& table, uint32_t material);

    /// That the key names a file that there is.
    void check_texture(const TableReader& table, std::string_view key);
    int32_t texture(const TableReader& table, std::string_view key, bool srgb);
    uint32_t material_named_in(const TableReader& table);
    uint32_t default_material();
    /// Of the shape or light that the table states.
    uint32_t placed_name(const TableReader& table);
    uint32_t emitter(const TableReader& table);
    void add_area_light(const TableReader& table, AreaLight light, uint32_t material);
    void add_photometric_light(const TableReader& table);
    /// Of the IES file that the table names.
    const LightProfile& profile(const TableReader& table);
    void add_rectangle_light(const TableReader& table);
    void add_disk_light(const TableReader& table);
    void add_sphere_light(const TableReader& table);
    /// How a table's thing moves, at the moment of the load; nothing where it stands still.
    std::optional<Motion> motion_of(const TableReader& table,
                                    std::initializer_list<std::string_view> keys);
    /// What puts things into the scene that are counted from a point of their own.
    glm::mat4 placement(const TableReader& table, const glm::dvec3& from = glm::dvec3(0.0));
    /// The table states a placement if `is_placed`.
    void place(const TableReader& table, std::string_view key, const std::string& file,
               const Part& part, bool is_placed);

    /// Loads the file once for each material; later calls return the same part. `material` is
    /// given to all of the file's triangles unless it is negative. Shapes take geometry only.
    Part& part(const TableReader& table, std::string_view key, const std::string& file,
               bool geometry_only, int64_t material);

    LoadContext& context_;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> ancestors_; ///< ends with this file
    Scene scene_;
    std::map<std::string, uint32_t> material_of_name_;
    std::map<std::string, Part> parts_;
    std::map<std::string, uint32_t> grid_of_file_;
    std::map<std::filesystem::path, LightProfile> profiles_;
    int64_t default_material_ = -1;
    bool has_own_environment_ = false, has_own_medium_ = false;
    /// What was made of a table, by its place in the file, so that it is made anew in its place.
    std::map<std::string, uint32_t> mesh_of_table_, emitter_of_table_, name_of_table_;
};

} // namespace onde
