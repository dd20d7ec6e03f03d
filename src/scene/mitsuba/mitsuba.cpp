// Mitsuba 3's scene files.
#include "scene/loaders.h"
#include "scene/mitsuba/reader.h"

namespace onde {

Scene load_mitsuba(const std::filesystem::path& path, LoadContext& context) {
    return mitsuba::Reader(path, context).read();
}

namespace mitsuba {

Reader::Reader(const std::filesystem::path& path, LoadContext& context)
    : context_(context), name_(path.string()), notes_(context.notes_of(path)),
      document_(path, context, notes_), scene_(context, name_),
      materials_(document_, scene_.assets()) {}

void Reader::add(const Element& element) {
    if (element.tag == "integrator") return read_integrator(element);
    if (element.tag == "sensor") return read_sensor(element);
    if (element.tag == "emitter") return add_emitter(element);
    if (element.tag == "shape") return add_shape(element, nullptr);
    if (element.tag == "bsdf" || element.tag == "texture" || element.tag == "medium" ||
        element.tag == "phase" || element.tag == "volume")
        return; // for those who refer to it
    notes_.add("Other elements of scenes are left out", element.tag);
}

Scene Reader::read() {
    for (const Element& element : document_.root().children) add(element);
    document_.note_unused();
    // A camera whose transform mirrors sees a mirrored world.
    const bool is_mirrored = camera_to_world_ && glm::determinant(*camera_to_world_) < 0.0;
    glm::dmat4 to_ours(1.0);
    if (is_mirrored) {
        to_ours[0].x = -1.0;
        notes_.add("The camera mirrors the picture: the world's x is turned around");
    }
    for (SkyLight& light : sky_) light.light_to_world = glm::dmat3(to_ours) * light.light_to_world;
    Scene& assets = scene_.assets();
    if (!sky_.empty()) assets.environment = environment_of(std::move(sky_), context_, name_);
    Scene scene = scene_.finish(to_ours);
    const std::vector<std::string> sentences = notes_.sentences();
    scene.notes.insert(scene.notes.begin(), sentences.begin(), sentences.end());
    return scene;
}

std::vector<FileWord> plugin_words() {
    std::vector<FileWord> words{
        {"path",
         "the integrator, of as many surfaces as its `max_depth`; others are path, with a note"},
        {"direct", "the integrator, of two surfaces"},
        {"perspective", "a camera; other sensors are perspective, with a note"},
        {"thinlens", "a camera with an aperture"},
        {"orthographic", "a camera"},
        {"hdrfilm", "the picture's size"},
        {"independent", "samples per pixel, as every sampler"},
        {"box", "the filter of that name"},
        {"tent", "the filter of that name"},
        {"gaussian", "the filter of that name; others are Blackman-Harris, with a note"},
        {"area", "emission of the shape's front"},
        {"point", "a light"},
        {"directional", "a light"},
        {"spot", "a light that fades toward its rim as glTF's do, with a note"},
        {"constant", "the environment"},
        {"envmap", "the environment"},
        {"homogeneous", "a medium inside of a shape, or around a sensor"},
        {"heterogeneous", "the same with a grid; media without one are left out, with a note"},
        {"gridvolume", "the density of a medium; of colours it is left out, with a note"},
        {"constvolume", "a colour"},
        {"hg", "how a medium scatters; others scatter evenly, with a note"},
        {"obj", "the mesh alone"},
        {"ply", "the mesh alone"},
        {"stl", "the mesh alone"},
        {"sphere", "the shape"},
        {"rectangle", "the shape"},
        {"cube", "the shape"},
        {"disk", "the shape"},
        {"cylinder", "a mesh"},
        {"shapegroup", "what instances place"},
        {"instance", "its group, placed"}};
    const std::vector<FileWord> materials = Materials::words();
    words.insert(words.end(), materials.begin(), materials.end());
    words.push_back({"bitmap", "a texture"});
    words.push_back({"checkerboard", "a texture"});
    return words;
}

} // namespace mitsuba
} // namespace onde
