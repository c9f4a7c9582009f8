#include "engine/base/hash_text.hpp"

#include <charconv>

namespace spheroscope {
namespace {

constexpr std::size_t k_n_digits = 16;

}  // namespace

std::string hash_text(std::uint64_t hash) {
    std::string text(k_n_digits, '0');
    for (std::size_t i = k_n_digits; i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15U];
    return text;
}

std::optional<std::uint64_t> hash_of_text(std::string_view text) {
    std::uint64_t hash = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, hash, 16);
    if (text.size() != k_n_digits || error != std::errc() || read != end) return {};
    return hash;
}

}  // namespace spheroscope
