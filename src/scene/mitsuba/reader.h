// The scene that a Mitsuba file is being made of: sensors and settings in view.cpp, emitters in
// emitter.cpp, shapes in shape.cpp, media in medium.cpp.
#pragma once

#include "scene/exact_scene.h"
#include "scene/mesh_file.h"
#include "scene/mitsuba/material.h"
#include "scene/sky.h"

namespace onde::mitsuba {

class Reader {
  public:
    Reader(const std::filesystem::path& path, LoadContext& context);

    Scene read();

  private:
    /// Something of a shape group, placed by instances.
    struct Part {
        bool is_mesh;
        uint32_t of; ///< a mesh or a material of the scene
        ShapeKind kind;
        glm::dmat4 place;
    };
    using Parts = std::vector<Part>;
    /// What a surface looks like: its BSDF and the emitter on it, or null.
    struct Look {
        const Element *bsdf, *emitter, *medium;

        auto operator<=>(const Look&) const = default;
    };
    struct KnownMesh {
        uint32_t mesh;
        glm::dvec3 origin;
    };

    void add(const Element& element);

    void read_integrator(const Element& integrator, int depth = 0);
    void read_sensor(const Element& sensor);
    void read_film(const Element& film);
    void set_view(const Element& sensor, Camera& camera);

    void add_emitter(const Element& emitter);
    void add_sky(const Element& emitter);
    glm::vec3 strength(const Element& emitter, std::string_view name);

    void add_shape(const Element& shape, Parts* group);
    void add_instance(const Element& shape, Parts* group);
    void add_mesh_file(const Element& shape, Parts* group);
    void add_mesh(const Element& shape, Mesh mesh, const glm::dmat4& place, Parts* group);
    void add_rectangle(const Element& shape, Parts* group);
    void add_cube(const Element& shape, Parts* group);
    void add_sphere(const Element& shape, Parts* group);
    void add_disk(const Element& shape, Parts* group);
    void add_cylinder(const Element& shape, Parts* group);
    void place(const Part& part, Parts* group);
    uint32_t material_of(const Element& shape);
    std::optional<Medium> medium_of(const Element* element);
    bool take_grid(Medium& medium, const Element& volume);
    std::optional<uint32_t> grid_of(const Element& volume);
    glm::dvec3 color_of(const Element& of, std::string_view name, double absent);
    void set_phase(Medium& medium, const Element& phase);

    LoadContext& context_;
    std::string name_;
    Notes notes_;
    Document document_;
    ExactScene scene_;
    Materials materials_;
    std::vector<SkyLight> sky_;
    std::optional<glm::dmat4> camera_to_world_;
    std::map<Look, uint32_t> looks_; ///< to materials of the scene
    std::map<std::tuple<std::string, uint32_t, bool, bool, bool>, KnownMesh> mesh_files_;
    std::map<const Element*, Parts> groups_;
    std::map<std::string, uint32_t> grid_files_; ///< to grids of the scene
};

} // namespace onde::mitsuba
