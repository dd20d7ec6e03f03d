// Files that a scene file refers to: they must lie in its folder or below.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace onde {

/// The path of `reference`, a relative path as written in a scene file, resolved in `folder`.
/// Throws InputError, beginning with `where`, when it is empty or absolute, or leaves the folder by
/// ".." or by a symbolic link. The file need not exist. A `root` that the folder lies in takes the
/// folder's place as what may not be left.
std::filesystem::path resolve_inside(const std::filesystem::path& folder,
                                     const std::string& reference, const std::string& where,
                                     const std::filesystem::path& root = {});

/// A URI's text with %XX decoded (RFC 3986, section 2.1); malformed escapes stay as they are.
std::string decode_uri(const std::string& uri);

/// How a texture is to be sampled.
struct TextureUse {
    bool srgb = true;
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    TextureFilter filter = TextureFilter::linear;
    uint32_t uv_set = 0;
    UvTransform transform{};

    bool operator==(const TextureUse&) const = default;
};

TextureUse use_of(const Texture& texture);

/// Adds a texture to a list: of another's picture where `same_image_as` names one, else of `image`.
/// Returns its index.
int32_t add_texture(std::vector<Texture>& textures, std::string name, TexelImage image,
                    const TextureUse& use, int32_t same_image_as = NO_TEXTURE);

/// The file of a texture, which is not read. Throws InputError when it is missing or outside of the
/// folder.
std::filesystem::path check_texture_file(LoadContext& context, const std::filesystem::path& folder,
                                         const std::string& reference, const std::string& where);

/// The index of the texture read from that file, shared with earlier equal uses in `scene`. A file
/// is read once, however it is used.
/// Throws InputError when the file is missing, damaged or outside of the folder.
int32_t add_texture_file(Scene& scene, LoadContext& context, const std::filesystem::path& folder,
                         const std::string& reference, const TextureUse& use,
                         const std::string& where);

} // namespace onde
