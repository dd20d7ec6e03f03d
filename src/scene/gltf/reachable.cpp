#include "scene/gltf/reachable.h"

#include "scene/gltf/choice.h"

namespace onde::gltf {

std::vector<uint32_t> root_nodes(const File& file) {
    const Document& document = file.document;
    const std::string& word = file.context.options().scene;
    if (!document.scenes.empty() || !word.empty()) {
        const size_t index = word.empty() ? document.scene.value_or(0)
                                          : choose(file, document.scenes, word, "--scene", "scene");
        return at(file, document.scenes, uint32_t(index), "scene", "the default scene").nodes;
    }
    std::vector<bool> is_child(document.nodes.size(), false);
    for (const Node& node : document.nodes)
        for (uint32_t child : node.children)
            if (child < is_child.size()) is_child[child] = true;
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < is_child.size(); ++i)
        if (!is_child[i]) roots.push_back(i);
    return roots;
}

Index chosen_variant(const File& file) {
    const std::string& word = file.context.options().variant;
    if (word.empty()) return std::nullopt;
    return uint32_t(choose(file, file.document.variants, word, "--variant", "material variant"));
}

Index material_of(const Primitive& primitive, Index variant) {
    for (const VariantMaterial& mapping : primitive.variants)
        if (variant && mapping.variant == *variant) return mapping.material;
    return primitive.material;
}

std::vector<bool> shown_materials(const File& file) {
    const Document& document = file.document;
    const Index variant = chosen_variant(file);
    std::vector<bool> used(document.materials.size(), false);
    std::vector<bool> visited(document.nodes.size(), false), seen(document.meshes.size(), false);
    std::vector<uint32_t> stack = root_nodes(file);
    while (!stack.empty()) { // what is wrong with indices is told where they are used
        const uint32_t index = stack.back();
        stack.pop_back();
        if (index >= visited.size() || visited[index] || !document.nodes[index].visible) continue;
        visited[index] = true;
        const Node& node = document.nodes[index];
        stack.insert(stack.end(), node.children.begin(), node.children.end());
        if (!node.mesh || *node.mesh >= seen.size() || seen[*node.mesh]) continue;
        seen[*node.mesh] = true;
        for (const Primitive& primitive : document.meshes[*node.mesh].primitives) {
            const Index material = material_of(primitive, variant);
            if (material && *material < used.size()) used[*material] = true;
        }
    }
    return used;
}

} // namespace onde::gltf
