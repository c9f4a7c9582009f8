#include "engine/forces/hinge_slope.hpp"

#include <cmath>

namespace spheroscope {

Hinge::Hinge(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b) {
    const Vec3 e = j - i;
    const double length2 = e.squaredNorm();
    const double length = std::sqrt(length2);
    const Vec3 m_left = e.cross(a - i);
    const Vec3 m_right = (b - i).cross(e);
    const double left2 = m_left.squaredNorm(), right2 = m_right.squaredNorm();
    const double size = std::sqrt(left2 * right2);
    cosine = m_left.dot(m_right) / size;
    sine = m_left.cross(m_right).dot(e) / (length * size);
    // Raising a or b flattens a convex hinge, the faster the nearer it is to the edge; where the
    // feet of a and b stand on the edge says how i and j share the opposite motion.
    slope = {(-length / left2) * m_left, (-length / right2) * m_right, (a - i).dot(e) / length2,
             (b - i).dot(e) / length2};
}

HingeSlope hinge_slope(const Vec3& i, const Vec3& j, const Vec3& a, const Vec3& b) {
    return Hinge(i, j, a, b).slope;
}

}  // namespace spheroscope
