#pragma once

#include "engine/base/vec3.hpp"

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// What there is to say about one contact, as plain values: for tables, files, pictures and panels.
namespace spheroscope::inspect {

/// A pair of cells, cell_a < cell_b.
struct ContactKey {
    int cell_a = 0, cell_b = 0;
    [[nodiscard]] std::string text() const;  ///< "17-42"
    friend bool operator==(const ContactKey&, const ContactKey&) = default;
};
/// Reads "17-42" or "42-17". Throws Error for anything else, and for a cell with itself.
[[nodiscard]] ContactKey parse_contact(const std::string& text);

/// The numbers of one contact in one frame; NaN where there is nothing to measure.
struct ContactSummary {
    ContactKey key;
    int frame = 0;
    double time_s = 0.0;
    bool is_seeding = false;       ///< beads are being packed: there is no mechanics yet
    bool exists = false;           ///< the area is above the scene's measures.touching_area
    double normal_force_nN = 0.0;  ///< along the contact normal, > 0: they push each other
    double shear_force_nN = 0.0;   ///< what is left of the force across that normal
    double centre_force_nN = 0.0;  ///< along the line of centres: the link of network and file
    double area_um2 = 0.0;         ///< one-sided
    double mean_overlap_um = 0.0;  ///< over the area
    double largest_overlap_um = 0.0;
    double mean_overlap_h0 = 0.0;  ///< over h0; at rest 1 or 2, as the scene reads omega
    double largest_overlap_h0 = 0.0;
    double sigma_nn_low_kPa = 0.0;   ///< of this contact alone on the triangles of both cells,
    double sigma_nn_high_kPa = 0.0;  ///< tension positive, eqn (3)
    int Z_a = 0, Z_b = 0;            ///< cells that either cell touches
};

/// One row of the table of these numbers: files, JSON and charts read it.
struct Quantity {
    std::string_view name;  ///< with its unit: "normal_force_nN"
    std::string_view unit;  ///< UTF-8, for labels
    std::string_view label;
    std::variant<double ContactSummary::*, int ContactSummary::*> member;
};
[[nodiscard]] std::span<const Quantity> all_quantities();
[[nodiscard]] double value_of(const Quantity& quantity, const ContactSummary& summary);

/// A point of the contact plane: u and v from the contact's centre, along ContactReport::u and v.
struct PlanePoint {
    double u_um, v_um;
    double overlap_um;
    double pressure_kPa;  ///< P(overlap) of the law
};

/// What is integrated over at once, in the contact plane. `traction`: the clip polygon of two
/// triangles. `variational`: a triangle of cell A with the means over it (its samples, as
/// `quadrature`).
struct MapPolygon {
    int triangle_a = 0, triangle_b = -1;  ///< b: -1 where it is not one
    double area_um2 = 0.0;                ///< as the run's contact kernel has it
    double overlap_um = 0.0;              ///< mean
    double pressure_kPa = 0.0;            ///< force over area, as the run's contact kernel has it
    std::vector<PlanePoint> corners, quadrature;
};

/// Where the line v = 0 crosses one polygon of the map.
struct SectionPoint {
    double u_low_um, u_high_um;
    double overlap_um;                 ///< the polygon's mean
    double pressure_kPa;               ///< the polygon's, from its force
    double law_low_kPa, law_high_kPa;  ///< P(overlap) at both ends
};

/// Sums over the contact's forces on the nodes of both cells: both vanish for a true pair force.
struct Balance {
    Vec3 force_on_a_nN = Vec3::Zero(), force_on_b_nN = Vec3::Zero();
    Vec3 force_sum_nN = Vec3::Zero();
    Vec3 moment_sum_nN_um = Vec3::Zero();  ///< about the contact's centre
    double force_scale_nN = 0.0;           ///< sum of |f|: what a sum that vanishes is relative to
    double moment_scale_nN_um = 0.0;       ///< sum of |x| |f|
};

/// This contact's normal stress on one triangle, tension positive.
struct TriangleStress {
    int triangle;
    double sigma_nn_kPa;
};

/// One contact, taken apart.
struct ContactReport {
    ContactSummary summary;
    std::string law;  ///< "traction" or "variational"
    double h0_um = 0.0, P0_kPa = 0.0, k_kPa_per_um = 0.0;
    int mesh_nodes = 0;             ///< of a cell's mesh that was computed on
    Vec3 centre_um = Vec3::Zero();  ///< mean over the area, half-way between the surfaces
    Vec3 normal = Vec3::UnitZ();    ///< mean over the area, from B to A
    Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
    std::vector<MapPolygon> map;         ///< ascending by triangles
    std::vector<SectionPoint> section;   ///< ascending by u
    double largest_deviation_kPa = 0.0;  ///< |P of a pair's force - P(overlap)|, largest
    Balance balance;
    std::vector<TriangleStress> on_a, on_b;  ///< touching triangles, ascending
};

/// Force of one term on one node.
struct NodeForce {
    std::string name;  ///< "cortex.elastic", "contact with cell 42", "friction: medium"
    Vec3 force_nN = Vec3::Zero();
};

/// Everything that acts on one node. Velocities are those that solve Gamma v = F in this
/// configuration, so the forces of the terms and of friction add up to zero but for the solver's
/// tolerance.
struct NodeForces {
    int cell = 0, node = 0;
    Vec3 x_um = Vec3::Zero(), v_um_per_s = Vec3::Zero();
    std::vector<NodeForce> terms, frictions;
    Vec3 drive_nN = Vec3::Zero();     ///< sum over the terms
    Vec3 residual_nN = Vec3::Zero();  ///< sum over both
    double scale_nN = 0.0;            ///< sum of |f| over both
};

}  // namespace spheroscope::inspect
