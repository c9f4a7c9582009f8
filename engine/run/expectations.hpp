#pragma once

#include "engine/measures/totals.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/scene/scene.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace spheroscope {

/// One row of [expect] against what came out.
struct Expectation {
    std::string measure;
    std::string unit;
    double value = 0.0;
    double min = 0.0, max = 0.0;
    bool met = false;  ///< an undefined value meets nothing
};

/// Measures are the rows of the table of totals. Throws Error for one that does not exist.
[[nodiscard]] std::vector<Expectation> check_expectations(const scene::Scene& scene,
                                                          const Snapshot& last);
[[nodiscard]] std::vector<Expectation> check_expectations(const scene::Scene& scene,
                                                          const Totals& at_the_end);

/// [expect] of the scene names this measure.
[[nodiscard]] bool is_expected(const scene::Scene& scene, std::string_view measure);

/// Throws like check_expectations, before anything has run.
void check_expectation_names(const scene::Scene& scene);

}  // namespace spheroscope
