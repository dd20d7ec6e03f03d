#include "scene/gltf/pose.h"

#include "core/error.h"
#include "scene/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace onde::gltf {

namespace {

/// The influence of up to four joints on each vertex.
struct Influence {
    std::vector<glm::uvec4> joints;
    std::vector<glm::vec4> weights;
};

std::vector<glm::vec4> read_weights(const File& file, uint32_t accessor, const std::string& user) {
    const std::vector<float> floats = read_floats(file, accessor, 4, user);
    std::vector<glm::vec4> weights(floats.size() / 4);
    for (size_t i = 0; i < floats.size(); ++i) weights[i / 4][i % 4] = floats[i];
    return weights;
}

void check_size(const File& file, size_t count, size_t vertices, const std::string& user) {
    if (count != vertices)
        throw InputError("{}: {}: it has {} elements for {} positions; export it again", file.name,
                         user, count, vertices);
}

std::vector<Influence> read_influences(const File& file, const Primitive& primitive,
                                       size_t vertices, const std::string& user) {
    std::vector<Influence> sets;
    for (int set = 0;; ++set) {
        const auto joints = primitive.attributes.find(fmt::format("JOINTS_{}", set));
        const auto weights = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
        if (joints == primitive.attributes.end() || weights == primitive.attributes.end())
            return sets;
        const std::string of_joints = user + " " + joints->first;
        const std::string of_weights = user + " " + weights->first;
        sets.push_back({read_uvec4(file, joints->second, of_joints),
                        read_weights(file, weights->second, of_weights)});
        check_size(file, sets.back().joints.size(), vertices, of_joints);
        check_size(file, sets.back().weights.size(), vertices, of_weights);
    }
}

/// The mean of the joints' matrices by their weights; nothing where no joint has any.
std::optional<glm::dmat4> blended(const File& file, const std::vector<Influence>& sets,
                                  const std::vector<glm::dmat4>& joints, size_t vertex,
                                  const std::string& user) {
    glm::dmat4 sum(0.0);
    double total = 0.0;
    for (const Influence& set : sets)
        for (size_t i = 0; i < 4; ++i) {
            const double weight = double(set.weights[vertex][i]);
            if (!(weight > 0.0)) continue;
            const uint32_t joint = set.joints[vertex][i];
            if (joint >= joints.size())
                throw InputError("{}: {}: vertex {} names joint {}, but there are {}; export it "
                                 "again",
                                 file.name, user, vertex, joint, joints.size());
            sum += weight * joints[joint];
            total += weight;
        }
    if (!(total > 0.0)) return std::nullopt;
    return sum * (1.0 / total);
}

/// Counts them from a point near them where they are far out.
void set_positions(MeshPart& part, std::span<const glm::dvec3> positions) {
    Extent extent;
    for (const glm::dvec3& p : positions)
        if (std::isfinite(p.x + p.y + p.z)) extent.grow(p);
    part.origin = origin_of(extent, FAR_SKIN);
    part.positions = counted_from(part.origin, positions);
}

void skin(File& file, const Primitive& primitive, const std::vector<glm::dmat4>& joints,
          const std::string& user, MeshPart& part) {
    const std::vector<Influence> sets =
        read_influences(file, primitive, part.positions.size(), user);
    std::vector<glm::dvec3> posed(part.positions.begin(), part.positions.end());
    for (size_t i = 0; i < posed.size(); ++i) {
        const auto matrix = blended(file, sets, joints, i, user);
        if (!matrix) {
            file.notes.wrong("Vertices of skins without a joint are left as they are", user);
            continue;
        }
        posed[i] = glm::dvec3(*matrix * glm::dvec4(posed[i], 1.0));
        if (part.normals.empty()) continue;
        // The cofactors: the inverse's transpose but for the determinant, and never infinite.
        const glm::dmat3 m(*matrix);
        const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                   glm::cross(m[0], m[1]));
        const double sign = glm::dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
        const glm::dvec3 normal = sign * (cofactors * glm::dvec3(part.normals[i]));
        const double length = glm::length(normal);
        part.normals[i] = length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
    }
    set_positions(part, posed);
}

