#include "engine/inspect/inspect_contact.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/index.hpp"
#include "engine/contact/triangle_pair.hpp"
#include "engine/forces/contact_variational.hpp"
#include "engine/stages/build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace spheroscope::inspect {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

Vec3 centre_of(const Snapshot& frame, int cell) {
    const std::size_t i = 3 * idx(cell);
    return {double{frame.centre_um[i]}, double{frame.centre_um[i + 1]},
            double{frame.centre_um[i + 2]}};
}

int coordination(const Snapshot& frame, int cell) {
    return static_cast<int>(
        std::count_if(frame.links.begin(), frame.links.end(), [&](const ContactLink& link) {
            return link.cell_a == cell || link.cell_b == cell;
        }));
}

bool is_seeding(const FrameSystem& frame) {
    return frame.scene().stages[idx(frame.frame().stage)].kind == scene::StageKind::anneal;
}

/// The contact in the system; nullptr where no two triangles act on each other.
const Contacts::Group* find_group(const FrameSystem& frame, const ContactKey& key) {
    for (const Contacts::Group& group : frame.system().contacts().groups)
        if (frame.cell_of_run(group.cell_a) == key.cell_a &&
            frame.cell_of_run(group.cell_b) == key.cell_b)
            return &group;
    return nullptr;
}

double area_um2(const Contacts::Group& group) {
    double sum = 0.0;
    for (const ContactPair& pair : group.pairs) sum += pair.area_um2;
    return sum;
}

/// A group with what readers of its pairs want to know.
struct Sides {
    const Contacts::Group& group;
    const Model& model;
    const Geometry& geometry;
    std::span<const Vec3> a_um, b_um;  // nodes

    Sides(const FrameSystem& frame, const Contacts::Group& g)
        : group(g), model(frame.system().model()), geometry(frame.system().geometry()) {
        const std::span<const Vec3> x_um = frame.system().configuration().x_um;
        a_um = model.cell_nodes(x_um, g.cell_a);
        b_um = model.cell_nodes(x_um, g.cell_b);
    }
    [[nodiscard]] const MeshTopology::Triangle& corners(int triangle) const {
        return model.topology->triangles[idx(triangle)];
    }
    [[nodiscard]] Vec3 normal(int cell, int triangle) const {
        return model.cell_triangles(std::span<const Vec3>(geometry.normal), cell)[idx(triangle)];
    }
    [[nodiscard]] double area(int cell, int triangle) const {
        return model.cell_triangles(std::span<const double>(geometry.area_um2),
                                    cell)[idx(triangle)];
    }
    [[nodiscard]] TriangleGeometry triangle(bool is_a, int number) const {
        const std::span<const Vec3> x = is_a ? a_um : b_um;
        const auto& [i, j, k] = corners(number);
        return {{x[idx(i)], x[idx(j)], x[idx(k)]},
                normal(is_a ? group.cell_a : group.cell_b, number)};
    }
    /// Where a pair acts, half-way between the surfaces.
    [[nodiscard]] Vec3 middle_of(const ContactPair& pair) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            sum += 0.5 * (pair.lambda[i] * a_um[idx(corners(pair.triangle_a)[i])] +
                          pair.mu[i] * b_um[idx(corners(pair.triangle_b)[i])]);
        return sum;
    }
};

/// This contact's normal stress on the triangles of one cell, eqn (3).
std::vector<TriangleStress> stress_on(const Sides& sides, bool is_a) {
    const int cell = is_a ? sides.group.cell_a : sides.group.cell_b;
    std::map<int, double> force_nN;
    for (const ContactPair& pair : sides.group.pairs) {
        const int triangle = is_a ? pair.triangle_a : pair.triangle_b;
        const double sign = is_a ? 1.0 : -1.0;
        force_nN[triangle] +=
            sign * pair.force_nN() * pair.normal.dot(sides.normal(cell, triangle));
    }
    std::vector<TriangleStress> rows;
    for (const auto& [triangle, force] : force_nN)
        rows.push_back({triangle, force / sides.area(cell, triangle)});
    return rows;
}

struct Frame {  // of the contact plane
    Vec3 centre_um = Vec3::Zero(), normal = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();
};

