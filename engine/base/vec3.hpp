#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spheroscope {

/// A point, a vector or a force in space; the quantity's name carries its unit (x_um, F_nN).
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace spheroscope
