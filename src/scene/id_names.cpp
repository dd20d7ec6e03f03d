#include "scene/id_names.h"

#include "core/text.h"

#include <fmt/format.h>

namespace onde {
namespace {

/// Names from files may hold any bytes.
std::string plain(const std::string& name) {
    return printable(name, LONGEST_NAME);
}

void add_object(const Scene& scene, uint32_t name, const std::string& fallback, IdNames& names) {
    const PlacedName placed = name == NO_NAME ? PlacedName{} : scene.names[name];
    std::string object = placed.object.empty() ? fallback : placed.object;
    if (object.empty()) object = fmt::format("object {}", names.objects.size());
    names.objects.push_back(plain(object));
    names.assets.push_back(placed.asset.empty() ? names.objects.back() : plain(placed.asset));
}

} // namespace

IdNames id_names(const Scene& scene) {
    IdNames names;
    for (const Instance& instance : scene.instances)
        add_object(scene, instance.name, scene.meshes[instance.mesh].name, names);
    for (const Sphere& sphere : scene.spheres) add_object(scene, sphere.name, "", names);
    for (const Shape& shape : scene.shapes) add_object(scene, shape.name, "", names);
    for (const Material& material : scene.materials)
        names.materials.push_back(material.name.empty()
                                      ? fmt::format("material {}", names.materials.size())
                                      : plain(material.name));
    return names;
}

} // namespace onde