/// Means over the area; u is the trace of the z axis in the plane, or of x where that is no better
/// than a point.
Frame plane_of(const Sides& sides) {
    Frame frame;
    double area = 0.0;
    for (const ContactPair& pair : sides.group.pairs) {
        frame.centre_um += pair.area_um2 * sides.middle_of(pair);
        frame.normal += pair.area_um2 * pair.normal;
        area += pair.area_um2;
    }
    frame.centre_um /= area;
    frame.normal.normalize();
    const Vec3 axis = std::abs(frame.normal.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
    frame.u = (axis - axis.dot(frame.normal) * frame.normal).normalized();
    frame.v = frame.normal.cross(frame.u);
    return frame;
}

ContactSummary summary_of(const FrameSystem& frame, const Contacts::Group& group) {
    const Sides sides(frame, group);
    const Snapshot& snapshot = frame.frame();
    ContactSummary s;
    s.key = {frame.cell_of_run(group.cell_a), frame.cell_of_run(group.cell_b)};
    s.frame = snapshot.frame;
    s.time_s = snapshot.time_s;
    s.is_seeding = is_seeding(frame);
    Vec3 force_nN = Vec3::Zero();
    for (const ContactPair& pair : group.pairs) {
        force_nN += pair.force_nN() * pair.normal;
        s.area_um2 += pair.area_um2;
        s.mean_overlap_um += pair.area_um2 * double{pair.overlap_um};
        s.largest_overlap_um = std::max(s.largest_overlap_um, double{pair.largest_overlap_um});
    }
    s.mean_overlap_um /= s.area_um2;
    const double h0_um = frame.law().h0_um;
    s.mean_overlap_h0 = s.mean_overlap_um / h0_um;
    s.largest_overlap_h0 = s.largest_overlap_um / h0_um;
    const Vec3 normal = plane_of(sides).normal;
    s.normal_force_nN = force_nN.dot(normal);
    s.shear_force_nN = (force_nN - s.normal_force_nN * normal).norm();
    s.centre_force_nN = force_nN.dot(
        (sides.geometry.centre_um[idx(group.cell_a)] - sides.geometry.centre_um[idx(group.cell_b)])
            .normalized());
    s.sigma_nn_low_kPa = std::numeric_limits<double>::infinity();
    s.sigma_nn_high_kPa = -s.sigma_nn_low_kPa;
    for (const bool is_a : {true, false})
        for (const TriangleStress& row : stress_on(sides, is_a)) {
            s.sigma_nn_low_kPa = std::min(s.sigma_nn_low_kPa, row.sigma_nn_kPa);
            s.sigma_nn_high_kPa = std::max(s.sigma_nn_high_kPa, row.sigma_nn_kPa);
        }
    s.exists = s.area_um2 > frame.scene().measures.touching_area_um2;
    s.Z_a = coordination(snapshot, s.key.cell_a);
    s.Z_b = coordination(snapshot, s.key.cell_b);
    return s;
}

/// Clip polygons of the law `traction`.
void add_clip_polygons(const Sides& sides, const ContactLaw& law, ContactReport& report) {
    const auto in_plane = [&](const ContactPolygon::Corner& corner) -> PlanePoint {
        const Vec3 r = corner.x_um - report.centre_um;
        return {r.dot(report.u), r.dot(report.v), corner.overlap_um,
                law.pressure_kPa(corner.overlap_um)};
    };
    for (const ContactPair& pair : sides.group.pairs) {
        MapPolygon row{pair.triangle_a,
                       pair.triangle_b,
                       pair.area_um2,
                       double{pair.overlap_um},
                       pair.force_nN() / pair.area_um2,
                       {},
                       {}};
        const ContactPolygon polygon = contact_polygon(sides.triangle(true, pair.triangle_a),
                                                       sides.triangle(false, pair.triangle_b), law);
        for (const auto& corner : polygon.corners) row.corners.push_back(in_plane(corner));
        for (const auto& corner : polygon.quadrature) row.quadrature.push_back(in_plane(corner));
        report.map.push_back(std::move(row));
    }
}

/// Triangles of cell A with means over the pairs of the law `variational`.
void add_triangles(const Sides& sides, const ContactLaw& law, ContactReport& report) {
    std::map<int, MapPolygon> rows;
    const auto in_plane = [&](const Vec3& x_um, double overlap_um) -> PlanePoint {
        const Vec3 r = x_um - report.centre_um;
        return {r.dot(report.u), r.dot(report.v), overlap_um, law.pressure_kPa(overlap_um)};
    };
    for (const ContactPair& pair : sides.group.pairs) {
        MapPolygon& row = rows[pair.triangle_a];
        row.triangle_a = pair.triangle_a;
        row.area_um2 += pair.area_um2;
        row.overlap_um += pair.area_um2 * double{pair.overlap_um};
        row.pressure_kPa += pair.force_nN();
        row.quadrature.push_back(in_plane(sides.middle_of(pair), double{pair.overlap_um}));
    }
    for (auto& [triangle, row] : rows) {
        row.overlap_um /= row.area_um2;
        row.pressure_kPa /= row.area_um2;
        for (const int node : sides.corners(triangle))
            row.corners.push_back(in_plane(sides.a_um[idx(node)], row.overlap_um));
        report.map.push_back(row);
    }
}

/// Where the line v = 0 passes through the polygon; empty where it does not.
std::vector<PlanePoint> crossings(const MapPolygon& polygon) {
    std::vector<PlanePoint> points;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        const PlanePoint& p = polygon.corners[i];
        const PlanePoint& q = polygon.corners[(i + 1) % polygon.corners.size()];
        if ((p.v_um > 0.0) == (q.v_um > 0.0)) continue;
        const double t = p.v_um / (p.v_um - q.v_um);
        const auto between = [t](double at_p, double at_q) { return at_p + t * (at_q - at_p); };
        points.push_back({between(p.u_um, q.u_um), 0.0, between(p.overlap_um, q.overlap_um),
                          between(p.pressure_kPa, q.pressure_kPa)});
    }
    return points;
}

