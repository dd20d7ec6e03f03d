// How things move in Onde's scene format: values at moments, straight between them.
#pragma once

#include "scene/toml/reader.h"

#include <optional>
#include <vector>

namespace onde {

/// The tables of a key `motion`, at one moment: each has a `time`, in ascending order, and some of
/// the keys that place a thing. A value that moves is given at as many moments as it takes; before
/// the first it is that one, and after the last that.
class Motion {
  public:
    /// Throws InputError for times that do not ascend and for other keys than these.
    Motion(std::vector<TableReader> tables, std::initializer_list<std::string_view> keys,
           double moment);

    /// The value of a key, or `still` where no table gives it.
    glm::dvec3 point(std::string_view key, const glm::dvec3& still) const;
    glm::dvec3 vector(std::string_view key, const glm::dvec3& still) const;

  private:
    template <class Read>
    glm::dvec3 at_moment(const glm::dvec3& still, const Read& read) const;

    std::vector<TableReader> tables_;
    std::vector<double> times_;
    double moment_;
};

} // namespace onde
