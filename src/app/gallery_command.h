// `onde gallery`: the chapter's scenes as a page that a teacher can show.
#pragma once

namespace CLI {
class App;
}

namespace onde::app {

/// Sets `interrupted` when Ctrl-C ended it. Throws InputError when a picture does not show the
/// numbers that its scene states; the page is written all the same.
void add_gallery_command(CLI::App& app, bool& interrupted);

} // namespace onde::app
