#pragma once

#include "engine/cli/simulate.hpp"

#include <cstdint>
#include <vector>

namespace spheroscope::cli {

/// Simulates a scene with one seed after the other, each into <folder>/seed_<n>, and prints them as
/// a table with the means of all that came to their end. A seed that fails is listed with its
/// reason, and the others go on; then the code is not_converged. With options.resume finished seeds
/// are left alone. A signal ends the seed in progress and the whole. Throws Error when the scene
/// cannot be read.
[[nodiscard]] ExitCode run_seeds(const std::string& scene_file,
                                 const std::vector<std::uint64_t>& seeds,
                                 const CommonOptions& options, bool overwrite,
                                 const Invocation& invocation);

}  // namespace spheroscope::cli
