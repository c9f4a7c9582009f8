#pragma once

#include <span>
#include <string_view>
#include <variant>

namespace spheroscope {

struct Configuration;
struct MeasureInput;
class Workers;

/// Numbers of the whole aggregate at one time; NaN where undefined (then shown as 'undefined').
struct Totals {
    double contact_area_um2;
    double contact_fraction;
    double coordination_Z;
    double sigma_h_core_kPa;
    double sigma_h_rim_kPa;
    int n_core_cells;
    double R_th_um;
    double eps_YL_omega;
    double eps_YL_W;
    double sigma_h_core_by_volume_kPa;
    double sigma_h_mean_kPa;
    double sigma_h_size_kPa;
    double virial_defect;
    double virial_identity;
    double mean_pressure_kPa;
    double volume_error;
    double smallest_triangle;
    int n_flipped_triangles;
    int n_folds;
    double normal_speed_rms_um_per_s;
    double tangential_speed_max_um_per_s;
    double cell_speed_max_um_per_s;
    double energy_fJ;
    double dissipation_nN_um_per_s;
    double power_residual;
    double probe_way_um;
    double probe_force_nN;
    double hull_force_nN;
    double load_imbalance;
    double deepest_node_um;
};

/// One row of the table of totals: the file, `info`, `--json` and [expect] read it.
struct TotalsRow {
    std::string_view name;
    std::string_view unit;
    std::string_view description;
    std::variant<double Totals::*, int Totals::*> member;
};
[[nodiscard]] std::span<const TotalsRow> all_totals();
/// The row of that name; nullptr if there is none.
[[nodiscard]] const TotalsRow* find_total(std::string_view name);
[[nodiscard]] double value_of(const TotalsRow& row, const Totals& totals);

/// Everything that follows from one configuration. Energy, powers, virial_identity and the
/// numbers of a load are left undefined: the run knows them. So is deepest_node_um, which costs
/// more than all others. `at.geometry` holds triangles and volumes.
[[nodiscard]] Totals compute_totals(const MeasureInput& input);

/// Largest distance of a node that lies inside another cell from that cell's surface, um; 0 if none
/// does. Every node in contact may ask all triangles of its neighbour.
[[nodiscard]] double compute_deepest_node_um(const Configuration& at, Workers& workers);

}  // namespace spheroscope
