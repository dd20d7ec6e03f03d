#include "app/reference_command.h"

#include "scene/reference.h"

#include <fmt/format.h>

namespace onde::app {

void add_reference_command(Command& root) {
    root.add_command("reference", "Print the keys of scene files, as Markdown").on_run([] {
        for (const ReferenceTable& table : reference_tables())
            fmt::print("<!-- table {} -->\n{}<!-- end -->\n", table.name, table.markdown);
    });
}

} // namespace onde::app
