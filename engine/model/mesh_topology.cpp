#include "engine/model/mesh_topology.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace spheroscope {
namespace {

using Triangle = MeshTopology::Triangle;

struct Surface {
    std::vector<Vec3> x;
    std::vector<Triangle> triangles;
};

Surface icosahedron() {
    const double g = std::numbers::phi;
    Surface s;
    s.x = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vec3& x : s.x) x.normalize();
    // Faces are the triples of mutually nearest corners; the winding follows from the centroid.
    const double edge2 = (s.x[0] - s.x[1]).squaredNorm();
    const auto joined = [&](int i, int j) {
        return std::abs((s.x[static_cast<std::size_t>(i)] - s.x[static_cast<std::size_t>(j)])
                            .squaredNorm() -
                        edge2) < 1e-9 * edge2;
    };
    for (int i = 0; i < 12; ++i)
        for (int j = i + 1; j < 12; ++j)
            for (int k = j + 1; k < 12; ++k) {
                if (!joined(i, j) || !joined(j, k) || !joined(i, k)) continue;
                const Vec3& a = s.x[static_cast<std::size_t>(i)];
                const Vec3& b = s.x[static_cast<std::size_t>(j)];
                const Vec3& c = s.x[static_cast<std::size_t>(k)];
                if (a.dot(b.cross(c)) > 0)
                    s.triangles.push_back({i, j, k});
                else
                    s.triangles.push_back({i, k, j});
            }
    return s;
}

Surface subdivide(const Surface& coarse) {
    Surface fine;
    fine.x = coarse.x;
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int i, int j) {
        const auto [it, is_new] =
            middle.try_emplace(std::minmax(i, j), static_cast<int>(fine.x.size()));
        if (is_new)
            fine.x.push_back(
                (coarse.x[static_cast<std::size_t>(i)] + coarse.x[static_cast<std::size_t>(j)])
                    .normalized());
        return it->second;
    };
    for (const auto& [i, j, k] : coarse.triangles) {
        const int ij = middle_of(i, j), jk = middle_of(j, k), ki = middle_of(k, i);
        fine.triangles.push_back({i, ij, ki});
        fine.triangles.push_back({j, jk, ij});
        fine.triangles.push_back({k, ki, jk});
        fine.triangles.push_back({ij, jk, ki});
    }
    return fine;
}

/// Lists of lists in one array: begin has n_lists + 1 entries, items of one list ascend.
void flatten(std::vector<std::vector<int>>& lists, std::vector<int>& begin,
             std::vector<int>& items) {
    begin.assign(1, 0);
    items.clear();
    for (std::vector<int>& list : lists) {
        std::sort(list.begin(), list.end());
        items.insert(items.end(), list.begin(), list.end());
        begin.push_back(static_cast<int>(items.size()));
    }
}

}  // namespace

double enclosed_volume(std::span<const Triangle> triangles, std::span<const Vec3> x_um) {
    if (x_um.empty()) return 0.0;
    // Measured from a node: with the world's origin far away the terms would cancel.
    const Vec3 origin = x_um[0];
    double six_volumes = 0.0;
    for (const auto& [i, j, k] : triangles)
        six_volumes += (x_um[static_cast<std::size_t>(i)] - origin)
                           .dot((x_um[static_cast<std::size_t>(j)] - origin)
                                    .cross(x_um[static_cast<std::size_t>(k)] - origin));
    return six_volumes / 6.0;
}

MeshTopology make_closed_topology(std::vector<Triangle> triangles, std::vector<Vec3> shape) {
    MeshTopology mesh;
    mesh.triangles = std::move(triangles);
    mesh.unit_shape = std::move(shape);
    struct HalfEdge {
        int triangle, opposite;
    };
    std::map<std::pair<int, int>, HalfEdge> half_edges;
    std::vector<std::vector<int>> neighbours(mesh.unit_shape.size());
    std::vector<std::vector<int>> around(mesh.unit_shape.size());
    for (int t = 0; t < mesh.n_triangles(); ++t) {
        const Triangle& nodes = mesh.triangles[static_cast<std::size_t>(t)];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const int i = nodes[corner], j = nodes[(corner + 1) % 3], k = nodes[(corner + 2) % 3];
            if (!half_edges.try_emplace({i, j}, HalfEdge{t, k}).second)
                throw Error("the surface runs twice along the edge " + std::to_string(i) + "-" +
                                std::to_string(j) + " in the same direction",
                            "its triangles must all be wound the same way and meet two by two");
            neighbours[static_cast<std::size_t>(i)].push_back(j);
            around[static_cast<std::size_t>(i)].push_back(t);
        }
    }
    for (const auto& [ij, left] : half_edges) {
        const auto [i, j] = ij;
        const auto right = half_edges.find({j, i});
        if (right == half_edges.end())
            throw Error("the surface is open at the edge " + std::to_string(i) + "-" +
                            std::to_string(j),
                        "a cell needs a closed surface");
        if (i < j)
            mesh.edges.push_back({i, j, left.opposite, right->second.opposite, left.triangle,
                                  right->second.triangle});
    }
    flatten(neighbours, mesh.neighbour_begin, mesh.neighbours);
    flatten(around, mesh.triangle_begin, mesh.node_triangles);
    return mesh;
}

std::shared_ptr<const MeshTopology> make_icosphere(int n_nodes) {
    Surface surface = icosahedron();
    int n_subdivisions = 0;
    while (static_cast<int>(surface.x.size()) < n_nodes) {
        surface = subdivide(surface);
        ++n_subdivisions;
    }
    SPHEROSCOPE_ASSERT(static_cast<int>(surface.x.size()) == n_nodes, std::to_string(n_nodes));
    const double volume = enclosed_volume(surface.triangles, surface.x);
    SPHEROSCOPE_ASSERT(volume > 0.0, "the icosphere must be wound outward");
    const double scale = std::cbrt(4.0 / 3.0 * std::numbers::pi / volume);
    for (Vec3& x : surface.x) x *= scale;
    MeshTopology mesh = make_closed_topology(std::move(surface.triangles), std::move(surface.x));
    mesh.n_subdivisions = n_subdivisions;
    return std::make_shared<const MeshTopology>(std::move(mesh));
}

}  // namespace spheroscope
