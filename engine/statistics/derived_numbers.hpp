#pragma once

#include "engine/statistics/setup_numbers.hpp"

#include <string_view>
#include <vector>

namespace spheroscope::statistics {

/// Appends the numbers that are made of others, where those are there and it is not there yet: run
/// by run, or of the means, with their errors, in a report that does not list runs. So a report of
/// runs that are gone gets them as well. `law` is that of contact.
///
/// `core_over_2Gamma_R`, with the law `traction`: -sigma_h_core R_th / (2 Gamma) with Gamma =
/// gamma_eff of the rim minus that of the core, all of one run. A droplet in balance has 1: the
/// tension of its surface over that of its inside holds the pressure of the core. gamma cancels in
/// Gamma. What carries tension but is in neither gamma nor the springs is not in it: a strain
/// limiter, and the film of `variational`, which therefore has no such number.
void add_derived_numbers(std::vector<SetupNumber>& numbers, std::string_view law);

}  // namespace spheroscope::statistics
