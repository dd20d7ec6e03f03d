#include "scene/ies.h"

#include "core/error.h"
#include "core/shown.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

/// Numbers one after the other, whatever the lines they stand in.
class Numbers {
  public:
    Numbers(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

    double next(const char* what) {
        const size_t begin = rest_.find_first_not_of(BETWEEN);
        if (begin == std::string_view::npos)
            throw InputError("{}: it ends before its {}", name_, what);
        rest_.remove_prefix(begin);
        const std::string_view word = rest_.substr(0, rest_.find_first_of(BETWEEN));
        rest_.remove_prefix(word.size());
        const auto value = text::number(word);
        if (!value || !std::isfinite(*value))
            throw InputError("{}: '{}' stands where its {} should", name_, printable(word, 40),
                             what);
        return *value;
    }

    /// A whole number from 1 to `most`.
    uint32_t count(const char* what, uint32_t most) {
        const double value = next(what);
        if (!(value >= 1 && value <= most && value == std::floor(value)))
            throw InputError("{}: its {} is {}; it must be a whole number from 1 to {}", name_,
                             what, value, most);
        return uint32_t(value);
    }

    /// Angles that rise, in degrees from 0 to `last`.
    std::vector<double> angles(const char* what, uint32_t count, double last) {
        std::vector<double> all;
        for (uint32_t i = 0; i < count; i++) {
            all.push_back(next(what));
            const bool rises = i == 0 || all[i] > all[i - 1];
            if (!rises || all[i] < 0 || all[i] > last)
                throw InputError("{}: its {} must rise from 0 to at most {}", name_, what, last);
        }
        return all;
    }

    size_t left() const { return rest_.size(); }

  private:
    static constexpr std::string_view BETWEEN = " \t\r\n,";

    std::string_view rest_;
    const std::string& name_;
};

/// What a file states: candela by horizontal angle, then by vertical one.
struct Measured {
    std::vector<double> vertical, horizontal;
    std::vector<float> candela;

    /// At a place of the lists: between four numbers.
    double at(double v, double h) const {
        const auto [row, down] = place(vertical, v);
        const auto [column, across] = place(horizontal, h);
        const auto value = [&](size_t i, size_t j) {
            return double(candela[std::min(j, horizontal.size() - 1) * vertical.size() +
                                  std::min(i, vertical.size() - 1)]);
        };
        const double left = value(row, column) * (1 - down) + value(row + 1, column) * down;
        const double right =
            value(row, column + 1) * (1 - down) + value(row + 1, column + 1) * down;
        return left * (1 - across) + right * across;
    }

  private:
    /// The last angle that is not above, and the part of the way to the next.
    static std::pair<size_t, double> place(const std::vector<double>& angles, double angle) {
        const auto above = std::ranges::upper_bound(angles, angle);
        if (above == angles.begin()) return {0, 0.0};
        const auto i = size_t(above - angles.begin()) - 1;
        if (above == angles.end()) return {i, 0.0};
        return {i, (angle - angles[i]) / (angles[i + 1] - angles[i])};
    }
};

/// What is behind the line of TILT, by which files of all years can be told.
std::string_view behind_tilt(std::string_view text, const std::string& name, Notes& notes) {
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
        const std::string_view words = text::trim(text.substr(begin, end - begin));
        begin = std::min(end + 1, text.size());
        if (!words.starts_with("TILT=")) continue;
        const std::string_view behind = text.substr(begin);
        if (words == "TILT=NONE") return behind;
        notes.add("What tilting takes from lamps is ignored", name);
        if (words != "TILT=INCLUDE") return behind;
        Numbers tilt(behind, name);
        tilt.next("geometry of tilting");
        const uint32_t pairs = tilt.count("number of tilts", 10000);
        for (uint32_t i = 0; i < 2 * pairs; i++) tilt.next("factors of tilting");
        return behind.substr(behind.size() - tilt.left());
    }
    throw InputError("{}: it has no line TILT=, so it is no IES LM-63 file", name);
}

