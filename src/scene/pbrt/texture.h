// Textures of pbrt files, and parameters that may be one.
#pragma once

#include "scene/pbrt/spectrum.h"
#include "scene/references.h"

#include <map>
#include <set>

namespace onde::pbrt {

/// A linear colour times a picture, where there is one.
struct Textured {
    glm::vec3 factor{1.0f};
    int32_t texture = NO_TEXTURE;
};

class Textures {
  public:
    /// Pictures are added to the scene's textures when they are first asked for. All must outlive
    /// it.
    Textures(Scene& scene, const Sources& sources) : scene_(scene), sources_(sources) {}

    /// Defines one, in place of an earlier one of that name.
    void define(const std::string& name, const std::string& kind, Parameters parameters);

    /// What the parameter says, a texture or a value; nothing where it is absent or can't be had.
    std::optional<Textured> color(const Parameters& parameters, std::string_view name);

    /// The same of a number; of a texture the mean, with a note.
    std::optional<double> number(const Parameters& parameters, std::string_view name);

    /// The texture of that name.
    std::optional<Textured> named(const std::string& name);

    /// The picture in a file, or NO_TEXTURE with a note.
    int32_t picture(const std::string& file, const TextureUse& use);

  private:
    struct Definition {
        std::string kind;
        Parameters parameters;
    };

    Textured convert(const Definition& definition);
    Textured image_map(const Parameters& parameters);
    Textured checkerboard(const Parameters& parameters);
    Textured scaled(const Parameters& parameters);
    Textured mixed(const Parameters& parameters);
    glm::vec3 plain_color(const Parameters& parameters, std::string_view name, float absent);

    Scene& scene_;
    const Sources& sources_;
    std::map<std::string, Definition, std::less<>> definitions_;
    std::map<std::string, Textured, std::less<>> converted_;
    std::set<std::string, std::less<>> in_work_; ///< textures that contain the one being converted
};

} // namespace onde::pbrt