void add_section(ContactReport& report) {
    for (const MapPolygon& polygon : report.map) {
        const std::vector<PlanePoint> ends = crossings(polygon);
        if (ends.size() != 2) continue;  // convex: two or none
        const bool in_order = ends[0].u_um < ends[1].u_um;
        const PlanePoint &low = ends[in_order ? 0 : 1], &high = ends[in_order ? 1 : 0];
        report.section.push_back({low.u_um, high.u_um, polygon.overlap_um, polygon.pressure_kPa,
                                  low.pressure_kPa, high.pressure_kPa});
    }
    std::sort(report.section.begin(), report.section.end(),
              [](const SectionPoint& p, const SectionPoint& q) {
                  return p.u_low_um + p.u_high_um < q.u_low_um + q.u_high_um;
              });
}

/// Adds every force of the contact on one node of one of its cells: f(is_a, node, force).
template <class F> void for_each_nodal_force(const FrameSystem& frame, const Sides& sides, F f) {
    for (const ContactPair& pair : sides.group.pairs)
        for (std::size_t i = 0; i < 3; ++i) {
            f(true, sides.corners(pair.triangle_a)[i], Vec3(pair.force_a_nN[i] * pair.normal));
            f(false, sides.corners(pair.triangle_b)[i], Vec3(-pair.force_b_nN[i] * pair.normal));
        }
    const Configuration at = frame.system().configuration();
    for (const bool is_a : {true, false})
        for (const ContactFilm& film : Contacts::films_of(sides.group, is_a)) {
            const auto force =
                film_forces_nN(at, is_a ? sides.group.cell_a : sides.group.cell_b, film);
            for (std::size_t i = 0; i < 3; ++i) f(is_a, sides.corners(film.triangle)[i], force[i]);
        }
}

Balance balance_of(const FrameSystem& frame, const Sides& sides, const Vec3& centre_um) {
    Balance balance;
    for_each_nodal_force(frame, sides, [&](bool is_a, int node, const Vec3& force_nN) {
        const Vec3 r = (is_a ? sides.a_um : sides.b_um)[idx(node)] - centre_um;
        (is_a ? balance.force_on_a_nN : balance.force_on_b_nN) += force_nN;
        balance.moment_sum_nN_um += r.cross(force_nN);
        balance.force_scale_nN += force_nN.norm();
        balance.moment_scale_nN_um += r.norm() * force_nN.norm();
    });
    balance.force_sum_nN = balance.force_on_a_nN + balance.force_on_b_nN;
    return balance;
}

[[noreturn]] void throw_no_contact(const FrameSystem& frame, const ContactKey& key) {
    std::string near;
    for (const ContactKey& other : nearest_contacts(frame.frame(), key, 4))
        near += (near.empty() ? "" : ", ") + other.text();
    throw Error("cells " + std::to_string(key.cell_a) + " and " + std::to_string(key.cell_b) +
                    " do not touch in frame " + std::to_string(frame.frame().frame),
                near.empty() ? "no cells touch in this frame" : "nearest contacts: " + near);
}

}  // namespace

