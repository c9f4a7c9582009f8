#include "tests/viewer/two_cells.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::viewer {

std::shared_ptr<Snapshot> two_cells() {
    constexpr double radius_um = 8.0;
    auto header = std::make_shared<RunHeader>();
    header->topology = make_icosphere(162);
    header->n_cells = 2;
    header->scene_name = "two.toml";
    header->fields = {find_field("sigma_h"), find_field("sigma_nn"), find_field("gamma_eff")};
    header->radius_um = {8.0F, 8.0F};
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->frame = 7;
    snapshot->time_s = 1.5;
    snapshot->stage_name = "relax";
    snapshot->fields.resize(3);
    snapshot->fields[0] = {-0.02F, 0.03F};
    for (int cell = 0; cell < 2; ++cell) {
        const Vec3 centre((cell == 0 ? -1.0 : 1.0) * radius_um, 0.0, 0.0);
        for (const Vec3& unit : header->topology->unit_shape) {
            const Vec3 x = centre + radius_um * unit;
            for (const double component : {x.x(), x.y(), x.z()})
                snapshot->x_um.push_back(static_cast<float>(component));
            snapshot->fields[2].push_back(static_cast<float>(snapshot->fields[2].size()));
        }
        for (const double component : {centre.x(), centre.y(), centre.z()})
            snapshot->centre_um.push_back(static_cast<float>(component));
        snapshot->pressure_kPa.push_back(0.125F);
        snapshot->volume_um3.push_back(
            static_cast<float>(4.0 / 3.0 * std::numbers::pi * std::pow(radius_um, 3)));
    }
    snapshot->fields[1].assign(2 * static_cast<std::size_t>(header->topology->n_triangles()),
                               std::numeric_limits<float>::quiet_NaN());
    snapshot->fields[1][5] = 0.1F;
    snapshot->links = {{0, 1, 2.0F, 10.0F}};
    snapshot->header = header;
    return snapshot;
}

}  // namespace spheroscope::viewer