Measured read_measured(std::string_view text, const std::string& name, LoadContext& context,
                       Notes& notes) {
    constexpr uint32_t MOST_ANGLES = 10000;
    Numbers numbers(behind_tilt(text, name, notes), name);
    numbers.next("number of lamps");
    numbers.next("lumens of a lamp");
    double multiplier = numbers.next("multiplier");
    const uint32_t rows = numbers.count("number of vertical angles", MOST_ANGLES);
    const uint32_t columns = numbers.count("number of horizontal angles", MOST_ANGLES);
    if (numbers.next("type of photometry") != 1)
        throw InputError("{}: its photometry is of type A or B; convert it to type C", name);
    for (const char* size : {"units", "width", "length", "height"}) numbers.next(size);
    multiplier *= numbers.next("ballast factor");
    multiplier *= numbers.next("factor of ballast and lamp");
    numbers.next("watts");
    if (!(multiplier >= 0)) throw InputError("{}: its multipliers make its light negative", name);
    Measured m;
    m.vertical = numbers.angles("vertical angles", rows, 180.0);
    m.horizontal = numbers.angles("horizontal angles", columns, 360.0);
    context.spend(uint64_t(rows) * columns, sizeof(float), name);
    bool is_negative = false;
    for (uint64_t i = 0; i < uint64_t(rows) * columns; i++) {
        const double candela = multiplier * numbers.next("candela");
        is_negative |= candela < 0;
        m.candela.push_back(float(std::clamp(candela, 0.0, 1e30)));
    }
    if (is_negative) notes.wrong("Negative candela are taken as 0", name);
    return m;
}

/// Where the file states what is at a horizontal angle in [0, 360): it may leave out what mirrors.
double stated_angle(const std::vector<double>& horizontal, double angle) {
    const double first = horizontal.front(), last = horizontal.back();
    if (first >= 90 && last <= 270) // alike on both sides of the plane of 90 and 270
        return angle < 90 ? 180 - angle : angle > 270 ? 540 - angle : angle;
    if (last <= 90) { // and of that of 0 and 180
        const double half = angle > 180 ? 360 - angle : angle;
        return half > 90 ? 180 - half : half;
    }
    return last <= 180 && angle > 180 ? 360 - angle : angle;
}

/// How many steps of the smallest of the angles' make `whole` degrees.
uint32_t steps_of(const std::vector<double>& angles, double whole, uint32_t most) {
    double least = whole;
    for (size_t i = 1; i < angles.size(); i++) least = std::min(least, angles[i] - angles[i - 1]);
    return uint32_t(std::clamp(std::ceil(whole / least - 1e-6), 1.0, double(most)));
}

LightProfile grid_of(const Measured& m, const std::string& name, LoadContext& context) {
    LightProfile profile;
    profile.rows = std::max(steps_of(m.vertical, 180.0, MOST_PROFILE_STEPS / 2), 2u);
    profile.columns =
        m.horizontal.size() == 1 ? 1 : steps_of(m.horizontal, 360.0, MOST_PROFILE_STEPS);
    const uint64_t nodes = (uint64_t(profile.rows) + 1) * profile.columns;
    context.spend(nodes, 5 * sizeof(float), name); // with its table
    profile.candela.assign(nodes, 0.0f);
    constexpr double ROUNDING = 1e-9;
    for (uint32_t row = 0; row <= profile.rows; row++) {
        const double v = 180.0 * row / profile.rows;
        if (v < m.vertical.front() - ROUNDING || v > m.vertical.back() + ROUNDING) continue;
        for (uint32_t column = 0; column < profile.columns; column++) {
            const double h = stated_angle(m.horizontal, 360.0 * column / profile.columns);
            profile.candela[size_t(row) * profile.columns + column] = float(m.at(v, h));
        }
    }
    return profile;
}

} // namespace

LightProfile read_ies(std::string_view text, const std::string& name, LoadContext& context,
                      Notes& notes) {
    return grid_of(read_measured(text, name, context, notes), name, context);
}

LightProfile load_ies_within(LoadContext& context, const std::filesystem::path& path,
                             Notes& notes) {
    constexpr uint64_t LONGEST = uint64_t(64) << 20;
    const std::string name = path.string();
    const auto text = text::decode(read_file_within(context, path, LONGEST));
    if (!text) throw InputError("{}: it is no text, so it is no IES LM-63 file", name);
    return read_ies(*text, name, context, notes);
}

} // namespace onde
