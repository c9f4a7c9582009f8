#include "engine/base/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace spheroscope {
namespace {

r123::Philox4x32::ctr_type block(std::uint64_t seed, std::uint32_t stream, std::uint64_t index,
                                 std::uint32_t component) {
    const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v & 0xffffffffU); };
    const r123::Philox4x32::ctr_type counter = {{low(index), low(index >> 32U), component, stream}};
    const r123::Philox4x32::key_type key = {{low(seed), low(seed >> 32U)}};
    return r123::Philox4x32{}(counter, key);
}

/// 53 random bits, centred in their cell, so neither 0 nor 1 comes out.
double to_unit(std::uint32_t high, std::uint32_t low) {
    const std::uint64_t bits = ((std::uint64_t{high} << 32U) | low) >> 11U;
    return (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
}

}  // namespace

double Random::uniform(std::uint64_t index, std::uint32_t component) const {
    const auto r = block(seed_, stream_, index, component);
    return to_unit(r[0], r[1]);
}

double Random::normal(std::uint64_t index, std::uint32_t component) const {
    const auto r = block(seed_, stream_, index, component);
    return std::sqrt(-2.0 * std::log(to_unit(r[0], r[1]))) *
           std::cos(2.0 * std::numbers::pi * to_unit(r[2], r[3]));
}

}  // namespace spheroscope
