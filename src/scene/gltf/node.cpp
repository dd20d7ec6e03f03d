// The node tree of glTF (section 3.5): where meshes, cameras and lights stand.
#include "core/error.h"
#include "scene/gltf/choice.h"
#include "scene/gltf/placement.h"
#include "scene/gltf/reachable.h"
#include "scene/gltf/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace onde::gltf {

namespace {

constexpr size_t MAX_DEPTH = 4096;

struct Visit {
    uint32_t node;
    glm::dmat4 parent_to_world;
    size_t depth;
    uint32_t top; ///< node above it
};

bool finite(const glm::dmat4& m) {
    // In float's range too, since that is what the scene holds.
    return std::all_of(&m[0][0], &m[0][0] + 16, [](double x) { return std::isfinite(float(x)); });
}

/// Traverses the tree without recursion, so that a chain of a million nodes is only refused.
class NodeTraversal {
  public:
    NodeTraversal(File& file, Scene& scene)
        : file_(file), scene_(scene), meshes_(file, scene),
          visited_(file.document.nodes.size(), false) {}

    void traverse(const std::vector<uint32_t>& roots) {
        push(roots, glm::dmat4(1.0), 0, "scene");
        while (!stack_.empty()) {
            const Visit visit = stack_.back();
            stack_.pop_back();
            node_ = visit.node;
            top_ = visit.top;
            enter(visit);
        }
        place(file_, placements_, meshes_.origins(), scene_);
    }

  private:
    void push(const std::vector<uint32_t>& nodes, const glm::dmat4& to_world, size_t depth,
              const std::string& user) {
        // Reversed, so that nodes come off the stack in the file's order.
        for (size_t i = nodes.size(); i-- > 0;) {
            at(file_, file_.document.nodes, nodes[i], "node", user);
            stack_.push_back({nodes[i], to_world, depth, depth == 0 ? nodes[i] : top_});
        }
    }

    void enter(const Visit& visit);
    void add_mesh(const Node& node, const glm::dmat4& to_world, const std::string& user);
    void add_skinned(const Node& node, const std::string& user);
    void add_copies(const Node& node, uint32_t mesh, const glm::dmat4& to_world,
                    const std::string& user);
    void add_instance(uint32_t mesh, const glm::dmat4& to_world, const std::string& user);

