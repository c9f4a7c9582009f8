#include "engine/cli/seeds.hpp"

#include "engine/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace spheroscope::cli {
namespace {

constexpr std::size_t k_most_seeds = 1000;

}  // namespace

std::string problem_of_seed(const std::string& text) {
    constexpr std::size_t most_digits = 18;  // below 2^63, as numbers of a scene are
    const bool digits = !text.empty() && text.size() <= most_digits &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    return digits ? ""
                  : fmt::format("wanted a whole number of at most {} digits, got '{}'", most_digits,
                                text);
}

std::vector<std::uint64_t> parse_seeds(const std::string& text) {
    const auto refuse = [&](const std::string& why) {
        return Error("--seeds wants seeds such as 1..5 or 1,4,7, got '" + text + "'" + why);
    };
    std::vector<std::uint64_t> seeds;
    std::string_view rest = text;
    while (true) {
        const std::size_t comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        const std::size_t dots = part.find("..");
        const std::string first_text(part.substr(0, dots));
        const std::string last_text(dots == std::string_view::npos ? first_text
                                                                   : part.substr(dots + 2));
        for (const std::string& number : {first_text, last_text})
            if (const std::string problem = problem_of_seed(number); !problem.empty())
                throw refuse(": " + problem);
        const std::uint64_t first = std::stoull(first_text), last = std::stoull(last_text);
        if (last < first) throw refuse(": " + std::string(part) + " is empty");
        if (last - first >= k_most_seeds || seeds.size() + (last - first) >= k_most_seeds)
            throw refuse(": at most " + std::to_string(k_most_seeds) + " at once");
        for (std::uint64_t seed = first; seed <= last; ++seed) {
            if (std::find(seeds.begin(), seeds.end(), seed) != seeds.end())
                throw refuse(": seed " + std::to_string(seed) + " is there twice");
            seeds.push_back(seed);
        }
        if (comma == std::string_view::npos) return seeds;
        rest = rest.substr(comma + 1);
    }
}

}  // namespace spheroscope::cli
