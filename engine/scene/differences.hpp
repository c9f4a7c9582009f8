#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::scene {

/// One thing in which runs may differ: a part of the scene, one of its keys, or what is no part of
/// it, such as the program's version.
struct Setting {
    std::string part;           ///< of which it is a key: "cells"; "": of none
    std::string name;           ///< "cells.nodes"
    std::string shown, absent;  ///< "cells.nodes = 162"; "without cells.nodes"
};

/// The settings of a resolved scene that the motion depends on, in the scene's order, and its seed:
/// titles, pictures, stored fields and what is expected are left out. A scene that an earlier
/// version resolved has the defaults of keys that have come since. name: in messages.
[[nodiscard]] std::vector<Setting> settings_of_motion(const std::string& resolved_toml,
                                                      const std::string& name);

/// What tells the runs apart, a line for each: "seed = 2", "cells.nodes = 642, without [cytosol]".
/// Empty for runs that are the same in all settings.
[[nodiscard]] std::vector<std::string> what_differs(std::span<const std::vector<Setting>> runs);

}  // namespace spheroscope::scene
