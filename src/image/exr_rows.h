// OpenEXR files of many uncompressed parts, row by row: what is too large for memory, or was not
// made by us, is read and written piece by piece. Knows nothing of what the channels mean.
#pragma once

#include "core/output.h"
#include "core/rectangle.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace onde {

struct ExrChannel {
    std::string name;
    bool is_float = true; ///< else whole numbers of 32 bits

    bool operator==(const ExrChannel&) const = default;
};

/// What a header says of a part.
struct ExrPart {
    std::string name; ///< no other part of the file has it
    Rectangle window; ///< of its pixels, in the picture
    std::vector<ExrChannel> channels;
    std::map<std::string, std::string> texts; ///< attributes
    std::map<std::string, int32_t> numbers;   ///< attributes
};

/// A file of parts of 32-bit channels, as ExrRowWriter makes them.
class ExrRowReader {
  public:
    /// Throws InputError for a file that is missing, damaged, or of another kind; before memory is
    /// allocated for what its header claims and its size does not bear out.
    explicit ExrRowReader(const std::filesystem::path& path);
    ~ExrRowReader();

    uint32_t width() const { return width_; } ///< of the picture
    uint32_t height() const { return height_; }
    const std::vector<ExrPart>& parts() const { return parts_; }

    /// Row y of the picture in that part: the pixels of a channel, then those of the next, in the
    /// order of their names. Throws InputError where the file is damaged.
    void read_row(size_t part, uint32_t y, std::span<uint32_t> words);

  private:
    struct File;
    std::unique_ptr<File> file_;
    uint32_t width_ = 0, height_ = 0;
    std::vector<ExrPart> parts_;
};

class ExrRowWriter {
  public:
    /// Begins the file with its header; `file` outlives it. Channels are in the order of their
    /// names.
    ExrRowWriter(WholeFile& file, uint32_t width, uint32_t height, std::vector<ExrPart> parts);
    ~ExrRowWriter();

    /// The rows of the first part from the top, then those of the next part, and so on.
    void write_row(size_t part, uint32_t y, std::span<const uint32_t> words);
    /// Replaces an attribute of the part by another text of that length.
    void set_text(size_t part, const std::string& key, const std::string& text);
    /// Completes the file, all but WholeFile::finish().
    void finish();

  private:
    struct File;
    std::unique_ptr<File> file_;
};

} // namespace onde
