#include "engine/contact/overlap_integral.hpp"

#include <algorithm>
#include <cstddef>

namespace spheroscope {
namespace {

/// The polynomial over the whole triangle. The integral of a product of affine functions f and g is
/// (sum f sum g + sum f g) / 12 over the corners.
OverlapIntegral over_all(const std::array<double, 3>& d, const ContactLaw& law) {
    const double sum = d[0] + d[1] + d[2];
    const double squares = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    OverlapIntegral result;
    result.energy_fJ_per_um2 =
        law.k_kPa_per_um * (sum * sum + squares) / 24.0 - law.P0_kPa * sum / 3.0;
    for (std::size_t i = 0; i < 3; ++i) {
        result.pressure_kPa[i] = law.k_kPa_per_um * (sum + d[i]) / 12.0 - law.P0_kPa / 3.0;
        result.share[i] = 1.0 / 3.0;
    }
    return result;
}

/// The polynomial over the triangle that the line delta = 0 cuts off at corner p. Precondition: the
/// overlaps of the other corners have the other sign or are 0, and that of p is not 0.
OverlapIntegral over_corner(const std::array<double, 3>& d, std::size_t p, const ContactLaw& law) {
    const std::size_t q = (p + 1) % 3, r = (p + 2) % 3;
    const double to_q = d[p] / (d[p] - d[q]), to_r = d[p] / (d[p] - d[r]);
    const double part = to_q * to_r;
    // Of the part's corners only p has an overlap; the sums of lambda over its three corners:
    std::array<double, 3> sum{};
    sum[p] = 3.0 - to_q - to_r;
    sum[q] = to_q;
    sum[r] = to_r;
    OverlapIntegral result;
    result.energy_fJ_per_um2 =
        part * (law.k_kPa_per_um * d[p] * d[p] / 12.0 - law.P0_kPa * d[p] / 3.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const double at_p = i == p ? 1.0 : 0.0;
        result.pressure_kPa[i] =
            part * (law.k_kPa_per_um * d[p] * (sum[i] + at_p) / 12.0 - law.P0_kPa * sum[i] / 3.0);
        result.share[i] = part * sum[i] / 3.0;
    }
    return result;
}

}  // namespace

OverlapIntegral integrate_overlap(const std::array<double, 3>& d, const ContactLaw& law) {
    const auto touches = [](double overlap) { return overlap > 0.0; };
    const auto n_touching = std::count_if(d.begin(), d.end(), touches);
    if (n_touching == 0) return {};
    if (n_touching == 3) return over_all(d, law);
    if (n_touching == 1) {
        const auto p = std::find_if(d.begin(), d.end(), touches) - d.begin();
        return over_corner(d, static_cast<std::size_t>(p), law);
    }
    const auto p =
        static_cast<std::size_t>(std::find_if_not(d.begin(), d.end(), touches) - d.begin());
    OverlapIntegral result = over_all(d, law);
    if (d[p] == 0.0) return result;
    const OverlapIntegral rest = over_corner(d, p, law);
    result.energy_fJ_per_um2 -= rest.energy_fJ_per_um2;
    for (std::size_t i = 0; i < 3; ++i) {
        result.pressure_kPa[i] -= rest.pressure_kPa[i];
        result.share[i] -= rest.share[i];
    }
    return result;
}

}  // namespace spheroscope
