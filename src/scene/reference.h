// The tables of docs/scene-format.md, from the tables of fields and words that the loaders read.
#pragma once

#include <string>
#include <vector>

namespace onde {

/// One table, as Markdown that ends with a line feed. In the page it stands between the lines
/// "<!-- table NAME -->" and "<!-- end -->".
struct ReferenceTable {
    std::string name, markdown;
};

/// Every table that the page shows.
std::vector<ReferenceTable> reference_tables();

} // namespace onde
