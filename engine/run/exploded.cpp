#include "engine/run/exploded.hpp"

namespace spheroscope {
namespace {

Vec3 centre_of(const Snapshot& snapshot, std::size_t cell) {
    return {double{snapshot.centre_um[3 * cell]}, double{snapshot.centre_um[3 * cell + 1]},
            double{snapshot.centre_um[3 * cell + 2]}};
}

Vec3 middle_of(const Snapshot& snapshot) {
    Vec3 sum = Vec3::Zero();
    double volume_um3 = 0.0;
    for (std::size_t c = 0; c < snapshot.volume_um3.size(); ++c) {
        sum += double{snapshot.volume_um3[c]} * centre_of(snapshot, c);
        volume_um3 += double{snapshot.volume_um3[c]};
    }
    return sum / volume_um3;
}

void move(std::vector<float>& x_um, std::size_t first, std::size_t n, const Vec3& shift) {
    for (std::size_t i = first; i < first + n; ++i)
        for (int d = 0; d < 3; ++d) {
            float& x = x_um[3 * i + static_cast<std::size_t>(d)];
            x = static_cast<float>(double{x} + shift[d]);
        }
}

}  // namespace

Snapshot exploded(const Snapshot& snapshot, double share) {
    Snapshot moved = snapshot;
    const Vec3 middle = middle_of(snapshot);
    const auto n_cells = static_cast<std::size_t>(snapshot.header->n_cells);
    const std::size_t n_nodes = snapshot.x_um.size() / (3 * n_cells);
    for (std::size_t c = 0; c < n_cells; ++c) {
        const Vec3 shift = share * (centre_of(snapshot, c) - middle);
        move(moved.x_um, c * n_nodes, n_nodes, shift);
        move(moved.centre_um, c, 1, shift);
    }
    return moved;
}

Vec3 shift_when_exploded_um(const Snapshot& snapshot, double share, int cell) {
    return share * (centre_of(snapshot, static_cast<std::size_t>(cell)) - middle_of(snapshot));
}

}  // namespace spheroscope
