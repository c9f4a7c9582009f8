#pragma once

#include "engine/run/snapshot.hpp"

#include <cstddef>
#include <deque>

namespace spheroscope::viewer {

/// The newest states of a running engine that were looked at, for steps back. The oldest ones go
/// where there would be more than `kept_bytes`.
class KeptLooks {
  public:
    static constexpr std::size_t k_kept_bytes = std::size_t{256} << 20U;

    explicit KeptLooks(std::size_t kept_bytes = k_kept_bytes) : kept_bytes_(kept_bytes) {}

    /// Later than those that are there.
    void add(SnapshotPtr look);
    [[nodiscard]] int size() const { return static_cast<int>(looks_.size()); }
    /// 0: the newest. nullptr if there are not so many.
    [[nodiscard]] SnapshotPtr back(int n_looks) const;

  private:
    std::size_t kept_bytes_;
    std::deque<SnapshotPtr> looks_;
    std::size_t bytes_ = 0;
};

/// Memory of a snapshot's large arrays.
[[nodiscard]] std::size_t bytes_of(const Snapshot& snapshot);

}  // namespace spheroscope::viewer
