#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spheroscope {

/// Instruction sets for which the contact kernel is compiled and that this machine has, best
/// first: "avx512", "avx2", "sse4", "scalar".
[[nodiscard]] std::vector<std::string> simd_targets();

/// The one in use; at first the best.
[[nodiscard]] std::string simd_target();

/// Uses this one from now on, in the whole process. False, and nothing changes, if it is not among
/// simd_targets(). Not while contacts are being found.
[[nodiscard]] bool use_simd_target(std::string_view name);

}  // namespace spheroscope
