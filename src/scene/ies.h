// Lamps as their makers measure them: IES LM-63 files of 1986 to 2002, with photometry of type C.
#pragma once

#include "scene/light.h"
#include "scene/load_context.h"

#include <filesystem>
#include <string_view>

namespace onde {

/// The profile that a file's text states, its candela times its multipliers, on a grid as fine as
/// its angles; 0 where it states none. Its horizontal angles run counter-clockwise seen from
/// against the profile's axis. Takes what it needs from what the load may use. Throws InputError
/// "NAME: ..." for what is no such file.
LightProfile read_ies(std::string_view text, const std::string& name, LoadContext& context,
                      Notes& notes);

/// The same of a file.
LightProfile load_ies_within(LoadContext& context, const std::filesystem::path& path, Notes& notes);

} // namespace onde
