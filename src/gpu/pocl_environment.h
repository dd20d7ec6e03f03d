// What PoCL takes from the environment, made fit for it before the loader loads it: it ends the
// program where it finds no linker, a damaged cache or a system that does not tell its processors.
#pragma once

#include <string>

namespace onde::gpu {

/// Gives PoCL a folder of this process for what it compiles, gone at exit, instead of a cache of
/// its own (ProgramCache keeps the binaries, with checksums); a PATH where there is none; and the
/// number of processors where /sys does not tell it. What the user has set stays. Returns why PoCL
/// cannot work, as the end of a sentence on it, or nothing.
std::string prepare_pocl();

} // namespace onde::gpu
