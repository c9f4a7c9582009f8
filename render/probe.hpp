#pragma once

#include <string>

namespace spheroscope::render {

/// Draws two colours, reads them back, opens the fonts, and says what drew. Throws Error
/// (environment) with the reason if any of that fails.
[[nodiscard]] std::string probe_pictures();

}  // namespace spheroscope::render
