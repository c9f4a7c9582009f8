#include "engine/contact/penetration.hpp"

#include "engine/base/index.hpp"
#include "engine/contact/closest_point.hpp"
#include "engine/contact/node_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope {
namespace {

/// A node may lie exactly above a node of the other cell (mirror images do), where a ray meets no
/// triangle's inside. What matters here is deeper than this by far.
const Vec3 k_beside_um(0.6180339887e-7, 0.4142135624e-7, 0.0);

/// The triangles of one cell, by the squares of a grid in x and y that they touch.
class Columns {
  public:
    Columns(const MeshTopology& mesh, std::span<const Vec3> x_um, const NodeBox& box)
        : mesh_(mesh), x_um_(x_um), low_(box.low) {
        n_ = std::max(1, static_cast<int>(std::sqrt(0.5 * mesh.n_triangles())));
        const Vec3 size = box.high - box.low;
        per_um_x_ = n_ / std::max(size.x(), 1e-12);
        per_um_y_ = n_ / std::max(size.y(), 1e-12);
        first_.assign(idx(n_ * n_ + 1), 0);
        // count, sum up, fill
        visit([&](int square, int) { ++first_[idx(square + 1)]; });
        for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
        triangles_.resize(idx(first_.back()));
        std::vector<int> next(first_.begin(), first_.end() - 1);
        visit([&](int square, int t) { triangles_[idx(next[idx(square)]++)] = t; });
    }

    /// Whether a ray from p along +z leaves the cell once more often than it enters it.
    [[nodiscard]] bool hold(const Vec3& point) const {
        const Vec3 p = point + k_beside_um;
        const int square =
            column(p.y(), low_.y(), per_um_y_) * n_ + column(p.x(), low_.x(), per_um_x_);
        int leaves = 0;
        for (int k = first_[idx(square)]; k < first_[idx(square + 1)]; ++k) {
            const MeshTopology::Triangle& t = mesh_.triangles[idx(triangles_[idx(k)])];
            const double a = side(t[1], t[2], p), b = side(t[2], t[0], p), c = side(t[0], t[1], p);
            const bool is_above = a >= 0.0 && b >= 0.0 && c >= 0.0;
            const bool is_below = a <= 0.0 && b <= 0.0 && c <= 0.0;
            const double sum = a + b + c;
            if ((!is_above && !is_below) || sum == 0.0) continue;
            const double z = (a * node(t[0]).z() + b * node(t[1]).z() + c * node(t[2]).z()) / sum;
            if (z > p.z()) leaves += is_above ? 1 : -1;
        }
        return leaves > 0;
    }

  private:
    [[nodiscard]] const Vec3& node(int i) const { return x_um_[idx(i)]; }
    [[nodiscard]] int column(double at, double low, double per_um) const {
        return std::clamp(static_cast<int>((at - low) * per_um), 0, n_ - 1);
    }
    /// Twice the area of (i, j, p) seen along -z; of (j, i, p) exactly minus that.
    [[nodiscard]] double side(int i, int j, const Vec3& p) const {
        const double sign = i < j ? 1.0 : -1.0;
        const Vec3 u = node(std::min(i, j)) - p, v = node(std::max(i, j)) - p;
        return sign * (u.x() * v.y() - u.y() * v.x());
    }
    template <class F> void visit(const F& f) const {
        for (int t = 0; t < mesh_.n_triangles(); ++t) {
            const MeshTopology::Triangle& k = mesh_.triangles[idx(t)];
            const Vec3 low = node(k[0]).cwiseMin(node(k[1])).cwiseMin(node(k[2]));
            const Vec3 high = node(k[0]).cwiseMax(node(k[1])).cwiseMax(node(k[2]));
            for (int y = column(low.y(), low_.y(), per_um_y_);
                 y <= column(high.y(), low_.y(), per_um_y_); ++y)
                for (int x = column(low.x(), low_.x(), per_um_x_);
                     x <= column(high.x(), low_.x(), per_um_x_); ++x)
                    f(y * n_ + x, t);
        }
    }

    const MeshTopology& mesh_;
    std::span<const Vec3> x_um_;
    Vec3 low_;
    int n_ = 0;
    double per_um_x_ = 0.0, per_um_y_ = 0.0;
    std::vector<int> first_, triangles_;
};

double distance_um(const Vec3& p, const MeshTopology& mesh, std::span<const Vec3> x_um) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const MeshTopology::Triangle& t : mesh.triangles) {
        const Vec3 &a = x_um[idx(t[0])], &b = x_um[idx(t[1])], &c = x_um[idx(t[2])];
        const auto w = closest_barycentric(p, a, b, c);
        nearest = std::min(nearest, (p - (w[0] * a + w[1] * b + w[2] * c)).norm());
    }
    return nearest;
}

}  // namespace

std::optional<Penetration> deepest_penetration(const Model& model, std::span<const Vec3> x_um,
                                               double limit_um, Workers& workers) {
    std::vector<NodeBox> boxes;
    for (int cell = 0; cell < model.n_cells(); ++cell)
        boxes.emplace_back(model.cell_nodes(x_um, cell));
    std::vector<Penetration> deepest(idx(model.n_cells()));  // in each cell
    const MeshTopology& mesh = *model.topology;
    workers.loop(model.n_cells(), [&](int other) {
        const std::span<const Vec3> surface = model.cell_nodes(x_um, other);
        const NodeBox& box = boxes[idx(other)];
        std::optional<Columns> columns;
        for (int cell = 0; cell < model.n_cells(); ++cell) {
            if (cell == other || !box.is_near(boxes[idx(cell)], -limit_um)) continue;
            const std::span<const Vec3> nodes = model.cell_nodes(x_um, cell);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const Vec3& p = nodes[i];
                if (!box.is_within(p, -limit_um)) continue;
                const bool is_near =
                    std::any_of(surface.begin(), surface.end(), [&](const Vec3& q) {
                        return (p - q).squaredNorm() <= limit_um * limit_um;
                    });
                if (is_near) continue;
                if (!columns) columns.emplace(mesh, surface, box);
                if (!columns->hold(p)) continue;
                const double depth_um = distance_um(p, mesh, surface);
                Penetration& found = deepest[idx(other)];
                if (depth_um > std::max(limit_um, found.depth_um))
                    found = {cell, static_cast<int>(i), other, depth_um};
            }
        }
    });
    const auto worst = std::max_element(
        deepest.begin(), deepest.end(),
        [](const Penetration& p, const Penetration& q) { return p.depth_um < q.depth_um; });
    if (worst == deepest.end() || worst->depth_um == 0.0) return {};
    return *worst;
}

}  // namespace spheroscope