double contact_reach_um(const RunHeader& header) {
    const SystemParts parts =
        build_parts(scene::parse_scene(header.resolved_scene, "the run's scene"));
    if (!parts.contact) return 0.0;
    // The law's overlap is that of surfaces that stand out by h0 each.
    const double farthest_um = 2.0 * parts.contact->h0_um;
    return std::max(farthest_um, parts.contact->largest_overlap_um - farthest_um);
}

void check_cells(const RunHeader& header, const ContactKey& key) {
    for (const int cell : {key.cell_a, key.cell_b})
        if (cell < 0 || cell >= header.n_cells)
            throw Error("there is no cell " + std::to_string(cell),
                        "the run has " + counted(header.n_cells, "cell") + ", counted from 0");
}

std::vector<ContactSummary> contacts_of(const FrameSystem& frame) {
    std::vector<ContactSummary> rows;
    for (const Contacts::Group& group : frame.system().contacts().groups)
        if (area_um2(group) > frame.scene().measures.touching_area_um2)
            rows.push_back(summary_of(frame, group));
    std::stable_sort(rows.begin(), rows.end(),
                     [](const ContactSummary& p, const ContactSummary& q) {
                         return std::abs(p.centre_force_nN) > std::abs(q.centre_force_nN);
                     });
    return rows;
}

ContactSummary summarize(const FrameSystem& frame, const ContactKey& key) {
    if (const Contacts::Group* group = find_group(frame, key)) return summary_of(frame, *group);
    ContactSummary s;
    s.key = key;
    s.frame = frame.frame().frame;
    s.time_s = frame.frame().time_s;
    s.is_seeding = is_seeding(frame);
    for (double* value : {&s.mean_overlap_um, &s.largest_overlap_um, &s.mean_overlap_h0,
                          &s.largest_overlap_h0, &s.sigma_nn_low_kPa, &s.sigma_nn_high_kPa})
        *value = k_nan;
    s.Z_a = coordination(frame.frame(), key.cell_a);
    s.Z_b = coordination(frame.frame(), key.cell_b);
    return s;
}

ContactReport inspect_contact(const FrameSystem& frame, const ContactKey& key) {
    check_cells(frame.header(), key);
    const Contacts::Group* group = find_group(frame, key);
    if (group == nullptr) throw_no_contact(frame, key);
    const Sides sides(frame, *group);
    const ContactLaw& law = frame.law();
    ContactReport report;
    report.summary = summary_of(frame, *group);
    report.law = law.form == ContactForm::variational ? "variational" : "traction";
    report.h0_um = law.h0_um;
    report.P0_kPa = law.P0_kPa;
    report.k_kPa_per_um = law.k_kPa_per_um;
    report.mesh_nodes = sides.model.n_nodes();
    const Frame plane = plane_of(sides);
    report.centre_um = plane.centre_um;
    report.normal = plane.normal;
    report.u = plane.u;
    report.v = plane.v;
    if (law.form == ContactForm::variational)
        add_triangles(sides, law, report);
    else
        add_clip_polygons(sides, law, report);
    add_section(report);
    for (const ContactPair& pair : group->pairs)
        report.largest_deviation_kPa = std::max(
            report.largest_deviation_kPa,
            std::abs(pair.force_nN() / pair.area_um2 - law.pressure_kPa(double{pair.overlap_um})));
    report.balance = balance_of(frame, sides, report.centre_um);
    report.on_a = stress_on(sides, true);
    report.on_b = stress_on(sides, false);
    return report;
}

std::vector<ContactKey> nearest_contacts(const Snapshot& frame, const ContactKey& key,
                                         int n_wanted) {
    const Vec3 a = centre_of(frame, key.cell_a), b = centre_of(frame, key.cell_b);
    std::vector<std::pair<double, ContactKey>> found;
    for (const ContactLink& link : frame.links) {
        const Vec3 p = centre_of(frame, link.cell_a), q = centre_of(frame, link.cell_b);
        const double distance_um =
            std::min((a - p).norm() + (b - q).norm(), (a - q).norm() + (b - p).norm());
        found.push_back({distance_um, {link.cell_a, link.cell_b}});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& p, const auto& q) { return p.first < q.first; });
    std::vector<ContactKey> keys;
    for (const auto& [distance_um, other] : found)
        if (static_cast<int>(keys.size()) < n_wanted) keys.push_back(other);
    return keys;
}

}  // namespace spheroscope::inspect
