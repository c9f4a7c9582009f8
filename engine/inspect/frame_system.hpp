#pragma once

#include "engine/run/changes.hpp"
#include "engine/run/snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "engine/solve/system.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace spheroscope::inspect {

/// The system of a run at one of its frames, built again from what a snapshot holds: positions,
/// pressures (from which the controllers' integrals follow), the wall, and hull and probe.
/// Parameters that were changed during the run are those of the frame.
/// Positions are those of the snapshot, single precision; overlaps are right to some 1e-5 um.
///
/// Stages that are computed on a coarser mesh than their frames show are looked at on their own
/// mesh: the old nodes are among the shown ones.
class FrameSystem {
  public:
    enum class Detail {
        contacts,  ///< nothing but contacts: fast
        forces,    ///< every term and friction of the scene
    };

    /// cells: those that are looked at, ascending; empty: all. Throws Error when the scene of the
    /// run cannot be read or has no [contact].
    FrameSystem(std::shared_ptr<const RunHeader> header, std::vector<int> cells, Detail detail);

    /// Looks at this frame. Throws Error when it does not fit the scene or its forces are not
    /// finite.
    void load(SnapshotPtr frame);

    // Of the frame that was loaded last.
    [[nodiscard]] System& system() { return *system_; }
    [[nodiscard]] const System& system() const { return *system_; }
    [[nodiscard]] const Snapshot& frame() const { return *frame_; }
    [[nodiscard]] const ContactLaw& law() const { return *system_->parts().contact; }

    [[nodiscard]] const RunHeader& header() const { return *header_; }
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    /// Number of a cell in the run.
    [[nodiscard]] int cell_of_run(int cell) const { return cells_[static_cast<std::size_t>(cell)]; }
    [[nodiscard]] const std::vector<int>& cells() const { return cells_; }

  private:
    void use_mesh(int n_nodes);
    /// The scene as it had become by the frame.
    void use_changes(const std::vector<Change>& changes);
    [[nodiscard]] std::vector<Vec3> positions_um() const;
    [[nodiscard]] std::vector<double> volume_integrals_s(const std::vector<Vec3>& x_um) const;

    std::shared_ptr<const RunHeader> header_;
    scene::Scene first_scene_, scene_;  ///< at the start of the run, and by the loaded frame
    std::vector<Change> changes_;       ///< from the one to the other
    std::vector<int> cells_;
    Detail detail_;
    std::unique_ptr<System> system_;
    SnapshotPtr frame_;
};

/// The velocities [all nodes] that balance friction with the forces of the loaded frame (all
/// cells, Detail::forces): Gamma v = F. Throws Error when the solver does not converge.
[[nodiscard]] std::vector<Vec3> solved_velocities_um_per_s(FrameSystem& frame);

}  // namespace spheroscope::inspect
