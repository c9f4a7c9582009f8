#pragma once

#include "engine/contact/contact_law.hpp"

#include <array>

namespace spheroscope {

/// Integrals over a triangle on which the overlap is affine, divided by the triangle's area.
struct OverlapIntegral {
    double energy_fJ_per_um2 = 0.0;  ///< e(delta), over the part with delta > 0
    /// P(delta) lambda_i over that part: the derivative of the energy by the overlap at corner i.
    std::array<double, 3> pressure_kPa{};
    std::array<double, 3> share{};  ///< lambda_i over that part; sums to the part's share
};

/// The contact energy of a triangle from the overlaps at its corners, exactly: e(delta) is a
/// polynomial where delta > 0, and nothing elsewhere.
///
///        p        one corner touches: the part is the corner triangle (p, pq, pr), whose sides are
///       / .       the fractions delta_p / (delta_p - delta_q) and delta_p / (delta_p - delta_r);
///     pq---pr     two touch: all of the polynomial's integral less that of the third corner.
///     /      .
///    q--------r   delta = 0 along pq - pr
///
/// The energy is continuous to its first derivative, also where the line delta = 0 crosses a corner
/// (e(0) = 0 there); only where all three overlaps pass 0 together does the derivative jump, by P0.
[[nodiscard]] OverlapIntegral integrate_overlap(const std::array<double, 3>& overlap_um,
                                                const ContactLaw& law);

}  // namespace spheroscope
