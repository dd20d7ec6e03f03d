// A replayed sample in words, and as a graph.
#pragma once

#include "render/inspect.h"

#include <string>

namespace onde::app {

/// The ray tree, a paragraph a node, children indented below their parent.
std::string tree_text(const TreeReport& report, const Scene& scene, const PackedScene& packed);

/// The same tree for Graphviz.
std::string tree_dot(const TreeReport& report, const Scene& scene);

/// The path, a paragraph a bounce.
std::string path_text(const PathReport& report, const Scene& scene, const PackedScene& packed);

/// The same path for Graphviz.
std::string path_dot(const PathReport& report, const Scene& scene);

} // namespace onde::app
