#pragma once

#include "engine/inspect/contact_report.hpp"
#include "viewer/run_survey.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope::viewer {

/// The panel is drawn for each news: more of them would take the time from reading.
inline constexpr std::chrono::milliseconds k_telling_every{100};

using ContactRows = std::shared_ptr<const std::vector<inspect::ContactSummary>>;

/// Where the panel's frames come from. Called by the panel's thread; nothing here waits for a disk.
class Frames {
  public:
    virtual ~Frames() = default;
    [[nodiscard]] virtual std::shared_ptr<const RunHeader> header() const = 0;
    /// Times of the frames that came since the last call.
    [[nodiscard]] virtual std::vector<double> take_new_times() = 0;
    /// The frame if it is at hand; else nullptr, and it is fetched before all others.
    [[nodiscard]] virtual SnapshotPtr frame(int number) = 0;
    /// The first picture is on show: what would have taken the processors from it may begin.
    virtual void begin_survey() {}
    /// The survey so far, copied: others go on with it.
    [[nodiscard]] virtual RunSurvey survey() = 0;
    /// Goes up with the frames of the survey, also with those that cannot be read.
    [[nodiscard]] virtual int n_surveyed() = 0;
    /// Gathers the history of this contact from now on; nullopt: of none. Throws Error where the
    /// run has no such contacts.
    virtual void watch_contact(std::optional<inspect::ContactKey> key) = 0;
    /// Its rows so far, ascending by frames; nullptr: no contact is watched.
    [[nodiscard]] virtual ContactRows contact_history() = 0;
    /// Why the watched contact's history ends before the run does; "" if all is well. Other
    /// contacts, and frames themselves, are another matter.
    [[nodiscard]] virtual std::string contact_failure() = 0;
    /// Why the frame that was asked for last will not come; "" if all is well.
    [[nodiscard]] virtual std::string failure() = 0;
};

}  // namespace spheroscope::viewer
