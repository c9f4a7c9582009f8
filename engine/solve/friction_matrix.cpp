#include "engine/solve/friction_matrix.hpp"

#include "engine/friction/drag.hpp"

namespace spheroscope {

std::vector<double> node_drags(const Model& model, double eta_f_kPa_s) {
    std::vector<double> drags;
    drags.reserve(model.n_all_nodes());
    for (const double radius_um : model.radius_um)
        for (const double unit_area : model.unit_node_area)
            drags.push_back(node_drag_nN_s_per_um(eta_f_kPa_s, radius_um, unit_area));
    return drags;
}

}  // namespace spheroscope
