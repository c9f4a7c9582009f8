#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace spheroscope::cli {

/// What is wrong with the text of a seed, "" if nothing is: one rule for --seed and --seeds.
[[nodiscard]] std::string problem_of_seed(const std::string& text);

/// Reads "1..5", "3", "1,4,7" or a mixture, "1..3,10". Throws Error (usage) for anything else, for
/// a range that runs backward, for a seed that is named twice and for more than a thousand.
[[nodiscard]] std::vector<std::uint64_t> parse_seeds(const std::string& text);

}  // namespace spheroscope::cli
