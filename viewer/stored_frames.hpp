#pragma once

#include "engine/inspect/contact_history.hpp"
#include "engine/store/run_file.hpp"
#include "viewer/frames.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <thread>

namespace spheroscope::viewer {

/// The frames of a file. A thread of its own reads them (HDF5 has one user): the frame that is
/// wanted first, else the next ones behind it, else the history of a watched contact, else the
/// survey of the whole run. It keeps the latest k_kept_bytes of them. A frame that cannot be read,
/// or a contact whose forces cannot be computed in one, takes nothing from the others.
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
    [[nodiscard]] std::string contact_failure() override;
    [[nodiscard]] std::string failure() override;

  private:
    /// The contact whose history is gathered.
    struct Watch {
        Watch(const std::shared_ptr<const RunHeader>& header, const inspect::ContactKey& key)
            : historian(header, key) {}
        inspect::ContactHistorian historian;
        std::vector<inspect::ContactSummary> rows;
    };

    void read_all();
    /// Hands over what was gathered and tells of it: of what is waited for at once, of the rest now
    /// and then, since each time all of it is copied.
    void tell(bool is_waited_for);
    /// What to read next; -1: nothing.
    [[nodiscard]] int next_wanted() const;
    [[nodiscard]] SnapshotPtr find(int number) const;
    void keep(SnapshotPtr snapshot);
    /// Whether the watched contact's history goes on with this frame.
    [[nodiscard]] bool history_wants(int number) const;
    // These leave `lock` while they are at work. A frame that cannot be read is nullptr.
    [[nodiscard]] SnapshotPtr read(int number, std::unique_lock<std::mutex>& lock);
    void add_to_survey(const SnapshotPtr& snapshot, std::unique_lock<std::mutex>& lock);
    void add_to_history(const SnapshotPtr& snapshot, int number,
                        std::unique_lock<std::mutex>& lock);

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
    std::map<int, std::string> unreadable_;  // frames, and why
    RunSurvey survey_;                       // as it was handed over last
    std::shared_ptr<Watch> watch_;           // the reading thread alone looks inside
    ContactRows contact_history_;
    std::string contact_failure_;

    RunSurvey gathered_;                               // of the reading thread
    std::chrono::steady_clock::time_point told_at_{};  // of the reading thread
    std::thread thread_;                               // last: it starts when all else is there
};

}  // namespace spheroscope::viewer
