// Kernel files as text, embedded or on disk, and their #includes.
#include "core/files.h"
#include "core/hash.h"
#include "gpu/embedded_kernels.h"
#include "gpu/program.h"

#include <algorithm>
#include <set>

namespace onde::gpu {
namespace fs = std::filesystem;
namespace {

std::optional<std::string> find_embedded(std::string_view name) {
    for (const EmbeddedFile& file : embedded_kernels())
        if (file.name == name)
            return std::string(reinterpret_cast<const char*>(file.data), file.size);
    return std::nullopt;
}

std::optional<std::string> find_in(const fs::path& root, const std::string& name) {
    if (!fs::is_regular_file(root / name)) return std::nullopt;
    return read_file(root / name);
}

std::string_view skip_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

/// The file named by the line, if it is an #include "...".
std::optional<std::string> included_file(std::string_view line) {
    line = skip_blanks(line);
    if (!line.starts_with('#')) return std::nullopt;
    line = skip_blanks(line.substr(1));
    if (!line.starts_with("include")) return std::nullopt;
    line = skip_blanks(line.substr(7));
    const size_t end = line.find('"', 1);
    if (!line.starts_with('"') || end == std::string_view::npos) return std::nullopt;
    return std::string(line.substr(1, end - 1));
}

/// One flattening: what was already taken in, and the text so far.
class Flattener {
  public:
    explicit Flattener(const KernelSources& sources) : sources_(sources) {}

    void add(const std::string& file, const std::string& text) {
        if (!taken_.insert(file).second) return;
        add_line_directive(1, file);
        std::string_view rest = text;
        for (size_t line = 1; !rest.empty(); ++line) {
            const size_t end = std::min(rest.find('\n'), rest.size());
            add_line(rest.substr(0, end), line, file);
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }

    std::string take() { return std::move(text_); }

  private:
    void add_line(std::string_view line, size_t number, const std::string& file) {
        const std::optional<std::string> included = included_file(line);
        if (!included) {
            text_.append(line).append("\n");
            return;
        }
        if (!taken_.contains(*included)) add(*included, read_included(*included, number, file));
        add_line_directive(number + 1, file);
    }

    std::string read_included(const std::string& name, size_t line, const std::string& includer) {
        try {
            return sources_.read(name);
        } catch (const DeviceError& error) {
            throw DeviceError("kernels/{}:{}: {}", includer, line, error.what());
        }
    }

    void add_line_directive(size_t line, const std::string& file) {
        text_ += fmt::format("#line {} \"kernels/{}\"\n", line, file);
    }

    const KernelSources& sources_;
    std::set<std::string> taken_;
    std::string text_;
};

} // namespace

KernelSources KernelSources::from(const std::filesystem::path& root) {
    return root.empty() ? embedded() : folder(root);
}

KernelSources KernelSources::embedded() {
    return {};
}

KernelSources KernelSources::folder(fs::path root) {
    if (!fs::is_directory(root))
        throw InputError("{}: no such folder; give the folder of the kernel files", root.string());
    KernelSources sources;
    sources.root_ = std::move(root);
    return sources;
}

std::string KernelSources::read(const std::string& file) const {
    if (std::optional<std::string> text = root_ ? find_in(*root_, file) : find_embedded(file))
        return *text;
    throw DeviceError("there is no kernel file \"{}\" {}", file,
                      root_ ? "in " + root_->string() : "among the embedded ones");
}

std::string KernelSources::flatten(const std::string& file) const {
    return flatten(std::vector{file});
}

std::string KernelSources::flatten(const std::vector<std::string>& files) const {
    Flattener flattener(*this);
    for (const std::string& file : files) flattener.add(file, read(file));
    return flattener.take();
}

std::string KernelSources::hash() const {
    std::set<std::string> names;
    if (root_) {
        for (const auto& entry : fs::recursive_directory_iterator(*root_))
            if (entry.path().extension() == ".h" || entry.path().extension() == ".cl")
                names.insert(entry.path().lexically_relative(*root_).generic_string());
    } else {
        for (const EmbeddedFile& file : embedded_kernels()) names.insert(file.name);
    }
    Hasher hasher;
    for (const std::string& name : names) hasher.text(name).text(read(name));
    return hasher.hex();
}

} // namespace onde::gpu
