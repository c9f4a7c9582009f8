#pragma once

namespace spheroscope {

/// Numbers of the whole aggregate at one time; NaN where undefined (then shown as 'undefined').
struct Totals {
    double contact_fraction;      ///< 2 sum S_AB / sum S_A
    double coordination_Z;        ///< 2 n_links / n_cells
    double sigma_h_core_kPa;      ///< unweighted mean over core cells
    double sigma_h_rim_kPa;       ///< unweighted mean over the other cells
    int n_core_cells;
    double virial_defect;         ///< |sum V sigma_h| / sum V |sigma_h|
    double mean_pressure_kPa;
    double volume_error;          ///< max |V - V*| / V*
    double smallest_triangle;     ///< smallest area / mean area of its cell
    int n_flipped_triangles;
    int n_folds;                  ///< edges with n1 . n2 < -0.5
    double normal_speed_rms_um_per_s;
    double tangential_speed_max_um_per_s;
    double energy_fJ;             ///< stored energy of the conservative terms
    double dissipation_nN_um_per_s;  ///< v . Gamma v
    double power_residual;        ///< (dE/dt + v . Gamma v - work of walls and loads) / (v . Gamma v)
};

}  // namespace spheroscope
