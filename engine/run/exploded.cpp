#include "engine/run/exploded.hpp"

#include "engine/run/aggregate_shape.hpp"

namespace spheroscope {
namespace {

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
    const Vec3 middle = aggregate_centre_um(snapshot);
    const auto n_cells = static_cast<std::size_t>(snapshot.header->n_cells);
    const std::size_t n_nodes = snapshot.x_um.size() / (3 * n_cells);
    for (std::size_t c = 0; c < n_cells; ++c) {
        const Vec3 shift = share * (cell_centre_um(snapshot, c) - middle);
        move(moved.x_um, c * n_nodes, n_nodes, shift);
        move(moved.centre_um, c, 1, shift);
    }
    return moved;
}

Vec3 shift_when_exploded_um(const Snapshot& snapshot, double share, int cell) {
    return share * (cell_centre_um(snapshot, static_cast<std::size_t>(cell)) -
                    aggregate_centre_um(snapshot));
}

}  // namespace spheroscope
