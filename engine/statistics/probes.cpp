#include "engine/statistics/probes.hpp"

#include "engine/base/index.hpp"
#include "engine/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::statistics {
namespace {

std::span<const Vec3> nodes_of(const Aggregate& aggregate, int cell) {
    const std::size_t n = idx(aggregate.topology->n_nodes());
    return std::span(aggregate.x_um).subspan(idx(cell) * n, n);
}

/// The ray from a point goes along (0.1234, 0.0567, 1), which no mesh is aligned with: this turns
/// it into the z axis.
Vec3 seen_along_ray(const Vec3& x) {
    return {x.x() - 0.1234 * x.z(), x.y() - 0.0567 * x.z(), x.z()};
}

/// Twice the area of the triangle (0, a, b) seen along z.
double cross_z(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Whether a closed surface encloses the point: a ray from there leaves it once more than it
/// enters.
bool encloses(const MeshTopology& mesh, std::span<const Vec3> x_um, const Vec3& point_um) {
    int winding = 0;
    for (const MeshTopology::Triangle& t : mesh.triangles) {
        const Vec3 a = seen_along_ray(x_um[idx(t[0])] - point_um);
        const Vec3 b = seen_along_ray(x_um[idx(t[1])] - point_um);
        const Vec3 c = seen_along_ray(x_um[idx(t[2])] - point_um);
        if (a.z() < 0.0 && b.z() < 0.0 && c.z() < 0.0) continue;
        const double u = cross_z(b, c), v = cross_z(c, a), w = cross_z(a, b);
        const bool counter_clockwise = u >= 0.0 && v >= 0.0 && w >= 0.0;
        const bool clockwise = u < 0.0 && v < 0.0 && w < 0.0;
        if (!counter_clockwise && !clockwise) continue;
        const bool is_ahead = (u * a.z() + v * b.z() + w * c.z() > 0.0) == counter_clockwise;
        if (is_ahead) winding += counter_clockwise ? 1 : -1;
    }
    return winding > 0;
}

}  // namespace

std::vector<Vec3> random_points_um(const Aggregate& aggregate, std::uint64_t seed, int n_inside) {
    const Random random(seed, static_cast<std::uint32_t>(RandomStream::probe));
    const int n = static_cast<int>(std::lround(n_inside * std::pow(k_probe_reach, 3)));
    std::vector<Vec3> at_um;
    at_um.reserve(idx(n));
    for (int i = 0; i < n; ++i) {
        const auto number = static_cast<std::uint64_t>(i);
        const double r = aggregate.R_th_um * k_probe_reach * std::cbrt(random.uniform(number, 0));
        const double z = 2.0 * random.uniform(number, 1) - 1.0;
        const double angle = 2.0 * std::numbers::pi * random.uniform(number, 2);
        const double across = std::sqrt(1.0 - z * z);
        at_um.emplace_back(aggregate.middle_um +
                           r * Vec3(across * std::cos(angle), across * std::sin(angle), z));
    }
    return at_um;
}

Probes random_probes(const Aggregate& aggregate, std::uint64_t seed, int n_inside) {
    Probes probes;
    probes.at_um = random_points_um(aggregate, seed, n_inside);
    probes.cell = cells_around(aggregate, probes.at_um);
    return probes;
}

std::vector<int> cells_around(const Aggregate& aggregate, std::span<const Vec3> points_um) {
    std::vector<double> extent_um;  // of a cell about its centre
    for (int cell = 0; cell < aggregate.n_cells(); ++cell) {
        double farthest = 0.0;
        for (const Vec3& x : nodes_of(aggregate, cell))
            farthest = std::max(farthest, (x - aggregate.centre_um[idx(cell)]).squaredNorm());
        extent_um.push_back(std::sqrt(farthest));
    }
    std::vector<int> around;
    around.reserve(points_um.size());
    for (const Vec3& point : points_um) {
        int found = -1;
        for (int cell = 0; cell < aggregate.n_cells() && found < 0; ++cell)
            if ((point - aggregate.centre_um[idx(cell)]).norm() <= extent_um[idx(cell)] &&
                encloses(*aggregate.topology, nodes_of(aggregate, cell), point))
                found = cell;
        around.push_back(found);
    }
    return around;
}

namespace {

double nearest_value(const Aggregate& aggregate, const Vec3& point_um,
                     std::span<const double> values) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t at = 0;
    for (std::size_t c = 0; c < values.size(); ++c) {
        const double distance2 = (point_um - aggregate.centre_um[c]).squaredNorm();
        if (distance2 < nearest) {
            nearest = distance2;
            at = c;
        }
    }
    return values[at];
}

double inverse_distance_value(const Aggregate& aggregate, const Vec3& point_um,
                              std::span<const double> values) {
    std::vector<std::pair<double, std::size_t>> by_distance;
    by_distance.reserve(values.size());
    for (std::size_t c = 0; c < values.size(); ++c)
        by_distance.emplace_back((point_um - aggregate.centre_um[c]).squaredNorm(), c);
    const std::size_t n = std::min(values.size(), idx(k_neighbours));
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(n),
                      by_distance.end());
    if (by_distance[0].first == 0.0) return values[by_distance[0].second];
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = 1.0 / by_distance[i].first;
        sum += weight * values[by_distance[i].second];
        weights += weight;
    }
    return sum / weights;
}

}  // namespace

std::vector<ProbeSample> sample_cells(const Aggregate& aggregate, const Probes& probes,
                                      std::span<const double> cell_values,
                                      Interpolation interpolation) {
    std::vector<ProbeSample> samples;
    for (std::size_t i = 0; i < probes.at_um.size(); ++i) {
        const Vec3& point = probes.at_um[i];
        const double r = (point - aggregate.middle_um).norm() / aggregate.R_th_um;
        if (r > 1.0 && probes.cell[i] < 0) continue;
        samples.push_back({r, interpolation == Interpolation::nearest_cell
                                  ? nearest_value(aggregate, point, cell_values)
                                  : inverse_distance_value(aggregate, point, cell_values)});
    }
    return samples;
}

}  // namespace spheroscope::statistics
