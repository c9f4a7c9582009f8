#include "engine/inspect/frame_system.hpp"

#include "engine/base/index.hpp"
#include "engine/stages/build.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace spheroscope::inspect {
namespace {

Vec3 point(const std::vector<float>& values, std::size_t i) {
    return {double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]}};
}

}  // namespace

FrameSystem::FrameSystem(std::shared_ptr<const RunHeader> header, std::vector<int> cells,
                         Detail detail)
    : header_(std::move(header)),
      first_scene_(scene::parse_scene(header_->resolved_scene, "the run's scene")),
      scene_(first_scene_), cells_(std::move(cells)), detail_(detail) {
    if (!scene_.contact)
        throw Error("the run's scene has no [contact]: its cells do not touch each other");
    if (scene_.held && detail_ == Detail::forces)
        throw Error(
            "the forces that [load.held] of the run's scene holds are not in its frames",
            "contacts can be looked at without --node, and extracted from the run that they "
            "come from");
    if (cells_.empty()) {
        cells_.resize(idx(header_->n_cells));
        std::iota(cells_.begin(), cells_.end(), 0);
    }
    use_mesh(header_->topology->n_nodes());
}

void FrameSystem::use_mesh(int n_nodes) {
    if (system_ && system_->model().n_nodes() == n_nodes) return;
    const bool as_frames = n_nodes == header_->topology->n_nodes();
    std::vector<double> radius_um;
    for (const int cell : cells_) radius_um.push_back(double{header_->radius_um[idx(cell)]});
    Model model =
        make_model(as_frames ? header_->topology : make_icosphere(n_nodes), std::move(radius_um),
                   scene_.cytosol ? scene_.cytosol->target_strain : 0.0);
    SystemParts parts = build_parts(scene_);
    if (detail_ == Detail::contacts) {
        parts.terms.clear();
        parts.wall = nullptr;
        parts.hull = nullptr;
        parts.probe = nullptr;
        parts.body_force = nullptr;
        parts.cytosol = nullptr;
        parts.frictions = {};
    }
    system_ = std::make_unique<System>(std::move(model), std::move(parts), 1,
                                       Need::triangles | Need::volumes);
}

void FrameSystem::use_changes(const std::vector<Change>& changes) {
    if (changes == changes_) return;
    scene_ = first_scene_;
    for (const Change& change : changes) apply_change(scene_, change);
    changes_ = changes;
    system_.reset();
}

void FrameSystem::load(SnapshotPtr frame) {
    if (frame->stage < 0 || frame->stage >= static_cast<int>(scene_.stages.size()))
        throw Error("frame " + std::to_string(frame->frame) + " is of stage " +
                    std::to_string(frame->stage) + ", the run's scene has " +
                    std::to_string(scene_.stages.size()));
    frame_ = std::move(frame);
    use_changes(frame_->changes ? *frame_->changes : std::vector<Change>());
    use_mesh(scene_.stages[idx(frame_->stage)].nodes);
    const std::vector<Vec3> x_um = positions_um();
    if (const auto trouble = system_->evaluate(x_um, volume_integrals_s(x_um),
                                               frame_->diagnostics.wall_radius_um, frame_->load))
        throw Error("frame " + std::to_string(frame_->frame) + ": " + trouble->text());
}

std::vector<Vec3> FrameSystem::positions_um() const {
    const Model& model = system_->model();
    const std::size_t n_shown = idx(header_->topology->n_nodes()), n = idx(model.n_nodes());
    std::vector<Vec3> x_um;
    x_um.reserve(model.n_all_nodes());
    for (const int cell : cells_) {
        const std::size_t first = idx(cell) * n_shown;
        for (std::size_t i = 0; i < n; ++i) x_um.push_back(point(frame_->x_um, first + i));
        if (n == n_shown) continue;
        // The finer mesh was scaled about its centroid to the volume of the coarser one
        // (model/prolongation.hpp): that is undone.
        Vec3 centroid = Vec3::Zero();
        for (std::size_t i = 0; i < n_shown; ++i) centroid += point(frame_->x_um, first + i);
        centroid /= static_cast<double>(n_shown);
        const std::span<Vec3> of_cell = std::span(x_um).last(n);
        const double scale = std::cbrt(double{frame_->volume_um3[idx(cell)]} /
                                       enclosed_volume(model.topology->triangles, of_cell));
        for (Vec3& node : of_cell) node = centroid + scale * (node - centroid);
    }
    return x_um;
}

std::vector<double> FrameSystem::volume_integrals_s(const std::vector<Vec3>& x_um) const {
    const Model& model = system_->model();
    std::vector<double> integrals_s(model.radius_um.size(), 0.0);
    const CytosolPressure* cytosol = system_->parts().cytosol;
    if (cytosol == nullptr || std::isinf(cytosol->T_I_s()) || cytosol->K_kPa() == 0.0)
        return integrals_s;
    for (int cell = 0; cell < model.n_cells(); ++cell) {
        // P of eqn (13), solved for its integral.
        const double target_um3 = model.target_volume_um3[idx(cell)];
        const double volume_um3 = enclosed_volume(
            model.topology->triangles, model.cell_nodes(std::span<const Vec3>(x_um), cell));
        const double strain = cytosol->is_exact() ? 0.0 : (volume_um3 - target_um3) / target_um3;
        const double without_integral_kPa = cytosol->offset_kPa(model, cell) +
                                            cytosol->parameters().extra_pressure_kPa -
                                            cytosol->K_kPa() * strain;
        const double pressure_kPa = double{frame_->pressure_kPa[idx(cell_of_run(cell))]};
        integrals_s[idx(cell)] =
            (without_integral_kPa - pressure_kPa) * cytosol->T_I_s() / cytosol->K_kPa();
    }
    return integrals_s;
}

std::vector<Vec3> solved_velocities_um_per_s(FrameSystem& frame) {
    constexpr double k_relative_residual = 1e-10;
    System& system = frame.system();
    std::vector<Vec3> v_um_per_s(system.model().n_all_nodes(), Vec3::Zero());
    if (!system.solve_friction(system.force_nN(), v_um_per_s, k_relative_residual).converged)
        throw Error("the velocities of frame " + std::to_string(frame.frame().frame) +
                        " could not be solved for",
                    "", ExitCode::not_converged);
    return v_um_per_s;
}

}  // namespace spheroscope::inspect
