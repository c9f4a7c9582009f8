#include "engine/cli/seeds.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

namespace spheroscope::cli {
namespace {

constexpr std::size_t k_most_seeds = 1000;

std::optional<std::uint64_t> number_of(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
    return number;
}

}  // namespace

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
        const auto first = number_of(part.substr(0, dots));
        const auto last = dots == std::string_view::npos ? first : number_of(part.substr(dots + 2));
        if (!first || !last) throw refuse("");
        if (*last < *first) throw refuse(": " + std::string(part) + " is empty");
        if (*last - *first >= k_most_seeds || seeds.size() + (*last - *first) >= k_most_seeds)
            throw refuse(": at most " + std::to_string(k_most_seeds) + " at once");
        for (std::uint64_t i = 0; i <= *last - *first; ++i) {
            if (std::find(seeds.begin(), seeds.end(), *first + i) != seeds.end())
                throw refuse(": seed " + std::to_string(*first + i) + " is there twice");
            seeds.push_back(*first + i);
        }
        if (comma == std::string_view::npos) return seeds;
        rest = rest.substr(comma + 1);
    }
}

}  // namespace spheroscope::cli
