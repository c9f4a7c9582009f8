#pragma once

#include "engine/solve/system.hpp"

#include <span>
#include <vector>

namespace spheroscope {

/// The volume controller (13) in one linearly implicit stage of length h, all of it eliminated from
/// the equations of the nodes. With eps' = S.k/V* and I' = eps at the end of the stage,
///
///   (Gamma + h K + c S S^T) k = F - h (K/T_I) r S     k: the stage's velocity, S = dV/dx
///   c = (K T_d + K h + (K/T_I) h^2) / V*              r: what I' is without the stage's own motion
///   k_I = r + h S.k/V*                                the stage's rate of I
///
/// so that the controller costs one rank-one matrix per cell. A frozen integral has no K/T_I.
///
/// The exact controller is the same with the product (K/T_I) h replaced by a bulk modulus M that is
/// much larger than any stress of the cells: P falls by M eps of the end of the stage, so what is
/// left of eps is the change of P over M, in every step anew, and zero at rest. It is the
/// augmented Lagrangian method (Hestenes 1969) with one iteration per step. While a wall acts it
/// is not frozen: a constraint has no memory that could wind up.
class ImplicitVolume {
  public:
    /// For stages of length h from the configuration that the system holds.
    void set_up(const System& system, double h_s, bool freeze_integral);
    /// c [cells], or empty without a controller.
    [[nodiscard]] std::span<const double> coefficient() const { return coefficient_; }
    /// b -= h (K/T_I) r S. rate [cells]; nothing happens if the integral is frozen or absent.
    void add_pressure(const System& system, std::span<const double> rate, std::span<Vec3> b) const;
    /// rate [cells] += h S.k/V*; nothing happens if the integral is frozen or absent.
    void add_motion(const System& system, std::span<const Vec3> k_um_per_s,
                    std::span<double> rate) const;
    /// What the stage's rate of I is multiplied with in a step of dt: dt, but for the exact
    /// controller, whose I is no integral.
    [[nodiscard]] double integral_step_s(double dt_s) const {
        return exact_step_s_ > 0.0 ? exact_step_s_ : dt_s;
    }
    /// The integral is there and not frozen.
    [[nodiscard]] bool integral_moves() const { return integral_moves_; }

  private:
    double h_s_ = 0.0;
    double integral_kPa_ = 0.0;  // (K/T_I) h, or M
    double exact_step_s_ = 0.0;
    bool integral_moves_ = false;
    std::vector<double> coefficient_;
};

/// eps of all cells at the evaluation that the system holds [cells]; zero without a controller.
void volume_strains(const System& system, std::span<double> strain);

}  // namespace spheroscope
