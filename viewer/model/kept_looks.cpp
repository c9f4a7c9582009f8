#include "viewer/model/kept_looks.hpp"

#include <utility>

namespace spheroscope::viewer {

std::size_t bytes_of(const Snapshot& snapshot) {
    std::size_t n = snapshot.x_um.size() + snapshot.normal.size();
    for (const std::vector<float>& values : snapshot.fields) n += values.size();
    return n * sizeof(float);
}

void KeptLooks::add(SnapshotPtr look) {
    bytes_ += bytes_of(*look);
    looks_.push_back(std::move(look));
    while (bytes_ > kept_bytes_ && looks_.size() > 1) {
        bytes_ -= bytes_of(*looks_.front());
        looks_.pop_front();
    }
}

SnapshotPtr KeptLooks::back(int n_looks) const {
    if (n_looks < 0 || n_looks >= size()) return nullptr;
    return looks_[looks_.size() - 1 - static_cast<std::size_t>(n_looks)];
}

}  // namespace spheroscope::viewer
