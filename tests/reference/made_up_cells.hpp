#pragma once

#include "engine/solve/method.hpp"
#include "engine/solve/system.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

// Cells and forces that tests of several folders put together without a scene file.
namespace spheroscope::test {

/// A part with no value is not in the run; the values to fill in are those of the paper's case A.
struct PartValues {
    std::optional<double> E_kPa;
    bool bending = false;  ///< needs E
    std::optional<double> gamma_nN_per_um;
    std::optional<double> K_kPa;
    double T_I_s = std::numeric_limits<double>::infinity();
    double T_d_s = 0.0;
    double extra_pressure_kPa = 0.0;
    bool exact_volume = false;  ///< needs K and a finite T_I, which are the unit of the multiplier
    double eta_kPa_s = 0.0;     ///< of the cortex; 0: no cortex friction
    double eta_f_kPa_s = 0.05;
    std::optional<ContactLaw> contact;
    std::optional<ContactFriction> contact_friction;
    Vec3 body_force_nN = Vec3::Zero();
};
inline constexpr double k_thickness_um = 0.2;

[[nodiscard]] SystemParts make_parts(const PartValues& values);

/// Everything that case A has: E 20, gamma 0.5, K 5 (proportional), eta 1, adhesion with W = 0.5.
[[nodiscard]] PartValues case_a_values();

/// k of every edge's spring, eqn (8), nN/um [n_edges].
[[nodiscard]] std::vector<double> springs_nN_per_um(const Model& model, double E_kPa);

/// The model with its mesh's nodes on the sphere of radius R itself (not scaled to the sphere's
/// volume), as the closed forms of single cells have it. V* is the volume of that polyhedron.
[[nodiscard]] Model model_with_nodes_on_sphere(int n_nodes, double R_um);

/// Rest shapes at these centres, each turned at random, with normal noise on the nodes, um [all
/// nodes].
[[nodiscard]] std::vector<Vec3> turned_cells(const Model& model, std::span<const Vec3> centres_um,
                                             std::uint64_t seed, double noise_um = 0.0);

/// Four cells of different size around a point, every one near every other.
struct Cluster {
    Model model;
    std::vector<Vec3> x_um;
};
/// overlap_um: of the spheres of neighbouring cells.
[[nodiscard]] Cluster make_cluster(int n_nodes, std::uint64_t seed, double overlap_um,
                                   double noise_um = 0.0);
/// Two cells one above the other, `overlap_um` deep in each other.
[[nodiscard]] Cluster make_doublet(int n_nodes, std::uint64_t seed, double R0_um, double R1_um,
                                   double overlap_um, double noise_um = 0.0);

/// The state of cells that have not moved yet.
[[nodiscard]] State state_at(const Model& model, std::vector<Vec3> x_um);

[[nodiscard]] Geometry geometry_of(const Model& model, std::span<const Vec3> x_um, Need needs);

/// Advances by steps of the method until this time; the last outcome. Stops at the first failure.
StepOutcome advance_until(Method& method, System& system, State& state, double time_s);

}  // namespace spheroscope::test
