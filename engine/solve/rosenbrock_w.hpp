#pragma once

#include "engine/solve/method.hpp"

namespace spheroscope {

[[nodiscard]] std::unique_ptr<Method> make_rosenbrock_w(const MethodParameters& parameters);

}  // namespace spheroscope
