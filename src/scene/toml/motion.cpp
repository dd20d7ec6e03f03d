#include "scene/toml/motion.h"

#include <algorithm>

namespace onde {

Motion::Motion(std::vector<TableReader> tables, std::initializer_list<std::string_view> keys,
               double moment)
    : tables_(std::move(tables)), moment_(moment) {
    std::vector<std::string_view> allowed{"time"};
    allowed.insert(allowed.end(), keys);
    for (const TableReader& table : tables_) {
        table.allow(allowed);
        const double time = double(table.require("time", table.number("time")));
        if (!times_.empty() && !(time > times_.back()))
            table.fail("time", "must be later than that of the table before");
        times_.push_back(time);
    }
}

template <class Read>
glm::dvec3 Motion::at_moment(const glm::dvec3& still, const Read& read) const {
    std::optional<double> before;
    glm::dvec3 value = still;
    for (size_t i = 0; i < tables_.size(); ++i) {
        const std::optional<glm::dvec3> next = read(tables_[i]);
        if (!next) continue;
        if (before && times_[i] > moment_) {
            const double share = std::max(0.0, (moment_ - *before) / (times_[i] - *before));
            return value + share * (*next - value);
        }
        if (times_[i] > moment_) return *next;
        value = *next;
        before = times_[i];
    }
    return value;
}

glm::dvec3 Motion::point(std::string_view key, const glm::dvec3& still) const {
    return at_moment(still, [&](const TableReader& table) { return table.point(key); });
}

glm::dvec3 Motion::vector(std::string_view key, const glm::dvec3& still) const {
    return at_moment(still, [&](const TableReader& table) { return table.exact_vector(key); });
}

} // namespace onde
