#pragma once

#include "engine/base/repetitions.hpp"
#include "engine/contact/contact_law.hpp"
#include "engine/contact/pair_kernel.hpp"
#include "engine/model/model.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace spheroscope {

/// CPU time of finding all contacts of one configuration on one core, everything included.
struct ContactTiming {
    struct Kernel {
        std::int64_t candidates = 0;  ///< pairs that were looked at one by one
        std::int64_t active_pairs = 0;
        double ns_per_candidate = 0.0;  ///< whole time / candidates
        double ns_per_active_pair = 0.0;
    };
    Kernel plain;        ///< contact_of_triangles, from ready lists of candidates (0.3 um of skin)
    Kernel simd;         ///< ContactSearch::find, which needs no lists
    std::string target;  ///< SIMD target in use
};

/// Times both in turns and takes the shortest of each. x_um [all nodes].
[[nodiscard]] ContactTiming time_contacts(const Model& model, std::span<const Vec3> x_um,
                                          const ContactLaw& law, ContactPrecision precision,
                                          const Repetitions& repetitions);

}  // namespace spheroscope
