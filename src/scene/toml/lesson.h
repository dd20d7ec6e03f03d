// The [lesson] table of a TOML scene.
#pragma once

#include "scene/lesson.h"
#include "scene/toml/reader.h"

namespace onde {

/// Throws InputError for what is wrong with it. That its pixels lie in the picture is left to
/// check_lesson(), as the size may come from an included file.
Lesson read_lesson(const TableReader& table);

} // namespace onde
