#include "viewer/model/pick.hpp"

#include "engine/base/csv_word.hpp"
#include "engine/base/index.hpp"
#include "engine/inspect/inspect_contact.hpp"
#include "viewer/model/series.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

namespace spheroscope::viewer {
namespace {

constexpr double k_far = std::numeric_limits<double>::infinity();

Vec3 point(const std::vector<float>& values, std::size_t i) {
    return {double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]}};
}

struct Corners {
    Vec3 a, b, c;
};
Corners corners_of(const Snapshot& snapshot, int cell, int triangle) {
    const MeshTopology& mesh = *snapshot.header->topology;
    const auto at = [&](int k) {
        return point(snapshot.x_um,
                     idx(cell * mesh.n_nodes() + mesh.triangles[idx(triangle)][idx(k)]));
    };
    return {at(0), at(1), at(2)};
}

/// Signed distance along the line to the triangle; k_far if it is missed (Moeller and Trumbore
/// 1997). `direction` is a unit vector.
double distance_to(const Corners& t, const Vec3& origin, const Vec3& direction) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a;
    const Vec3 p = direction.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0.0) return k_far;
    const Vec3 s = origin - t.a;
    const double u = s.dot(p) / determinant;
    const Vec3 q = s.cross(ab);
    const double v = direction.dot(q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return k_far;
    return ac.dot(q) / determinant;
}

/// Distance of a cell's farthest node from its centre.
double reach_um(const Snapshot& snapshot, int cell) {
    const int n_nodes = snapshot.header->topology->n_nodes();
    const Vec3 centre = point(snapshot.centre_um, idx(cell));
    double reach2 = 0.0;
    for (int i = 0; i < n_nodes; ++i)
        reach2 = std::max(reach2,
                          (point(snapshot.x_um, idx(cell * n_nodes + i)) - centre).squaredNorm());
    return std::sqrt(reach2);
}

bool is_near_line(const Snapshot& snapshot, int cell, const Vec3& origin, const Vec3& direction) {
    const Vec3 to_centre = point(snapshot.centre_um, idx(cell)) - origin;
    const double aside2 =
        to_centre.squaredNorm() - to_centre.dot(direction) * to_centre.dot(direction);
    const double reach = reach_um(snapshot, cell);
    return aside2 <= reach * reach;
}

bool is_drawn(const Snapshot& snapshot, int cell, const Sight& sight) {
    const Vec3 centre = point(snapshot.centre_um, idx(cell));
    return !sight.cutaway || (centre - sight.middle_um).dot(sight.away_from_eye) >= 0.0;
}

/// The neighbour whose surface lies at the point, seen along the normal there, as near as surfaces
/// that act on each other can be; others are much farther.
int neighbour_at(const Snapshot& snapshot, int cell, const Vec3& at, const Vec3& normal) {
    int nearest = -1;
    if (snapshot.links.empty()) return nearest;
    double gap = inspect::contact_reach_um(*snapshot.header);
    for (const ContactLink& link : snapshot.links) {
        if (link.cell_a != cell && link.cell_b != cell) continue;
        const int other = link.cell_a == cell ? link.cell_b : link.cell_a;
        if (!is_near_line(snapshot, other, at, normal)) continue;
        for (int t = 0; t < snapshot.header->topology->n_triangles(); ++t) {
            const double d = std::abs(distance_to(corners_of(snapshot, other, t), at, normal));
            if (d < gap) {
                gap = d;
                nearest = other;
            }
        }
    }
    return nearest;
}

/// A point of a triangle, with the node that is nearest to it and the neighbour there.
Pick at_point(const Snapshot& snapshot, int cell, int triangle, const Vec3& at) {
    Pick found{cell, triangle, -1, -1, at};
    const Corners corners = corners_of(snapshot, cell, triangle);
    double node_distance2 = k_far;
    for (int k = 0; k < 3; ++k) {
        const Vec3 corner = k == 0 ? corners.a : k == 1 ? corners.b : corners.c;
        const double d2 = (corner - at).squaredNorm();
        if (d2 < node_distance2) {
            node_distance2 = d2;
            found.node = snapshot.header->topology->triangles[idx(triangle)][idx(k)];
        }
    }
    const Vec3 normal = (corners.b - corners.a).cross(corners.c - corners.a).normalized();
    found.other_cell = neighbour_at(snapshot, cell, at, normal);
    return found;
}

std::string number(double value) {
    return std::isnan(value) ? "undefined" : fmt::format("{:.5g}", value);
}

void add_position(std::vector<TableRow>& rows, const Vec3& x) {
    rows.push_back({"x", fmt::format("{:.4f}", x.x()), "µm"});
    rows.push_back({"y", fmt::format("{:.4f}", x.y()), "µm"});
    rows.push_back({"z", fmt::format("{:.4f}", x.z()), "µm"});
}

void add_fields(std::vector<TableRow>& rows, const Snapshot& snapshot, Place place,
                std::size_t entry) {
    if (!has_mechanics(snapshot.stage_name)) return;
    for (std::size_t f = 0; f < snapshot.fields.size(); ++f) {
        const Field& field = *snapshot.header->fields[f];
        if (field.place != place) continue;
        const double value = double{snapshot.fields[f][entry]} * field.shown_per_stored;
        rows.push_back({std::string(field.symbol),
                        std::isnan(value) ? std::string(field.absent) : number(value),
                        std::isnan(value) ? "" : std::string(field.shown_unit)});
    }
}

}  // namespace

