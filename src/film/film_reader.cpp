#include "core/error.h"
#include "film/film_file.h"
#include "film/film_parts.h"

namespace onde {
namespace {

[[noreturn]] void throw_damaged(const std::filesystem::path& path, const std::string& why) {
    throw InputError("{}: is a damaged film ({}); render it anew", path.string(), why);
}

void check_is_film(const std::filesystem::path& path, const ExrRowReader& file) {
    const auto& numbers = file.parts().front().numbers;
    const auto format = numbers.find(FILM_FORMAT);
    if (format == numbers.end())
        throw InputError("{}: is no film file of Onde; those are written by onde render --film",
                         path.string());
    if (format->second != FILM_VERSION)
        throw InputError("{}: is a film file of format {}, and this program reads format {}; use "
                         "the program that wrote it",
                         path.string(), format->second, FILM_VERSION);
}

FilmHeader read_header(const std::filesystem::path& path, const ExrRowReader& file) {
    check_is_film(path, file);
    try {
        return header_of(file.parts().front().texts);
    } catch (const std::runtime_error& problem) {
        throw_damaged(path, problem.what());
    }
}

/// A number that lies within these.
uint32_t number_of(const std::filesystem::path& path, const ExrPart& part, const char* key,
                   uint32_t most, uint32_t absent) {
    const auto found = part.numbers.find(key);
    if (found == part.numbers.end()) return absent;
    if (found->second < 0 || uint32_t(found->second) > most)
        throw_damaged(path, fmt::format("{} is {}", key, found->second));
    return uint32_t(found->second);
}

FilmRange read_range(const std::filesystem::path& path, const ExrPart& part) {
    constexpr uint32_t MOST_SAMPLES = 1u << 24;
    FilmRange range{.window = part.window};
    range.first = number_of(path, part, FILM_FIRST, MOST_SAMPLES, 0);
    range.count = number_of(path, part, FILM_COUNT, MOST_SAMPLES, 0);
    range.pass = number_of(path, part, FILM_PASS, FILM_BLOCK, 0);
    range.pass_pixels = number_of(path, part, FILM_PASS_PIXELS, UINT32_MAX >> 1, 0);
    const bool is_beginning =
        range.first % FILM_BLOCK == 0 && range.count < FILM_BLOCK &&
        range.count + range.pass <= FILM_BLOCK && range.count + range.pass > 0 &&
        (range.pass > 0) == (range.pass_pixels > 0) && range.pass_pixels <= range.window.pixels();
    if (!range.node() && !is_beginning) throw_damaged(path, "a part has no node's samples");
    return range;
}

} // namespace

FilmReader::FilmReader(const std::filesystem::path& path)
    : path_(path), file_(path), header_(read_header(path, file_)),
      channels_(channels_of(header_.identity)) {
    if (file_.width() != header_.identity.width || file_.height() != header_.identity.height)
        throw_damaged(path, "its picture has two sizes");
    const bool has_ids = header_.identity.has_ids();
    for (size_t i = 0; i + has_ids < file_.parts().size(); i++) {
        const ExrPart& part = file_.parts()[i];
        if (part.channels != channels_.channels())
            throw_damaged(path, "its channels are not those of its AOVs");
        ranges_.push_back(read_range(path, part));
    }
    if (has_ids && (ranges_.empty() || ids_part().name != IDS_PART ||
                    ids_part().window != onde::ids_window(ranges_) ||
                    ids_part().channels != id_channels(ids_part().channels.size() / 3)))
        throw_damaged(path, "its ids are not those of its parts");
}

void FilmReader::check_sum(size_t index, size_t words_of_row) {
    const ExrPart& part = file_.parts().at(index);
    const auto told = part.texts.find(FILM_CHECKSUM);
    Hasher hasher = hash_of_header(part);
    words_.resize(words_of_row);
    for (uint32_t y = part.window.y; y < part.window.end_y(); y++) {
        file_.read_row(index, y, words_);
        hasher.bytes(words_.data(), words_.size() * sizeof(words_[0]));
    }
    if (told == part.texts.end() || told->second != hasher.hex())
        throw_damaged(path_, "its checksum is another");
}

void FilmReader::check_part(size_t part) {
    check_sum(part, channels_.count() * ranges_.at(part).window.width);
}

std::optional<Rectangle> FilmReader::ids_window() const {
    if (!header_.identity.has_ids()) return std::nullopt;
    return ids_part().window;
}

void FilmReader::check_ids() {
    if (ids_window()) check_sum(ranges_.size(), ids_part().channels.size() * ids_window()->width);
}

void FilmReader::read_ids(uint32_t y, std::vector<PixelIds>& ids) {
    const size_t slots = ids_part().channels.size() / 3;
    ids.resize(ids_part().window.width);
    words_.resize(id_words(slots, ids.size()));
    file_.read_row(ranges_.size(), y, words_);
    try {
        unpack_ids(words_, slots, ids);
    } catch (const std::runtime_error& problem) {
        throw_damaged(path_, problem.what());
    }
    for (const PixelIds& pixel : ids)
        for (const IdCount& seen : pixel)
            if (seen.id != NOTHING_SEEN && (seen.id.object >= header_.names.objects.size() ||
                                            seen.id.material >= header_.names.materials.size()))
                throw_damaged(path_, "its ids have no names");
}

void FilmReader::read_row(size_t part, uint32_t y, FilmRow& sums) {
    const size_t width = ranges_.at(part).window.width;
    words_.resize(channels_.count() * width);
    file_.read_row(part, y, words_);
    sums.assign(channels_.planes() * width, cl_float4{});
    channels_.unpack(words_, width, sums);
}

} // namespace onde
