// What repeated measurements come to, and files of figures for machines.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace onde::bench {

/// Seconds (or anything) measured again and again; not empty.
using Samples = std::vector<double>;

/// The middle one; of an even number, the larger of the two in the middle.
double median(Samples samples);

/// (largest - smallest) / median.
double spread(const Samples& samples);

/// The commit of the source folder now, with "-dirty" where files differ from it, or "unknown".
/// Asked for at run time: a commit alone neither configures nor builds again.
std::string source_commit();

/// An object keeps its keys in the order in which they were added.
using Json = nlohmann::ordered_json;

/// Replaces the file as a whole or not at all. Throws InputError when it can't be written.
void write_json(const Json& json, const std::filesystem::path& path);

} // namespace onde::bench
