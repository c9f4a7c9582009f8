#pragma once

#include "engine/measures/measure_input.hpp"
#include "tests/reference/made_up_cells.hpp"

namespace spheroscope::test {

/// Cells in their rest shapes with contacts that are written down, not found.
class MadeUpContacts {
  public:
    /// Cells of radius 5 um on 42 nodes at these centres.
    explicit MadeUpContacts(const std::vector<Vec3>& centres_um);

    /// A pair with forces f_i on the nodes of A (along +n) and g_k on those of B (along -n).
    struct Push {
        int cell_a, cell_b, triangle_a, triangle_b;
        Vec3 normal;  ///< from B to A
        std::array<double, 3> force_a_nN, force_b_nN;
        double area_um2 = 1.0;
    };
    /// Pairs must come in the order of their cells; computes geometry and indices.
    void set(const std::vector<Push>& pushes);

    [[nodiscard]] Configuration at() const {
        return {model, x_um, volume_integral_s, geometry, contacts};
    }
    /// Input with the cells' stress, velocities zero unless given.
    [[nodiscard]] MeasureInput input(const Configuration& configuration);

    Model model;
    std::vector<Vec3> x_um, v_um_per_s;
    std::vector<double> volume_integral_s, pressure_kPa;
    std::vector<Mat3> stress_kPa;
    Geometry geometry;
    Contacts contacts;
};

}  // namespace spheroscope::test
