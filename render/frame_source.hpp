#pragma once

#include "engine/run/snapshot.hpp"

namespace spheroscope::render {

/// The frames of one run, in order, from wherever they are kept. Only one thread asks.
class FrameSource {
  public:
    virtual ~FrameSource() = default;
    [[nodiscard]] virtual int n_frames() = 0;
    /// Precondition: 0 <= i < n_frames(). The same i gives equal frames each time.
    [[nodiscard]] virtual SnapshotPtr frame(int i) = 0;
};

}  // namespace spheroscope::render
