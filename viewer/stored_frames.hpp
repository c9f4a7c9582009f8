#pragma once

#include "engine/inspect/contact_history.hpp"
#include "engine/store/run_file.hpp"
#include "viewer/frames.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>

namespace spheroscope::viewer {

/// The frames of a file. A thread of its own reads them (HDF5 has one user): the frame that is
/// wanted first, else the next ones behind it, else the history of a watched contact, else the
/// survey of the whole run. It keeps the latest k_kept_bytes of them.
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
    void begin_survey() override;
    [[nodiscard]] RunSurvey survey() override;
    [[nodiscard]] int n_surveyed() override;
    void watch_contact(std::optional<inspect::ContactKey> key) override;
    [[nodiscard]] ContactRows contact_history() override;
    [[nodiscard]] std::string failure() override;

  private:
    void read_all();
    /// Tells of news: of what is waited for at once, of the rest now and then.
    void tell(bool is_waited_for);
    /// What to read next; -1: nothing.
    [[nodiscard]] int next_wanted() const;
    [[nodiscard]] SnapshotPtr find(int number) const;
    void keep(SnapshotPtr snapshot);
    /// Rows of the watched contact's history; none is watched: all frames.
    [[nodiscard]] int n_contact_rows() const;
    /// Both leave `lock` while they look at the frame.
    void add_to_survey(const Snapshot& snapshot, std::unique_lock<std::mutex>& lock);
    void add_to_history(const SnapshotPtr& snapshot, std::unique_lock<std::mutex>& lock);

    const RunFileReader reader_;
    const std::function<void()> on_news_;
    bool times_taken_ = false;

    std::mutex mutex_;
    std::condition_variable changed_;
    // guarded by mutex_
    bool is_over_ = false, may_survey_ = false;
    int wanted_ = 0;
    std::list<SnapshotPtr> kept_;  // the one used last in front
    std::size_t kept_bytes_ = 0;
    RunSurvey survey_;
    std::shared_ptr<inspect::ContactHistorian> historian_;  // the reading thread alone asks it
    ContactRows contact_history_;
    std::string failure_;

    std::chrono::steady_clock::time_point told_at_{};  // of the reading thread
    std::thread thread_;                               // last: it starts when all else is there
};

}  // namespace spheroscope::viewer
