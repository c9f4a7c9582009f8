#include "render/camera.hpp"

#include <cmath>
#include <numbers>

namespace spheroscope::render {

Camera::Pixel Camera::project(const Vec3& x_um) const {
    const Vec3 d = x_um - focal_um;
    return {centre_x_px + px_per_um * d.dot(right), centre_y_px - px_per_um * d.dot(up),
            d.dot(towards_eye)};
}

Camera make_camera(const Vec3& focal_um, double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * std::numbers::pi / 180.0;
    const double elevation = elevation_deg * std::numbers::pi / 180.0;
    Camera camera;
    camera.focal_um = focal_um;
    camera.towards_eye = {std::cos(elevation) * std::cos(azimuth),
                          std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
    camera.right = {-std::sin(azimuth), std::cos(azimuth), 0.0};
    camera.up = camera.towards_eye.cross(camera.right);
    return camera;
}

}  // namespace spheroscope::render
