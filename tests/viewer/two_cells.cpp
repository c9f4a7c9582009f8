#include "tests/viewer/two_cells.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace spheroscope::viewer {

namespace {

std::string scene_of_two_cells(double h0_um) {
    return "[cells]\narrangement = \"pair\"\nnodes = 162\nradius = \"8 um\"\n[medium]\n"
           "[contact]\nrepulsion_k = 1.0\nh0 = " +
           std::to_string(h0_um) + "\n[[stage]]\nkind = \"relax\"\nduration = 1.0\nevery = 0.5\n";
}

}  // namespace

std::shared_ptr<Snapshot> two_cells(double h0_um) {
    constexpr double radius_um = 8.0;
    auto header = std::make_shared<RunHeader>();
    header->topology = make_icosphere(162);
    header->n_cells = 2;
    header->scene_name = "two.toml";
    header->resolved_scene = scene_of_two_cells(h0_um);
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
