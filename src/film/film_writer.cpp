#include "core/error.h"
#include "film/film_file.h"
#include "film/film_parts.h"

#include <algorithm>

namespace onde {
namespace {

/// A checksum that is not known yet.
const std::string NO_CHECKSUM(16, '0');

/// At least one, as there is no part without channels.
size_t slots_of(const std::filesystem::path& path, const FilmHeader& header, size_t most_ids) {
    if (most_ids > MOST_ID_SLOTS)
        throw InputError("{}: a pixel shows {} things, and a film file holds {}; render without "
                         "ids, or in parts of fewer samples",
                         path.string(), most_ids, MOST_ID_SLOTS);
    return header.identity.has_ids() ? std::max<size_t>(most_ids, 1) : 0;
}

std::vector<ExrPart> make_parts(const FilmHeader& header, const std::vector<FilmRange>& ranges,
                                size_t id_slots) {
    const std::vector<ExrChannel> channels = channels_of(header.identity).channels();
    std::vector<ExrPart> parts;
    for (const FilmRange& range : ranges) {
        ExrPart part{.name = words_of(range),
                     .window = range.window,
                     .channels = channels,
                     .texts = {},
                     .numbers = {}};
        if (parts.empty()) {
            part.texts = texts_of(header);
            part.numbers[FILM_FORMAT] = FILM_VERSION;
        }
        part.texts[FILM_CHECKSUM] = NO_CHECKSUM;
        part.numbers[FILM_FIRST] = int32_t(range.first);
        part.numbers[FILM_COUNT] = int32_t(range.count);
        if (range.pass > 0) {
            part.numbers[FILM_PASS] = int32_t(range.pass);
            part.numbers[FILM_PASS_PIXELS] = int32_t(range.pass_pixels);
        }
        parts.push_back(std::move(part));
    }
    if (id_slots > 0)
        parts.push_back({.name = IDS_PART,
                         .window = ids_window(ranges),
                         .channels = id_channels(id_slots),
                         .texts = {{FILM_CHECKSUM, NO_CHECKSUM}},
                         .numbers = {}});
    return parts;
}

std::vector<Hasher> begin_hashes(const std::vector<ExrPart>& parts) {
    std::vector<Hasher> hashes;
    for (const ExrPart& part : parts) hashes.push_back(hash_of_header(part));
    return hashes;
}

} // namespace

FilmWriter::FilmWriter(const std::filesystem::path& path, const FilmHeader& header,
                       std::vector<FilmRange> parts, size_t most_ids)
    : channels_(channels_of(header.identity)), id_slots_(slots_of(path, header, most_ids)),
      ranges_(std::move(parts)), parts_(make_parts(header, ranges_, id_slots_)),
      hashes_(begin_hashes(parts_)), out_(path),
      file_(out_, header.identity.width, header.identity.height, parts_) {}

void FilmWriter::write_words(size_t part, uint32_t y) {
    hashes_[part].bytes(words_.data(), words_.size() * sizeof(words_[0]));
    file_.write_row(part, y, words_);
}

void FilmWriter::write_row(size_t part, uint32_t y, std::span<const cl_float4> sums) {
    const size_t width = ranges_[part].window.width;
    words_.resize(channels_.count() * width);
    channels_.pack(sums, width, words_);
    write_words(part, y);
}

void FilmWriter::write_ids(uint32_t y, std::span<const PixelIds> ids) {
    words_.resize(id_words(id_slots_, ids.size()));
    pack_ids(ids, id_slots_, words_);
    write_words(ranges_.size(), y);
}

void FilmWriter::finish() {
    for (size_t part = 0; part < hashes_.size(); part++)
        file_.set_text(part, FILM_CHECKSUM, hashes_[part].hex());
    file_.finish();
    out_.finish();
}

} // namespace onde
