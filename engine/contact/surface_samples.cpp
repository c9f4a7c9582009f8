#include "engine/contact/surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace spheroscope {
SurfaceSamples make_surface_samples(const MeshTopology& mesh, int parts_per_edge) {
    const int m = parts_per_edge;
    SurfaceSamples result;
    result.parts_per_edge = m;
    result.n_per_triangle = (m + 1) * (m + 2) / 2;

    // Row r has m + 1 - r samples; `at` is the first one's number plus the column.
    const auto at = [m](int row, int column) { return row * (2 * m + 3 - row) / 2 + column; };
    std::vector<std::array<int, 3>> multiples;  // of 1/m
    for (int row = 0; row <= m; ++row)
        for (int column = 0; column <= m - row; ++column)
            multiples.push_back({m - row - column, column, row});
    for (int row = 0; row < m; ++row)
        for (int column = 0; column < m - row; ++column) {
            result.parts.push_back({at(row, column), at(row, column + 1), at(row + 1, column)});
            if (column + 1 < m - row)
                result.parts.push_back(
                    {at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)});
        }
    for (const auto& [a, b, c] : multiples)
        result.local_weights.push_back({double(a) / m, double(b) / m, double(c) / m});

    // Triangles that share an edge or a node find the same sample by its nodes and multiples.
    using Place = std::array<std::pair<int, int>, 3>;
    std::map<Place, int> known;
    for (const MeshTopology::Triangle& nodes : mesh.triangles)
        for (std::size_t local = 0; local < multiples.size(); ++local) {
            Place place;
            for (std::size_t k = 0; k < 3; ++k) {
                const int multiple = multiples[local][k];
                place[k] = multiple > 0 ? std::pair(nodes[k], multiple) : std::pair(-1, 0);
            }
            std::sort(place.begin(), place.end());
            const auto [it, is_new] =
                known.try_emplace(place, static_cast<int>(result.samples.size()));
            if (is_new) result.samples.push_back({nodes, result.local_weights[local]});
            result.of_triangle.push_back(it->second);
        }
    return result;
}

int samples_per_edge(const Model& model, double h0_um) {
    const double sum =
        std::accumulate(model.unit_edge_length.begin(), model.unit_edge_length.end(), 0.0);
    const double edge_um = *std::max_element(model.radius_um.begin(), model.radius_um.end()) * sum /
                           static_cast<double>(model.unit_edge_length.size());
    return std::max(2, static_cast<int>(std::ceil(edge_um / (2.0 * h0_um))));
}

}  // namespace spheroscope
