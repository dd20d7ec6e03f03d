// The gallery as a page: pictures beside their formulas and what was measured in them.
#pragma once

#include "chapter/lesson_check.h"

#include <string>
#include <vector>

namespace onde::app {

/// A scene that was rendered, and all that the page says of it.
struct GalleryEntry {
    std::string name; ///< the scene's file name without extension
    Lesson lesson;
    std::string picture;               ///< file name, beside the page
    std::string facts;                 ///< size, samples, integrator, seconds
    std::string command;               ///< that renders it alone
    std::vector<std::string> findings; ///< what the scene and the render had to say
    std::vector<LessonCheck> checks;
    std::string replay; ///< the words of `onde inspect`; may be empty
};

/// By which a page is known to be one of ours, so that it may be replaced.
inline constexpr const char* GALLERY_MARK = "<meta name=\"generator\" content=\"Onde gallery\">";

/// One self-contained HTML page, in the order of the chapter's sections.
std::string gallery_page(std::vector<GalleryEntry> entries, const std::string& device);

} // namespace onde::app
