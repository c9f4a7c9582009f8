#pragma once

#include <string>

namespace spheroscope::cli {

/// Program version with the commit it was built from: "0.1.0 (3b1f2c4d5e)", with "+changes" after
/// the commit when the sources differ from it, and the number alone outside a git checkout.
[[nodiscard]] std::string version_text();

}  // namespace spheroscope::cli
