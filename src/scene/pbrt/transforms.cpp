// Directives that move what comes after them.
#include "scene/pbrt/reader.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde::pbrt {

template <class Change>
void Reader::change(const Change& change) {
    if (state_.moves_start) state_.start = change(state_.start);
    if (state_.moves_end) state_.end = change(state_.end);
    state_.transform = state_.start;
    if (state_.start == state_.end) return;
    moves_ = true;
    const double length = end_time_ - start_time_;
    const double share = length > 0.0 ? (moment_ - start_time_) / length : 0.0;
    state_.transform = between(state_.start, state_.end, std::clamp(share, 0.0, 1.0));
}

void Reader::apply(const glm::dmat4& by) {
    change([&](const glm::dmat4& m) { return m * by; });
}

void Reader::identity() {
    change([](const glm::dmat4&) { return glm::dmat4(1.0); });
}

void Reader::translate() {
    apply(glm::translate(glm::dmat4(1.0), vector()));
}

void Reader::scale() {
    apply(glm::scale(glm::dmat4(1.0), vector()));
}

void Reader::rotate() {
    const double degrees = number();
    const glm::dvec3 axis = vector();
    if (!(glm::length(axis) > 0.0))
        return notes_.wrong("Rotations about no axis are left out", tokens_->where());
    apply(glm::rotate(glm::dmat4(1.0), glm::radians(degrees), axis));
}

/// pbrt's camera space has +X to the right, +Y up and looks along +Z.
void Reader::look_at() {
    const glm::dvec3 eye = vector(), target = vector(), up = vector();
    const glm::dvec3 ahead = target - eye, right = glm::cross(up, ahead);
    if (!(glm::length(ahead) > 0.0) || !(glm::length(right) > 0.0))
        fail("looks at its own place, or along its up vector; move one of them");
    const glm::dvec3 z = glm::normalize(ahead), x = glm::normalize(right);
    const glm::dmat4 camera_to_world(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0),
                                     glm::dvec4(z, 0.0), glm::dvec4(eye, 1.0));
    apply(glm::inverse(camera_to_world));
}

void Reader::transform() {
    const glm::dmat4 m = matrix();
    change([&](const glm::dmat4&) { return m; });
}

void Reader::concat_transform() {
    apply(matrix());
}

void Reader::coordinate_system() {
    coordinate_systems_[text("a name")] = {state_.start, state_.end};
}

void Reader::coordinate_system_transform() {
    const std::string name = text("a name");
    const auto found = coordinate_systems_.find(name);
    if (found == coordinate_systems_.end())
        return notes_.wrong("Coordinate systems that are not defined change nothing", name);
    const Ends ends = found->second;
    change([&](const glm::dmat4& m) { return &m == &state_.start ? ends.start : ends.end; });
}

void Reader::active_transform() {
    const Token which = require(Token::Kind::word, "StartTime, EndTime or All");
    state_.moves_start = which.text != "EndTime";
    state_.moves_end = which.text != "StartTime";
}

void Reader::transform_times() {
    start_time_ = number();
    end_time_ = number();
}

} // namespace onde::pbrt
