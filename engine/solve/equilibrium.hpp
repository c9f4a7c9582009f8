#pragma once

#include "engine/solve/method.hpp"

namespace spheroscope {

[[nodiscard]] std::unique_ptr<Method> make_equilibrium(const MethodParameters& parameters);

}  // namespace spheroscope
