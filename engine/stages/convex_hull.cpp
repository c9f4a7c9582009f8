#include "engine/stages/convex_hull.hpp"

#include "engine/base/error.hpp"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace spheroscope {
namespace {

using Triangle = std::array<int, 3>;

/// One call of Qhull, whose memory lives as long as this. (Its C++ interface is no valid C++20.)
class QhullRun {
  public:
    explicit QhullRun(std::span<const Vec3> points_um) {
        for (const Vec3& x : points_um)
            coordinates_.insert(coordinates_.end(), {x.x(), x.y(), x.z()});
        char* text = nullptr;
        std::size_t size = 0;
        std::FILE* const log = open_memstream(&text, &size);
        qh_zero(&qh_, log);
        std::string command = "qhull Qt";  // facets are triangles
        const int failed = qh_new_qhull(&qh_, 3, static_cast<int>(points_um.size()),
                                        coordinates_.data(), 0, command.data(), log, log);
        std::fclose(log);
        qh_.ferr = qh_.qhmem.ferr = stderr;  // freeing memory still knows where to complain
        const std::string said(text, size);
        std::free(text);
        if (failed == 0) return;
        free_memory();
        throw Error("the nodes of the cells have no convex hull: " +
                        said.substr(0, said.find('\n')),
                    "are all cells where they should be?");
    }
    ~QhullRun() { free_memory(); }
    QhullRun(const QhullRun&) = delete;
    QhullRun& operator=(const QhullRun&) = delete;

    [[nodiscard]] const facetT* first_facet() const { return qh_.facet_list; }
    [[nodiscard]] Triangle corners(const facetT& facet) const {
        Triangle points{};
        for (std::size_t k = 0; k < 3; ++k)
            points[k] =
                qh_pointid(&qh_, static_cast<const vertexT*>(facet.vertices->e[k].p)->point);
        return points;
    }

  private:
    void free_memory() {
        int n_blocks = 0, n_bytes = 0;
        qh_freeqhull(&qh_, 0);
        qh_memfreeshort(&qh_, &n_blocks, &n_bytes);
    }
    std::vector<double> coordinates_;
    mutable qhT qh_{};  // its functions want it mutable, also those that only look
};

/// Qhull lists the corners of a facet in any order.
Triangle counter_clockwise(Triangle corners, const Vec3& normal, std::span<const Vec3> x) {
    const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(corners[k])]; };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(normal) < 0.0) std::swap(corners[1], corners[2]);
    return corners;
}

bool is_open(const Vec3& middle_um, const HullOpening& opening) {
    const Vec3 from_centre = middle_um - opening.centre_um;
    const double along_um = from_centre.dot(opening.towards);
    return along_um > 0.0 && (from_centre - along_um * opening.towards).norm() < opening.radius_um;
}

}  // namespace

Hull make_convex_hull(std::span<const Vec3> points_um, double gap_um, const HullOpening& opening) {
    const QhullRun run(points_um);
    Hull hull;
    std::map<int, int> vertex_of;  // by point: index in hull.vertex_um
    std::vector<Vec3> outward;     // of each vertex: sum of normals
    for (const facetT* facet = run.first_facet(); facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
        const Vec3 normal(facet->normal[0], facet->normal[1], facet->normal[2]);
        Triangle corners = run.corners(*facet);
        Vec3 middle_um = Vec3::Zero();
        for (const int point : corners)
            middle_um += points_um[static_cast<std::size_t>(point)] / 3.0;
        if (is_open(middle_um, opening)) continue;
        hull.planes.push_back({normal, gap_um - facet->offset});
        corners = counter_clockwise(corners, normal, points_um);
        for (int& point : corners) {
            const auto [place, is_new] =
                vertex_of.emplace(point, static_cast<int>(hull.vertex_um.size()));
            if (is_new) {
                hull.vertex_um.push_back(points_um[static_cast<std::size_t>(point)]);
                outward.emplace_back(Vec3::Zero());
            }
            point = place->second;
            outward[static_cast<std::size_t>(point)] += normal;
        }
        hull.triangle.push_back(corners);
    }
    for (std::size_t i = 0; i < outward.size(); ++i)
        hull.vertex_um[i] += gap_um * outward[i].normalized();
    return hull;
}

std::optional<PointOutside> find_outside(const Hull& hull, std::span<const Vec3> points_um) {
    PointOutside farthest{0, 0.0};
    double size_um = 0.0;
    for (const Hull::Plane& plane : hull.planes)
        size_um = std::max(size_um, std::abs(plane.offset_um));
    for (std::size_t i = 0; i < points_um.size(); ++i)
        for (const Hull::Plane& plane : hull.planes) {
            const double distance_um = plane.normal.dot(points_um[i]) - plane.offset_um;
            if (distance_um > farthest.distance_um) farthest = {i, distance_um};
        }
    // The corners lie on their planes but for rounding, 1e-16 of the coordinates.
    if (farthest.distance_um <= 1e-12 * size_um) return {};
    return farthest;
}

}  // namespace spheroscope
