#pragma once

#include "render/picture.hpp"
#include "tests/render/synthetic.hpp"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace spheroscope::render {

/// A look along the x axis at cells in the yz plane.
inline scene::Picture front_picture(const std::string& field) {
    scene::Picture picture = synthetic::make_picture(field);
    picture.azimuth_deg = 0.0;
    picture.elevation_deg = 0.0;
    return picture;
}

inline Rgb pixel_at(const Image& image, const Camera::Pixel& p) {
    return image.at(static_cast<int>(p.x), static_cast<int>(p.y));
}

/// Largest difference of a channel.
inline int distance(Rgb a, Rgb b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

}  // namespace spheroscope::render