    File& file_;
    Scene& scene_;
    MeshLoader meshes_;
    Placements placements_;
    std::optional<NodeWorlds> worlds_;                   ///< where skins need them
    std::map<uint32_t, std::vector<glm::dmat4>> joints_; ///< matrices, by skin
    std::vector<bool> visited_;
    std::vector<Visit> stack_;
    uint32_t node_ = 0, top_ = 0; ///< that is visited, and the topmost one above it
};

void NodeTraversal::enter(const Visit& visit) {
    const Node& node = file_.document.nodes[visit.node];
    const std::string user = fmt::format("node {}", visit.node);
    if (visited_[visit.node])
        throw InputError("{}: {}: it is reached twice, by a cycle or by two parents; export it "
                         "again",
                         file_.name, user);
    visited_[visit.node] = true;
    if (visit.depth > MAX_DEPTH)
        throw InputError("{}: {}: nodes are nested more than {} deep; flatten them", file_.name,
                         user, MAX_DEPTH);
    const glm::dmat4 to_world = visit.parent_to_world * local_transform(file_, node, user);
    if (!finite(to_world))
        throw InputError("{}: {}: its transform is not finite; export it again", file_.name, user);
    if (!node.visible) return file_.notes.add("Nodes that the file hides are skipped", user);
    if (node.mesh) add_mesh(node, to_world, user);
    const glm::dmat4 solid = with_thickness(to_world).value_or(to_world);
    if (node.camera) placements_.cameras.push_back({*node.camera, visit.node, solid});
    if (node.light) placements_.lights.push_back({*node.light, visit.node, solid});
    push(node.children, to_world, visit.depth + 1, user);
}

bool has_joints(const MeshSource& mesh) {
    return std::ranges::any_of(mesh.primitives, [](const Primitive& primitive) {
        return primitive.attributes.contains("JOINTS_0") &&
               primitive.attributes.contains("WEIGHTS_0");
    });
}

void NodeTraversal::add_mesh(const Node& node, const glm::dmat4& to_world,
                             const std::string& user) {
    const MeshSource& source = at(file_, file_.document.meshes, *node.mesh, "mesh", user);
    if (node.skin && has_joints(source)) return add_skinned(node, user);
    if (node.skin)
        file_.notes.wrong("Skins of meshes without joints and weights are ignored", user);
    const Index mesh = meshes_.load(*node.mesh, {node.weights}, std::nullopt, user);
    if (!mesh) return;
    if (node.instancing)
        add_copies(node, *mesh, to_world, user);
    else
        add_instance(*mesh, to_world, user);
}

/// The joints place such a mesh, not the node (section 3.7.3.3).
void NodeTraversal::add_skinned(const Node& node, const std::string& user) {
    at(file_, file_.document.skins, *node.skin, "skin", user);
    if (!worlds_) worlds_.emplace(file_);
    const auto [joints, is_new] = joints_.try_emplace(*node.skin);
    if (is_new) joints->second = joint_matrices(file_, *node.skin, *worlds_);
    const Index mesh = meshes_.load(*node.mesh, {node.weights, joints->second}, node.skin, user);
    if (mesh) add_instance(*mesh, glm::dmat4(1.0), user);
}

/// The copies of EXT_mesh_gpu_instancing, each with a transform of its own before the node's.
void NodeTraversal::add_copies(const Node& node, uint32_t mesh, const glm::dmat4& to_world,
                               const std::string& user) {
    std::optional<size_t> count;
    const auto read = [&](const char* name, uint32_t components) {
        const auto accessor = node.instancing->find(name);
        if (accessor == node.instancing->end()) return std::vector<float>();
        const std::string what = user + " " + name;
        std::vector<float> values = read_floats(file_, accessor->second, components, what);
        if (count.value_or(values.size() / components) != values.size() / components)
            throw InputError("{}: {}: it has {} elements where another has {}; export it again",
                             file_.name, what, values.size() / components, *count);
        count = values.size() / components;
        return values;
    };
    const std::vector<float> moves = read("TRANSLATION", 3), turns = read("ROTATION", 4),
                             scales = read("SCALE", 3);
    for (size_t i = 0; i < count.value_or(0); ++i) {
        Node copy;
        for (size_t c = 0; c < 3 && !moves.empty(); ++c) copy.translation[c] = moves[3 * i + c];
        for (size_t c = 0; c < 4 && !turns.empty(); ++c) copy.rotation[c] = turns[4 * i + c];
        for (size_t c = 0; c < 3 && !scales.empty(); ++c) copy.scale[c] = scales[3 * i + c];
        const glm::dmat4 placed = to_world * local_transform(file_, copy, user);
        if (finite(placed))
            add_instance(mesh, placed, user);
        else
            file_.notes.wrong("Instances whose transform is not finite are skipped", user);
    }
}

void NodeTraversal::add_instance(uint32_t mesh, const glm::dmat4& to_world,
                                 const std::string& user) {
    const std::optional<glm::dmat4> placed = with_thickness(to_world);
    if (!placed) return file_.notes.add("Objects scaled to nothing are skipped", user);
    // With the box and the record that upload and tree need for each.
    file_.context.spend(1, 4 * sizeof(Instance) + sizeof(Placement), file_.where(user));
    placements_.meshes.push_back({mesh, node_, *placed, top_});
}

} // namespace

void add_nodes(File& file, Scene& scene) {
    const Document& document = file.document;
    NodeTraversal nodes(file, scene);
    nodes.traverse(root_nodes(file));
    if (document.scenes.size() > 1 && file.context.options().scene.empty())
        file.notes.add("Only the default scene is loaded; --scene chooses another",
                       names_of(document.scenes));
}

} // namespace onde::gltf
