#pragma once

#include "engine/run/changes.hpp"
#include "engine/run/error_estimate.hpp"
#include "engine/run/snapshot.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spheroscope {

namespace hdf5 {
class File;
}

/// How a run ended.
struct RunEnd {
    bool is_complete = false;  ///< all stages came to their end
    std::string
        outcome;  ///< in words: "rest", "cap", "interrupted", ... ; "" while the run goes on
    double wall_time_s = 0.0;               ///< what the run took
    std::vector<MeasureError> errors = {};  ///< how wrong the measures of the end are; /accuracy
    /// Of the state at the end of a complete run; none in files of versions that did not write it.
    std::optional<std::uint64_t> state_hash = {};
};

/// Writes a run to an HDF5 file, one group per frame (engine/store/README.md). Whatever kills the
/// program, the file holds every frame whose write() returned, and nothing of any other. After an
/// Error from write() or finish() the file is as before that call, and the writer can only be
/// destroyed. Used by one thread.
class RunFileWriter {
  public:
    enum class Existing { refuse, replace };

    /// A new file. Throws Error for a folder, a file that exists and must not be replaced, a file
    /// that another program writes, no permission or a full disk. A replaced file stays until the
    /// new one is there.
    [[nodiscard]] static RunFileWriter create(const std::string& path, const RunHeader& header,
                                              Existing existing);

    /// Goes on with a file after its first `n_frames` frames; later ones are removed, and the run
    /// counts as not ended. Throws Error if the file has fewer frames, or is the run of another
    /// scene, seed, mesh or list of fields.
    [[nodiscard]] static RunFileWriter append(const std::string& path, const RunHeader& header,
                                              int n_frames);

    ~RunFileWriter();
    RunFileWriter(RunFileWriter&&) noexcept;
    RunFileWriter& operator=(RunFileWriter&&) noexcept;

    /// Adds a frame. Precondition: frame.frame == n_frames(). Throws Error if a position is not a
    /// finite number, or if the file cannot be written.
    void write(const Snapshot& frame);
    void finish(const RunEnd& end);
    /// Replaces the list of changes that were made during the run (engine/run/changes.hpp).
    void record_changes(const std::vector<Change>& changes);

    [[nodiscard]] int n_frames() const { return n_frames_; }

  private:
    explicit RunFileWriter(std::unique_ptr<hdf5::File> file, int n_frames);
    std::unique_ptr<hdf5::File> file_;
    int n_frames_;
};

/// Reads a run, also one that is still being written or whose writer was killed. The frames are
/// those that the file had when it was opened. All functions throw Error naming the file if it is
/// damaged.
///
/// The file is open only during a call, so that a writer is not held up.
class RunFileReader {
  public:
    /// Throws Error for a missing file, a folder, a file that is not HDF5, not a run of ours, cut
    /// off, or of a newer format.
    explicit RunFileReader(std::string path);

    [[nodiscard]] const std::string& path() const { return path_; }
    /// Its fields have no `compute`, and all else that the file says about them. Compare them by
    /// name.
    [[nodiscard]] std::shared_ptr<const RunHeader> header() const { return header_; }
    [[nodiscard]] int n_frames() const { return static_cast<int>(time_s_.size()); }
    /// Model time of a frame, s.
    [[nodiscard]] double time(int frame) const;
    /// Throws Error if there is no such frame.
    [[nodiscard]] SnapshotPtr frame(int frame) const;

    /// One number of all frames, by its name in /diagnostics: fast, no frame is read. Throws Error
    /// when the file does not have it.
    [[nodiscard]] std::vector<double> number_of_frames(const std::string& name) const;

    /// What was changed during the run, in order: with it the scene gives the same run again.
    [[nodiscard]] const std::vector<Change>& changes() const { return changes_; }
    [[nodiscard]] const RunEnd& end() const { return end_; }
    [[nodiscard]] bool is_complete() const { return end_.is_complete; }
    [[nodiscard]] const std::string& outcome() const { return end_.outcome; }

  private:
    [[nodiscard]] std::shared_ptr<const std::vector<Change>> changes_before(double time_s) const;
    std::string path_;
    std::shared_ptr<const RunHeader> header_;
    std::vector<double> time_s_;
    RunEnd end_;
    std::vector<Change> changes_;
};

}  // namespace spheroscope
