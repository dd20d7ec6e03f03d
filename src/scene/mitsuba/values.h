// Numbers, vectors, colours and transforms as Mitsuba's files write them.
#pragma once

#include "scene/mitsuba/document.h"
#include "scene/spectrum/curve.h"

#include <glm/glm.hpp>

namespace onde::mitsuba {

/// The numbers of a text, between blanks and commas; NaN for a word that is none.
std::vector<double> numbers_of(std::string_view text);

/// Reads what an element has by name. What is of another type, no number, or not finite, counts as
/// absent, with a note.
class Values {
  public:
    Values(const Document& document, const Element& of) : document_(document), of_(of) {}

    std::optional<double> number(std::string_view name) const;
    double number(std::string_view name, double absent) const {
        return number(name).value_or(absent);
    }
    bool flag(std::string_view name, bool absent) const;
    std::string text(std::string_view name, const std::string& absent = "") const;
    glm::dvec3 vector(std::string_view name, const glm::dvec3& absent) const;
    /// The transform of that name, or the identity.
    glm::dmat4 transform(std::string_view name) const;

    /// A colour or spectrum, as Mitsuba's RGB variants take it: linear sRGB, a spectrum under light
    /// of equal energy. Textures count as absent.
    std::optional<glm::dvec3> color(std::string_view name) const;

    /// An index of refraction: a number or the name of a substance.
    double index(std::string_view name, const char* absent) const;

  private:
    std::optional<glm::dvec3> spectrum(const Element& element) const;
    void note_wrong(const Element& element) const;

    const Document& document_;
    const Element& of_;
};

} // namespace onde::mitsuba
