#include "viewer/model/blame.hpp"

#include "engine/base/index.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::viewer {
namespace {

constexpr double k_none = std::numeric_limits<double>::infinity();

double volume_error(const Snapshot& snapshot, int cell) {
    const double radius = double{snapshot.header->radius_um[idx(cell)]};
    const double rest = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
    return std::abs(double{snapshot.volume_um3[idx(cell)]} / rest - 1.0);
}

int cell_of_worst_volume(const Snapshot& snapshot) {
    int worst = 0;
    for (int cell = 1; cell < snapshot.header->n_cells; ++cell)
        if (volume_error(snapshot, cell) > volume_error(snapshot, worst)) worst = cell;
    return worst;
}

struct TriangleOfCell {
    int cell, triangle;
};
/// Over the mean of its cell.
TriangleOfCell smallest_triangle(const Snapshot& snapshot) {
    const MeshTopology& mesh = *snapshot.header->topology;
    TriangleOfCell smallest{0, 0};
    double share = k_none;
    for (int cell = 0; cell < snapshot.header->n_cells; ++cell) {
        double area = k_none, sum = 0.0;
        int triangle = 0;
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const double a = triangle_area_um2(snapshot, cell, t);
            sum += a;
            if (a < area) {
                area = a;
                triangle = t;
            }
        }
        if (area / sum < share) {
            share = area / sum;
            smallest = {cell, triangle};
        }
    }
    return smallest;
}

/// Of this cell's contacts, or of all (-1): the one with the largest force; nullptr without any.
const ContactLink* strongest_contact(const Snapshot& snapshot, int cell) {
    const ContactLink* strongest = nullptr;
    for (const ContactLink& link : snapshot.links) {
        if (cell >= 0 && link.cell_a != cell && link.cell_b != cell) continue;
        if (strongest == nullptr || std::abs(link.force_nN) > std::abs(strongest->force_nN))
            strongest = &link;
    }
    return strongest;
}

}  // namespace

std::optional<Pick> blamed(const SeriesRow& row, const Snapshot& snapshot) {
    if (snapshot.header->n_cells == 0) return {};
    const bool by_triangle = row.series == Series::smallest_triangle ||
                             row.series == Series::flipped_triangles ||
                             row.series == Series::folded_edges;
    Pick found;
    if (by_triangle) {
        const TriangleOfCell at = smallest_triangle(snapshot);
        found = pick_triangle(snapshot, at.cell, at.triangle);
    } else if (row.series == Series::volume_error) {
        found = pick_triangle(snapshot, cell_of_worst_volume(snapshot), 0);
        found.other_cell = -1;  // that triangle is any
    }
    if (found.other_cell >= 0) return found;
    const ContactLink* contact = strongest_contact(snapshot, found.cell);
    if (contact == nullptr) return found.cell < 0 ? std::nullopt : std::optional<Pick>(found);
    const int cell = found.cell < 0 ? contact->cell_a : found.cell;
    const int other = contact->cell_a == cell ? contact->cell_b : contact->cell_a;
    if (by_triangle) {
        found.other_cell = other;  // the triangle is what is to be seen
        return found;
    }
    return pick_contact(snapshot, cell, other);
}

}  // namespace spheroscope::viewer
