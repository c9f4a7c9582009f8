#pragma once

#include "engine/base/vec3.hpp"

#include <array>
#include <memory>
#include <vector>

namespace spheroscope {

/// A convex polyhedron around the cells, fixed in space. What confines is the part that is not
/// open: where faces are missing, the planes of those beside the gap still hold.
struct Hull {
    struct Plane {
        Vec3 normal;       ///< unit, outward
        double offset_um;  ///< inside: normal . x <= offset
    };
    std::vector<Plane> planes;                 ///< of the faces that are not open
    std::vector<Vec3> vertex_um;               ///< of all faces, for pictures
    std::vector<std::array<int, 3>> triangle;  ///< closed faces, counter-clockwise from outside
};

/// A rigid sphere on a straight line, pushed by a constant force. Its place on the line is an
/// unknown of the motion.
struct Probe {
    double radius_um = 0.0;  ///< 0: there is no probe
    double force_nN = 0.0;   ///< along `direction`
    double friction_nN_s_per_um = 0.0;
    Vec3 start_um = Vec3::Zero();  ///< centre at the start of the loading
    Vec3 direction = Vec3::Zero();
    double way_um = 0.0;  ///< since then, along `direction`
    double speed_um_per_s = 0.0;

    [[nodiscard]] bool acts() const { return radius_um > 0.0; }
    [[nodiscard]] Vec3 centre_um() const { return start_um + way_um * direction; }
    friend bool operator==(const Probe&, const Probe&) = default;
};

/// What loads the aggregate from outside.
struct Load {
    std::shared_ptr<const Hull> hull;  ///< nullptr: none
    Probe probe;
    friend bool operator==(const Load&, const Load&) = default;
};

}  // namespace spheroscope
