#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace spheroscope {

/// FNV-1a, 64 bits (Fowler, Noll and Vo): equal hashes mean equal bytes, but for one chance in
/// 1e19. Not against somebody who wants two to be equal.
class Fnv1a {
  public:
    void add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte)
            add_byte(static_cast<unsigned char>((word >> (8 * byte)) & 0xffU));
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(std::string_view text) {
        for (const char c : text) add_byte(static_cast<unsigned char>(c));
    }
    void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) add_byte(std::to_integer<unsigned char>(byte));
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

  private:
    void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3ULL; }

    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace spheroscope
