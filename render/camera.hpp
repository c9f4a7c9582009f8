#pragma once

#include "engine/base/vec3.hpp"

namespace spheroscope::render {

/// A parallel (orthographic) view: everything in the picture has one scale, so a scale bar is true
/// everywhere. Pixel coordinates run right and down; (0, 0) is the upper left corner of the
/// picture.
struct Camera {
    Vec3 focal_um = Vec3::Zero();  ///< shown at (centre_x_px, centre_y_px)
    Vec3 towards_eye{1.0, 0.0, 0.0}, up{0.0, 0.0, 1.0}, right{0.0, 1.0, 0.0};  ///< orthonormal
    double px_per_um = 1.0;
    double centre_x_px = 0.0, centre_y_px = 0.0;

    struct Pixel {
        double x, y;
        double nearness_um;  ///< distance towards the eye from the plane through focal_um
    };
    [[nodiscard]] Pixel project(const Vec3& x_um) const;
};

/// A camera that looks at a point. azimuth turns about the z axis, elevation lifts above the xy
/// plane;
/// +-90 degrees look straight down or up.
[[nodiscard]] Camera make_camera(const Vec3& focal_um, double azimuth_deg, double elevation_deg);

}  // namespace spheroscope::render
