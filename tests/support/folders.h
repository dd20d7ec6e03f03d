// Where the project lies, and the program that was built of it. Told by one file alone, so that
// what else is compiled here is the same in every copy of the project, and comes from ccache there.
#pragma once

#include <string>

namespace onde::test {

/// A file or folder of the project, by its path from there.
std::string in_project(const std::string& path);

std::string built_program();

} // namespace onde::test
