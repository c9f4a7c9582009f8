#pragma once

#include "engine/base/error.hpp"
#include "engine/statistics/run_statistics.hpp"

#include <string>

namespace spheroscope::cli {

/// A run that can be read, and has no mechanics in it.
class NothingToMeasure : public Error {
  public:
    explicit NothingToMeasure(const std::string& reason) : Error(reason), reason_(reason) {}
    /// Why, as a part of a sentence of the reader's.
    [[nodiscard]] const std::string& reason() const { return reason_; }

  private:
    std::string reason_;
};

/// The last frame of a stored run, measured, and all of its frames under a bead. Throws Error when
/// the file is not a run, and NothingToMeasure.
[[nodiscard]] statistics::RunStatistics measure_stored_run(const std::string& file);

}  // namespace spheroscope::cli
