#include "engine/contact/closest_point.hpp"

namespace spheroscope {

std::array<double, 3> closest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    // The regions of the corners, then of the edges, then the face; each test is a sign.
    const double ab_a = ab.dot(ap), ac_a = ac.dot(ap);
    if (ab_a <= 0.0 && ac_a <= 0.0) return {1.0, 0.0, 0.0};
    const double ab_b = ab.dot(bp), ac_b = ac.dot(bp);
    if (ab_b >= 0.0 && ac_b <= ab_b) return {0.0, 1.0, 0.0};
    const double area_c = ab_a * ac_b - ab_b * ac_a;  // of (a, b, p), up to a common factor
    if (area_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) {
        const double v = ab_a / (ab_a - ab_b);
        return {1.0 - v, v, 0.0};
    }
    const double ab_c = ab.dot(cp), ac_c = ac.dot(cp);
    if (ac_c >= 0.0 && ab_c <= ac_c) return {0.0, 0.0, 1.0};
    const double area_b = ab_c * ac_a - ab_a * ac_c;
    if (area_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) {
        const double w = ac_a / (ac_a - ac_c);
        return {1.0 - w, 0.0, w};
    }
    const double area_a = ab_b * ac_c - ab_c * ac_b;
    const double from_b = ac_b - ab_b, from_c = ab_c - ac_c;
    if (area_a <= 0.0 && from_b >= 0.0 && from_c >= 0.0) {
        const double w = from_b / (from_b + from_c);
        return {0.0, 1.0 - w, w};
    }
    const double sum = area_a + area_b + area_c;
    return {area_a / sum, area_b / sum, area_c / sum};
}

}  // namespace spheroscope
