#include "scene/references.h"

#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"

#include <algorithm>
#include <charconv>

namespace onde {
namespace fs = std::filesystem;

static bool lies_in(const fs::path& folder, const fs::path& path) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() && rest != path.end();
}

fs::path resolve_inside(const fs::path& folder, const std::string& reference,
                        const std::string& where, const fs::path& root) {
    const fs::path relative(reference);
    if (reference.empty() || reference.find('\0') != std::string::npos)
        throw InputError("{}: the file name is empty or damaged; name a file", where);
    if (relative.is_absolute())
        throw InputError("{}: '{}' is an absolute path; name a file in the scene's folder", where,
                         shown(reference));
    std::error_code error, folder_error;
    const fs::path base = fs::canonical(folder.empty() ? fs::path(".") : folder, folder_error);
    const fs::path path = fs::weakly_canonical(base / relative, error);
    if (error || folder_error)
        throw InputError("{}: '{}' cannot be resolved ({})", where, shown(reference),
                         (error ? error : folder_error).message());
    const fs::path widest = root.empty() ? base : fs::canonical(root, error);
    const bool widened = !error && (base == widest || lies_in(widest, base));
    const fs::path& limit = widened ? widest : base;
    if (path == limit)
        throw InputError("{}: '{}' is the scene's folder; name a file in it", where,
                         shown(reference));
    if (!lies_in(limit, path))
        throw InputError("{}: '{}' leaves the scene's folder; move the file into it, or name a "
                         "folder that holds both by --root",
                         where, shown(reference));
    return path;
}

std::string decode_uri(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            text += char(byte);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

TextureUse use_of(const Texture& t) {
    return {t.srgb, t.wrap_u, t.wrap_v, t.filter, t.uv_set, t.transform};
}

int32_t add_texture(std::vector<Texture>& textures, std::string name, TexelImage image,
                    const TextureUse& use, int32_t same_image_as) {
    textures.push_back({std::move(name), std::move(image), use.srgb, use.wrap_u, use.wrap_v,
                        use.filter, use.uv_set, use.transform, same_image_as});
    return int32_t(textures.size() - 1);
}

fs::path check_texture_file(LoadContext& context, const fs::path& folder,
                            const std::string& reference, const std::string& where) {
    const fs::path path = context.resolve(folder, reference, where);
    if (!fs::exists(path))
        throw InputError("{}: the image '{}' does not exist; check the name", where,
                         shown(reference));
    return path;
}

int32_t add_texture_file(Scene& scene, LoadContext& context, const fs::path& folder,
                         const std::string& reference, const TextureUse& use,
                         const std::string& where) {
    const fs::path path = check_texture_file(context, folder, reference, where);
    std::vector<Texture>& textures = scene.textures;
    const auto same = [&](const Texture& texture) {
        return texture.name == path.string() && use_of(texture) == use;
    };
    const auto found = std::ranges::find_if(textures, same);
    if (found != textures.end()) return int32_t(found - textures.begin());
    const auto known = std::ranges::find(textures, path.string(), &Texture::name);
    if (known != textures.end()) {
        const bool shares = known->same_image_as != NO_TEXTURE;
        const int32_t owner = shares ? known->same_image_as : int32_t(known - textures.begin());
        return add_texture(textures, path.string(), {}, use, owner);
    }
    const std::string bytes = read_file_within(context, path);
    TexelImage image = decode_within(
        context, {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, path.string());
    if (image.cut > 0)
        scene.notes.push_back(fmt::format(
            "{} pixels of the texture {} are negative, infinite or no numbers; they count as 0, or "
            "as 65504 where they are infinite.",
            image.cut, printable(path.filename().string())));
    return add_texture(textures, path.string(), std::move(image), use);
}

} // namespace onde
