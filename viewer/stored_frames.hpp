#pragma once

#include "engine/store/run_file.hpp"
#include "viewer/frames.hpp"

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>

namespace spheroscope::viewer {

/// The frames of a file. A thread of its own reads them (HDF5 has one user): the frame that is
/// wanted first, else the next ones behind it, else the survey of the whole run. It keeps the
/// latest k_kept_bytes of them.
class StoredFrames final : public Frames {
  public:
    static constexpr std::size_t k_kept_bytes = std::size_t{512} << 20U;

    /// Throws what RunFileReader throws. `on_news` is called in the reading thread.
    StoredFrames(const std::string& path, std::function<void()> on_news);
    ~StoredFrames() override;

    [[nodiscard]] std::shared_ptr<const RunHeader> header() const override {
        return reader_.header();
    }
    [[nodiscard]] std::vector<double> take_new_times() override;
    [[nodiscard]] SnapshotPtr frame(int number) override;
    [[nodiscard]] RunSurvey survey() override;
    [[nodiscard]] int n_surveyed() override;
    [[nodiscard]] std::string failure() override;

  private:
    void read_all();
    /// What to read next; -1: nothing.
    [[nodiscard]] int next_wanted() const;
    [[nodiscard]] SnapshotPtr find(int number) const;
    void keep(SnapshotPtr snapshot);

    const RunFileReader reader_;
    const std::function<void()> on_news_;
    bool times_taken_ = false;

    std::mutex mutex_;
    std::condition_variable changed_;
    // guarded by mutex_
    bool is_over_ = false;
    int wanted_ = -1;
    std::list<SnapshotPtr> kept_;  // the one used last in front
    std::size_t kept_bytes_ = 0;
    RunSurvey survey_;
    std::string failure_;

    std::thread thread_;  // last: it starts when all else is there
};

}  // namespace spheroscope::viewer
