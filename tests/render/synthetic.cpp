#include "tests/render/synthetic.hpp"

#include "engine/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheroscope::render::synthetic {

const Field k_node_field{"tension",
                         "γ_eff",
                         "nN/um",
                         "mN/m",
                         1.0,
                         Place::node,
                         RangeKind::magnitude,
                         "",
                         "Tension of a node.",
                         "test",
                         nullptr};
const Field k_triangle_field{"normal_stress",
                             "σ^c_nn",
                             "kPa",
                             "Pa",
                             1000.0,
                             Place::triangle,
                             RangeKind::signed_about_zero,
                             "no contact",
                             "Stress of a triangle.",
                             "test",
                             nullptr};
const Field k_cell_field{"mean_stress",
                         "σ_h",
                         "kPa",
                         "Pa",
                         1000.0,
                         Place::cell,
                         RangeKind::signed_about_zero,
                         "",
                         "Stress of a cell.",
                         "test",
                         nullptr};

namespace {

void store(std::vector<float>& array, std::size_t i, const Vec3& v) {
    for (int k = 0; k < 3; ++k)
        array[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(v[k]);
}

Vec3 load(const std::vector<float>& array, std::size_t i) {
    return {static_cast<double>(array[3 * i]), static_cast<double>(array[3 * i + 1]),
            static_cast<double>(array[3 * i + 2])};
}

/// Area-weighted node normals of all cells.
void compute_normals(Snapshot& snapshot) {
    const MeshTopology& topology = *snapshot.header->topology;
    const auto n_nodes = static_cast<std::size_t>(topology.n_nodes());
    for (std::size_t c = 0; c < static_cast<std::size_t>(snapshot.header->n_cells); ++c) {
        std::vector<Vec3> sum(n_nodes, Vec3::Zero());
        for (const MeshTopology::Triangle& t : topology.triangles) {
            const auto node = [&](int k) { return static_cast<std::size_t>(t[std::size_t(k)]); };
            const Vec3 x0 = load(snapshot.x_um, c * n_nodes + node(0));
            const Vec3 area = (load(snapshot.x_um, c * n_nodes + node(1)) - x0)
                                  .cross(load(snapshot.x_um, c * n_nodes + node(2)) - x0);
            for (int k = 0; k < 3; ++k) sum[node(k)] += area;
        }
        for (std::size_t i = 0; i < n_nodes; ++i)
            store(snapshot.normal, c * n_nodes + i, sum[i].normalized());
    }
}

std::vector<Vec3> packing(int n, double spacing_um) {
    const Random random(7, 1);
    std::vector<Vec3> points;
    for (int k = -6; k <= 6; ++k)
        for (int j = -6; j <= 6; ++j)
            for (int i = -6; i <= 6; ++i) {
                // hexagonal layers, every second one shifted
                const double odd_row = (j & 1) != 0 ? 0.5 : 0.0,
                             odd_layer = (k & 1) != 0 ? 1.0 : 0.0;
                Vec3 p(i + odd_row + 0.5 * odd_layer, 0.866 * j + 0.289 * odd_layer, 0.816 * k);
                const auto index = static_cast<std::uint64_t>(points.size());
                for (int a = 0; a < 3; ++a)
                    p[a] += 0.16 * (random.uniform(index, static_cast<std::uint32_t>(a)) - 0.5);
                points.push_back(spacing_um * p);
            }
    std::sort(points.begin(), points.end(),
              [](const Vec3& p, const Vec3& q) { return p.squaredNorm() < q.squaredNorm(); });
    points.resize(static_cast<std::size_t>(n));
    return points;
}

}  // namespace

std::shared_ptr<RunHeader> make_header(int n_cells, int n_nodes) {
    auto header = std::make_shared<RunHeader>();
    header->topology = make_icosphere(n_nodes);
    header->n_cells = n_cells;
    header->title = "Synthetic aggregate";
    header->scene_name = "synthetic.toml";
    header->resolved_scene = "title = \"Synthetic aggregate\"\n";
    header->seed = 42;
    header->version = "test";
    header->command_line = "spheroscope run synthetic.toml --seed 42";
    header->fields = {&k_node_field, &k_triangle_field, &k_cell_field};
    header->radius_um.assign(static_cast<std::size_t>(n_cells), 9.0F);
    return header;
}

std::shared_ptr<Snapshot> make_balls(std::shared_ptr<const RunHeader> header,
                                     const std::vector<Vec3>& centres_um, double radius_um) {
    auto snapshot = std::make_shared<Snapshot>();
    const MeshTopology& topology = *header->topology;
    const auto n_cells = centres_um.size();
    const auto n_nodes = static_cast<std::size_t>(topology.n_nodes());
    const auto n_triangles = static_cast<std::size_t>(topology.n_triangles());
    snapshot->header = header;
    snapshot->stage_name = "relax";
    snapshot->stage_progress = std::numeric_limits<double>::quiet_NaN();
    snapshot->totals.coordination_Z = std::numeric_limits<double>::quiet_NaN();
    snapshot->totals.contact_fraction = std::numeric_limits<double>::quiet_NaN();
    snapshot->x_um.resize(3 * n_cells * n_nodes);
    snapshot->normal.resize(3 * n_cells * n_nodes);
    snapshot->centre_um.resize(3 * n_cells);
    snapshot->pressure_kPa.assign(n_cells, 0.1F);
    snapshot->volume_um3.assign(n_cells, 3000.0F);
    for (std::size_t c = 0; c < n_cells; ++c) {
        store(snapshot->centre_um, c, centres_um[c]);
        for (std::size_t i = 0; i < n_nodes; ++i) {
            store(snapshot->x_um, c * n_nodes + i,
                  centres_um[c] + radius_um * topology.unit_shape[i]);
            store(snapshot->normal, c * n_nodes + i, topology.unit_shape[i].normalized());
        }
    }
    snapshot->fields = {std::vector<float>(n_cells * n_nodes, 0.0F),
                        std::vector<float>(n_cells * n_triangles, 0.0F),
                        std::vector<float>(n_cells, 0.0F)};
    return snapshot;
}

std::shared_ptr<Snapshot> make_aggregate(int n_cells, int n_nodes, double squeeze) {
    constexpr double radius_um = 9.0;
    const Random random(11, 2);
    const auto header = make_header(n_cells, n_nodes);
    const std::vector<Vec3> centres = packing(n_cells, 2.0 * radius_um * squeeze);
    auto snapshot = make_balls(header, centres, radius_um);
    snapshot->time_s = 12.4;
    const MeshTopology& topology = *header->topology;
    const auto n = static_cast<std::size_t>(n_nodes);
    const auto n_triangles = static_cast<std::size_t>(topology.n_triangles());
    std::vector<int> partner(centres.size() * n, -1);
    for (std::size_t a = 0; a < centres.size(); ++a)
        for (std::size_t b = 0; b < centres.size(); ++b) {
            const Vec3 d = centres[b] - centres[a];
            if (a == b || d.norm() > 1.96 * radius_um) continue;
            const Vec3 axis = d.normalized();
            const double half = 0.5 * d.norm() - 0.05;
            for (std::size_t i = a * n; i < (a + 1) * n; ++i) {
                const double beyond = (load(snapshot->x_um, i) - centres[a]).dot(axis) - half;
                if (beyond <= 0.0) continue;
                store(snapshot->x_um, i, load(snapshot->x_um, i) - beyond * axis);
                partner[i] = static_cast<int>(b);
            }
            if (a < b) {
                const auto pair = static_cast<std::uint64_t>(a * centres.size() + b);
                const double force =
                    2.0 * random.uniform(pair) * random.uniform(pair, 1) * 12.0 - 2.0;
                snapshot->links.push_back(
                    {static_cast<int>(a), static_cast<int>(b), static_cast<float>(force), 40.0F});
            }
        }
    compute_normals(*snapshot);
    const double extent = centres.back().norm() + radius_um;
    for (std::size_t a = 0; a < centres.size(); ++a) {
        const double depth = 1.0 - centres[a].norm() / extent;
        snapshot->fields[2][a] = static_cast<float>(0.06 - 0.16 * depth + 0.03 * random.normal(a));
        for (std::size_t i = a * n; i < (a + 1) * n; ++i)
            snapshot->fields[0][i] = static_cast<float>(0.5 + (partner[i] < 0 ? 0.08 : -0.14) +
                                                        0.02 * random.normal(i, 5));
        for (std::size_t t = 0; t < n_triangles; ++t) {
            const auto& nodes = topology.triangles[t];
            int b = partner[a * n + static_cast<std::size_t>(nodes[0])];
            for (const int node : nodes)
                if (partner[a * n + static_cast<std::size_t>(node)] < 0) b = -1;
            float value = std::numeric_limits<float>::quiet_NaN();
            if (b >= 0) {
                const Vec3 x = load(snapshot->x_um, a * n + static_cast<std::size_t>(nodes[0]));
                const double rim =
                    (x - 0.5 * (centres[a] + centres[static_cast<std::size_t>(b)])).norm() /
                    radius_um;
                value = static_cast<float>(-0.18 + 0.5 * rim * rim +
                                           0.02 * random.normal(a * n + t, 9));
            }
            snapshot->fields[1][a * n_triangles + t] = value;
        }
    }
    snapshot->totals.coordination_Z = 2.0 * static_cast<double>(snapshot->links.size()) / n_cells;
    snapshot->totals.contact_fraction = 0.61;
    return snapshot;
}

scene::Picture make_picture(const std::string& field) {
    scene::Picture picture;
    picture.field = field;
    picture.size_px = {640, 360};
    return picture;
}

}  // namespace spheroscope::render::synthetic
