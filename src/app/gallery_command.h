// `onde gallery`: the chapter's scenes as a page that a teacher can show.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Sets `interrupted` when Ctrl-C ended it. Throws InputError when a picture does not show the
/// numbers that its scene states; the page is written all the same.
void add_gallery_command(Command& root, bool& interrupted);

} // namespace onde::app
