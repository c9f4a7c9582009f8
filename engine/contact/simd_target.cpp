#include "engine/contact/simd_target.hpp"

#include <hwy/highway.h>

#include <array>
#include <cstdint>

namespace spheroscope {
namespace {

struct Target {
    std::string_view name;
    std::int64_t mask;
};
// HWY_SCALAR or HWY_EMU128, whichever the compiler can do.
constexpr std::array k_targets{Target{"avx512", HWY_AVX3}, Target{"avx2", HWY_AVX2},
                               Target{"sse4", HWY_SSE4}, Target{"scalar", HWY_BASELINE_SCALAR}};

/// What the machine has, whatever was asked for before.
std::int64_t supported() {
    static const std::int64_t targets = hwy::SupportedTargets() | HWY_BASELINE_SCALAR;
    return targets;
}

const Target*& current() {
    static const Target* target = nullptr;
    return target;
}

bool is_available(const Target& target) { return (target.mask & supported() & HWY_TARGETS) != 0; }

void use(const Target& target) {
    static_cast<void>(supported());  // before it is overridden
    hwy::SetSupportedTargetsForTest(target.mask);
    hwy::GetChosenTarget().Update(target.mask);
    current() = &target;
}

}  // namespace

std::vector<std::string> simd_targets() {
    std::vector<std::string> names;
    for (const Target& target : k_targets)
        if (is_available(target)) names.emplace_back(target.name);
    return names;
}

std::string simd_target() {
    return current() != nullptr ? std::string(current()->name) : simd_targets().front();
}

bool use_simd_target(std::string_view name) {
    for (const Target& target : k_targets)
        if (target.name == name && is_available(target)) {
            use(target);
            return true;
        }
    return false;
}

}  // namespace spheroscope
