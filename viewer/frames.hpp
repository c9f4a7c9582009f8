#pragma once

#include "viewer/run_survey.hpp"

#include <memory>
#include <string>
#include <vector>

namespace spheroscope::viewer {

/// Where the panel's frames come from. Called by the panel's thread; nothing here waits for a disk.
class Frames {
  public:
    virtual ~Frames() = default;
    [[nodiscard]] virtual std::shared_ptr<const RunHeader> header() const = 0;
    /// Times of the frames that came since the last call.
    [[nodiscard]] virtual std::vector<double> take_new_times() = 0;
    /// The frame if it is at hand; else nullptr, and it is fetched before all others.
    [[nodiscard]] virtual SnapshotPtr frame(int number) = 0;
    /// The survey so far, copied: others go on with it.
    [[nodiscard]] virtual RunSurvey survey() = 0;
    /// Goes up with every frame of the survey.
    [[nodiscard]] virtual int n_surveyed() = 0;
    /// Why there will be no more frames; "" if all is well.
    [[nodiscard]] virtual std::string failure() = 0;
};

}  // namespace spheroscope::viewer
