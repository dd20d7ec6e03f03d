// The node tree of glTF (section 3.5): where meshes, cameras and lights stand.
#include "core/error.h"
#include "scene/gltf_scene.h"
#include "scene/merge.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde::gltf {

namespace {

constexpr size_t MAX_DEPTH = 4096;

struct Visit {
    int node;
    glm::dmat4 parent_to_world;
    size_t depth;
};

bool finite(const glm::dmat4& m) {
    // In float's range too, since that is what the scene holds.
    return std::all_of(&m[0][0], &m[0][0] + 16, [](double x) { return std::isfinite(float(x)); });
}

glm::dmat4 local_transform(const File& file, const tinygltf::Node& node, const std::string& user) {
    glm::dmat4 m(1.0);
    if (node.matrix.size() == 16) {
        for (size_t i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[i];
        if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
            throw InputError("{}: {}: its matrix is not affine; export it again",
                             file.path.string(), user);
        return m;
    }
    const std::vector<double>&t = node.translation, &r = node.rotation, &s = node.scale;
    if (t.size() == 3) m = glm::translate(m, glm::dvec3(t[0], t[1], t[2]));
    if (r.size() == 4) {
        const glm::dquat rotation(r[3], r[0], r[1], r[2]);
        if (!(glm::length(rotation) > 1e-12))
            throw InputError("{}: {}: its rotation is no quaternion; export it again",
                             file.path.string(), user);
        m *= glm::mat4_cast(glm::normalize(rotation));
    }
    if (s.size() == 3) m = glm::scale(m, glm::dvec3(s[0], s[1], s[2]));
    return m;
}

/// Traversals the tree without recursion, so that a chain of a million nodes is only refused.
class NodeTraversal {
  public:
    NodeTraversal(File& file, Scene& scene)
        : file_(file), scene_(scene), visited_(file.model.nodes.size(), false) {}

    void traverse(const std::vector<int>& roots) {
        push(roots, glm::dmat4(1.0), 0, "scene");
        while (!stack_.empty()) {
            const Visit visit = stack_.back();
            stack_.pop_back();
            enter(visit);
        }
    }

  private:
    void push(const std::vector<int>& nodes, const glm::dmat4& to_world, size_t depth,
              const std::string& user) {
        // Reversed, so that nodes come off the stack in the file's order.
        for (size_t i = nodes.size(); i-- > 0;) {
            at(file_, file_.model.nodes, nodes[i], "node", user);
            stack_.push_back({nodes[i], to_world, depth});
        }
    }

    void enter(const Visit& visit);
    void add_instance(int mesh, const glm::mat4& to_world, const std::string& user);
    void add_camera(int camera, const glm::mat4& to_world, const std::string& user);
    void add_light(const tinygltf::Node& node, const glm::mat4& to_world, const std::string& user);

    File& file_;
    Scene& scene_;
    std::vector<bool> visited_;
    std::vector<Visit> stack_;
};

void NodeTraversal::enter(const Visit& visit) {
    const tinygltf::Node& node = file_.model.nodes[size_t(visit.node)];
    const std::string user = fmt::format("node {}", visit.node);
    if (visited_[size_t(visit.node)])
        throw InputError("{}: {}: it is reached twice, by a cycle or by two parents; export it "
                         "again",
                         file_.path.string(), user);
    visited_[size_t(visit.node)] = true;
    if (visit.depth > MAX_DEPTH)
        throw InputError("{}: {}: nodes are nested more than {} deep; flatten them",
                         file_.path.string(), user, MAX_DEPTH);
    const glm::dmat4 to_world = visit.parent_to_world * local_transform(file_, node, user);
    if (!finite(to_world))
        throw InputError("{}: {}: its transform is not finite; export it again",
                         file_.path.string(), user);
    if (node.mesh >= 0) add_instance(node.mesh, glm::mat4(to_world), user);
    if (node.camera >= 0) add_camera(node.camera, glm::mat4(to_world), user);
    if (node.extensions.contains("KHR_lights_punctual")) add_light(node, glm::mat4(to_world), user);
    if (node.extensions.contains("EXT_mesh_gpu_instancing"))
        file_.notes.add("Instances of EXT_mesh_gpu_instancing are ignored", user);
    push(node.children, to_world, visit.depth + 1, user);
}

/// Whether a transform flattens space, as exporters do to hide an object.
bool is_flat(const glm::mat4& m) {
    const glm::mat4 inverse = glm::inverse(m);
    return glm::determinant(m) == 0.0f || !std::all_of(&inverse[0][0], &inverse[0][0] + 16,
                                                       [](float x) { return std::isfinite(x); });
}

void NodeTraversal::add_instance(int mesh, const glm::mat4& to_world, const std::string& user) {
    at(file_, file_.model.meshes, mesh, "mesh", user);
    if (is_flat(to_world)) {
        file_.notes.add("Objects scaled to nothing are skipped", user);
    } else if (!scene_.meshes[size_t(mesh)].triangles.empty()) {
        scene_.instances.push_back({uint32_t(mesh), to_world});
    }
}

void NodeTraversal::add_camera(int index, const glm::mat4& to_world, const std::string& user) {
    const tinygltf::Camera& source = at(file_, file_.model.cameras, index, "camera", user);
    if (source.type != "perspective" || is_flat(to_world)) {
        file_.notes.add("Orthographic and degenerate cameras are skipped", user);
        return;
    }
    if (!(source.perspective.yfov > 0.0 && source.perspective.yfov < std::numbers::pi))
        throw InputError(
            "{}: camera {}: its yfov {} does not lie between 0 and pi; export it again",
            file_.path.string(), index, source.perspective.yfov);
    Camera camera;
    camera.name = source.name;
    camera.camera_to_world = rigid_part(to_world);
    camera.vertical_fov = float(source.perspective.yfov);
    scene_.cameras.push_back(camera);
}

/// Candela and lux are taken as W/sr and W/m^2: only ratios show in a picture.
void NodeTraversal::add_light(const tinygltf::Node& node, const glm::mat4& to_world,
                              const std::string& user) {
    const double index = number_in(node.extensions.at("KHR_lights_punctual"), "light", -1.0);
    const int light = index >= 0.0 && index < 1e9 ? int(index) : -1;
    const tinygltf::Light& source = at(file_, file_.model.lights, light, "light", user);
    glm::vec3 intensity(std::max(0.0f, float(source.intensity)));
    for (size_t i = 0; i < std::min<size_t>(3, source.color.size()); ++i)
        intensity[i] *= std::max(0.0f, float(source.color[i]));
    if (source.type == "directional") {
        if (is_flat(to_world)) return;
        const glm::vec3 to_light = glm::normalize(glm::vec3(to_world[2])); // it shines along -Z
        scene_.directional_lights.push_back({to_light, intensity});
    } else {
        if (source.type == "spot") file_.notes.add("Spot lights shine as points", user);
        scene_.point_lights.push_back({glm::vec3(to_world[3]), intensity});
    }
}

/// Nodes that no other node has as a child, for files without scenes.
std::vector<int> roots_of(const File& file) {
    std::vector<bool> is_child(file.model.nodes.size(), false);
    for (const tinygltf::Node& node : file.model.nodes)
        for (int child : node.children)
            if (child >= 0 && size_t(child) < is_child.size()) is_child[size_t(child)] = true;
    std::vector<int> roots;
    for (size_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(int(i));
    return roots;
}

} // namespace

void add_nodes(File& file, Scene& scene) {
    NodeTraversal nodes(file, scene);
    if (file.model.scenes.empty()) return nodes.traverse(roots_of(file));
    const int index = file.model.defaultScene >= 0 ? file.model.defaultScene : 0;
    nodes.traverse(at(file, file.model.scenes, index, "scene", "the default scene").nodes);
    if (file.model.scenes.size() > 1) file.notes.add("Only the default scene is loaded");
}

} // namespace onde::gltf