void add_deltas(const File& file, const Attributes& target, const char* name, double weight,
                const std::string& user, std::vector<glm::vec3>& values) {
    const auto accessor = target.find(name);
    if (accessor == target.end() || values.empty()) return;
    const std::vector<glm::vec3> deltas = read_vec3(file, accessor->second, user + " " + name);
    check_size(file, deltas.size(), values.size(), user + " " + name);
    for (size_t i = 0; i < values.size(); ++i) values[i] += float(weight) * deltas[i];
}

} // namespace

void pose_part(File& file, const Primitive& primitive, const Pose& pose, const std::string& user,
               MeshPart& part) {
    for (size_t t = 0; t < std::min(primitive.targets.size(), pose.weights.size()); ++t) {
        if (pose.weights[t] == 0.0) continue;
        const std::string name = fmt::format("{} target {}", user, t);
        add_deltas(file, primitive.targets[t], "POSITION", pose.weights[t], name, part.positions);
        add_deltas(file, primitive.targets[t], "NORMAL", pose.weights[t], name, part.normals);
    }
    if (!pose.joints.empty()) skin(file, primitive, pose.joints, user, part);
}

NodeWorlds::NodeWorlds(const File& file)
    : file_(file), worlds_(file.document.nodes.size()), known_(file.document.nodes.size(), false) {
    const std::vector<Node>& nodes = file.document.nodes;
    file.context.spend(nodes.size(), sizeof(glm::dmat4), file.where("its nodes"));
    std::vector<bool> is_child(nodes.size(), false);
    for (const Node& node : nodes)
        for (uint32_t child : node.children)
            if (child < nodes.size()) is_child[child] = true;
    std::vector<std::pair<uint32_t, glm::dmat4>> stack;
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (!is_child[i]) stack.emplace_back(i, glm::dmat4(1.0));
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const std::string user = fmt::format("node {}", index);
        at(file, nodes, index, "node", user);
        if (known_[index])
            throw InputError("{}: {}: it is reached twice, by a cycle or by two parents; export it "
                             "again",
                             file.name, user);
        known_[index] = true;
        worlds_[index] = parent * local_transform(file, nodes[index], user);
        for (uint32_t child : nodes[index].children) stack.emplace_back(child, worlds_[index]);
    }
}

const glm::dmat4& NodeWorlds::of(uint32_t node, const std::string& user) const {
    at(file_, file_.document.nodes, node, "node", user);
    if (!known_[node])
        throw InputError("{}: {}: node {} is part of a cycle; export it again", file_.name, user,
                         node);
    return worlds_[node];
}

std::vector<glm::dmat4> joint_matrices(const File& file, uint32_t index, const NodeWorlds& worlds) {
    const std::string user = fmt::format("skin {}", index);
    const Skin& source = file.document.skins[index];
    std::vector<float> inverse;
    if (source.inverse_bind_matrices)
        inverse = read_floats(file, *source.inverse_bind_matrices, 16, user);
    if (source.inverse_bind_matrices && inverse.size() / 16 < source.joints.size())
        throw InputError("{}: {}: it has {} inverse bind matrices for {} joints; export it again",
                         file.name, user, inverse.size() / 16, source.joints.size());
    file.context.spend(source.joints.size(), sizeof(glm::dmat4), file.where(user));
    std::vector<glm::dmat4> matrices;
    for (size_t i = 0; i < source.joints.size(); ++i) {
        glm::dmat4 bind(1.0);
        for (size_t k = 0; k < 16 && !inverse.empty(); ++k)
            if (k % 4 < 3) bind[k / 4][k % 4] = double(inverse[16 * i + k]);
        matrices.push_back(worlds.of(source.joints[i], user) * bind);
    }
    return matrices;
}

} // namespace onde::gltf
