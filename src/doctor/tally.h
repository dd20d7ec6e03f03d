// Comparisons of a check, counted; the first that fails is kept in words.
#pragma once

#include "doctor/check.h"

#include <fmt/format.h>

#include <cmath>

namespace onde::doctor {

class Tally {
  public:
    /// `describe()` says what is wrong, where it is.
    template <class Describe>
    void expect(bool right, const Describe& describe) {
        ++compared_;
        if (right) return;
        if (failed_++ == 0) first_ = describe();
    }
    /// A comparison that says itself what is wrong: empty when nothing is.
    void expect_none(const std::string& wrong, std::string_view of) {
        expect(wrong.empty(), [&] { return fmt::format("{}: {}", of, wrong); });
    }
    /// NaN is near nothing.
    void expect_near(double got, double wanted, double bound, std::string_view of) {
        expect(std::abs(got - wanted) <= bound, [&] {
            return fmt::format("{} is {:.9g} instead of {:.9g} (give or take {:.2g})", of, got,
                               wanted, bound);
        });
    }

    /// `what` is counted: "places differ".
    Finding finding(std::string_view what) const {
        return {.passed = failed_ == 0 && compared_ > 0,
                .value = double(failed_),
                .unit = fmt::format("of {} {}", compared_, what),
                .text = first_};
    }

  private:
    size_t compared_ = 0, failed_ = 0;
    std::string first_;
};

} // namespace onde::doctor