Pick pick_triangle(const Snapshot& snapshot, int cell, int triangle) {
    const Corners corners = corners_of(snapshot, cell, triangle);
    return at_point(snapshot, cell, triangle, (corners.a + corners.b + corners.c) / 3.0);
}

Pick pick_contact(const Snapshot& snapshot, int cell, int other_cell) {
    const Vec3 other = point(snapshot.centre_um, idx(other_cell));
    int nearest = 0;
    double distance2 = k_far;
    for (int t = 0; t < snapshot.header->topology->n_triangles(); ++t) {
        const Corners corners = corners_of(snapshot, cell, t);
        const double d2 = ((corners.a + corners.b + corners.c) / 3.0 - other).squaredNorm();
        if (d2 < distance2) {
            distance2 = d2;
            nearest = t;
        }
    }
    Pick found = pick_triangle(snapshot, cell, nearest);
    found.other_cell = other_cell;
    return found;
}

double triangle_area_um2(const Snapshot& snapshot, int cell, int triangle) {
    const Corners corners = corners_of(snapshot, cell, triangle);
    return 0.5 * (corners.b - corners.a).cross(corners.c - corners.a).norm();
}

std::optional<Pick> pick(const Snapshot& snapshot, const Sight& sight) {
    const MeshTopology& mesh = *snapshot.header->topology;
    Pick found;
    double nearest = k_far;
    for (int cell = 0; cell < snapshot.header->n_cells; ++cell) {
        if (!is_drawn(snapshot, cell, sight) ||
            !is_near_line(snapshot, cell, sight.origin_um, sight.away_from_eye))
            continue;
        for (int t = 0; t < mesh.n_triangles(); ++t) {
            const double d =
                distance_to(corners_of(snapshot, cell, t), sight.origin_um, sight.away_from_eye);
            if (d < nearest) {
                nearest = d;
                found.cell = cell;
                found.triangle = t;
            }
        }
    }
    if (found.cell < 0) return {};
    return at_point(snapshot, found.cell, found.triangle,
                    sight.origin_um + nearest * sight.away_from_eye);
}

std::vector<TableRow> describe(const Snapshot& snapshot, const Pick& pick) {
    const MeshTopology& mesh = *snapshot.header->topology;
    const std::size_t cell = idx(pick.cell);
    const std::size_t node = idx(pick.cell * mesh.n_nodes() + pick.node);
    const std::size_t triangle = idx(pick.cell * mesh.n_triangles() + pick.triangle);
    std::vector<TableRow> rows;
    rows.push_back({fmt::format("node {}", pick.node), "", ""});
    add_position(rows, point(snapshot.x_um, node));
    add_fields(rows, snapshot, Place::node, node);

    rows.push_back({fmt::format("triangle {}", pick.triangle), "", ""});
    const Corners c = corners_of(snapshot, pick.cell, pick.triangle);
    rows.push_back({"area", number(0.5 * (c.b - c.a).cross(c.c - c.a).norm()), "µm²"});
    add_fields(rows, snapshot, Place::triangle, triangle);

    rows.push_back({fmt::format("cell {}", pick.cell), "", ""});
    add_position(rows, point(snapshot.centre_um, cell));
    rows.push_back({"rest radius", number(double{snapshot.header->radius_um[cell]}), "µm"});
    rows.push_back({"volume", number(double{snapshot.volume_um3[cell]}), "µm³"});
    if (!has_mechanics(snapshot.stage_name)) return rows;
    rows.push_back({"pressure", number(1e3 * double{snapshot.pressure_kPa[cell]}), "Pa"});
    add_fields(rows, snapshot, Place::cell, cell);

    for (const ContactLink& link : snapshot.links) {
        if (std::min(pick.cell, pick.other_cell) != link.cell_a ||
            std::max(pick.cell, pick.other_cell) != link.cell_b)
            continue;
        rows.push_back({fmt::format("contact {}-{}", link.cell_a, link.cell_b), "", ""});
        rows.push_back({link.force_nN >= 0.0F ? "force (pushes apart)" : "force (pulls together)",
                        number(double{link.force_nN}), "nN"});
        rows.push_back({"area", number(double{link.area_um2}), "µm²"});
        rows.push_back({"force / area", number(1e3 * double{link.force_nN / link.area_um2}), "Pa"});
    }
    return rows;
}

std::string csv_text(const Snapshot& snapshot, const std::vector<TableRow>& rows) {
    std::string text = fmt::format("# {}, frame {}, t = {} s\nof,quantity,value,unit\n",
                                   snapshot.header->scene_name, snapshot.frame, snapshot.time_s);
    std::string of;
    for (const TableRow& row : rows) {
        if (row.value.empty())
            of = row.what;
        else
            text += fmt::format("{},{},{},{}\n", csv_word(of), csv_word(row.what),
                                csv_word(row.value), csv_word(row.unit));
    }
    return text;
}

}  // namespace spheroscope::viewer
