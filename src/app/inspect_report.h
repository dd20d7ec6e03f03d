// A replayed sample in words, and as a graph.
#pragma once

#include "session/session.h"

#include <string>

namespace onde::app {

/// The ray tree, a paragraph a node, children indented below their parent; or the path, a paragraph
/// a bounce.
std::string sample_text(const SampleReport& report, const Scene& scene, const PackedScene& packed);

/// The same for Graphviz.
std::string sample_dot(const SampleReport& report, const Scene& scene, const PackedScene& packed);

} // namespace onde::app
