#pragma once

#include "engine/solve/method.hpp"

namespace spheroscope {

[[nodiscard]] std::unique_ptr<Method> make_linearly_implicit(const MethodParameters& parameters);

}  // namespace spheroscope
