#include "engine/forces/compaction_wall.hpp"

#include "engine/forces/cell_stiffness.hpp"
#include "engine/forces/cell_view.hpp"
#include "engine/forces/parameter_check.hpp"

#include <utility>

namespace spheroscope {
namespace {

/// Calls visit(node, k a_i in nN/um, overlap in um, outward direction) for every node beyond it.
template <class Visit>
void for_each_overlap(const Configuration& at, int cell, double k_kPa_per_um, Visit visit) {
    if (at.wall_radius_um == 0.0) return;
    SPHEROSCOPE_ASSERT(at.wall_radius_um > 0.0, "a wall has a positive radius");
    const CellView view(at, cell);
    const double wall2 = at.wall_radius_um * at.wall_radius_um;
    for (int i = 0; i < view.mesh.n_nodes(); ++i) {
        if (view.x(i).squaredNorm() <= wall2) continue;
        const double distance = view.x(i).norm();
        const double area =
            view.R_um * view.R_um * view.model.unit_node_area[static_cast<std::size_t>(i)];
        const Vec3 outward = view.x(i) / distance;
        visit(i, k_kPa_per_um * area, distance - at.wall_radius_um, outward);
    }
}

}  // namespace

CompactionWall::CompactionWall(Loc loc, const CompactionWallParameters& parameters)
    : ForceTerm(std::move(loc)), parameters_(parameters) {
    want_positive(this->loc(), "the compaction wall's stiffness", parameters_.k_kPa_per_um,
                  "kPa/um");
}

void CompactionWall::add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const {
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int i, double k, double overlap, const Vec3& outward) {
                         at_node(F_nN, i) -= k * overlap * outward;
                     });
}

std::optional<double> CompactionWall::energy_fJ(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_overlap(
        at, cell, parameters_.k_kPa_per_um,
        [&](int, double k, double overlap, const Vec3&) { sum += 0.5 * k * overlap * overlap; });
    return sum;
}

double CompactionWall::load_nN(const Configuration& at, int cell) const {
    double sum = 0.0;
    for_each_overlap(at, cell, parameters_.k_kPa_per_um,
                     [&](int, double k, double overlap, const Vec3&) { sum += k * overlap; });
    return sum;
}

void CompactionWall::add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
    for_each_overlap(
        at, cell, parameters_.k_kPa_per_um,
        [&](int i, double k, double, const Vec3& outward) { K.nodes.emplace_back(i, k, outward); });
}

}  // namespace spheroscope
