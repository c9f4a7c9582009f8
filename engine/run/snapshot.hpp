#pragma once

#include "engine/measures/fields.hpp"
#include "engine/measures/totals.hpp"
#include "engine/model/load.hpp"
#include "engine/model/mesh_topology.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace spheroscope {

struct Change;

/// Everything about a run that does not change from frame to frame. Shared by all its snapshots.
struct RunHeader {
    std::shared_ptr<const MeshTopology> topology;
    int n_cells = 0;
    std::string title;           ///< scene title, shown in pictures
    std::string scene_name;      ///< file name without folder, "first_light.toml"
    std::string resolved_scene;  ///< the scene as resolved, TOML text
    std::uint64_t seed = 0;
    std::string version;  ///< program version with commit
    std::string command_line;
    /// Lane type and SIMD target of the contact kernel, "float, avx512"; empty without contacts.
    std::string contact_arithmetic;
    std::vector<const Field*> fields;  ///< the fields that each snapshot carries, in this order
    std::vector<float> radius_um;      ///< [n_cells] rest radius
};

/// One touching pair of cells, cell_a < cell_b.
struct ContactLink {
    int cell_a, cell_b;
    float force_nN;  ///< F_ab . n_ab: > 0 repulsion (compression), < 0 adhesion (tension)
    float area_um2;  ///< clip area, one-sided
};

/// How the engine got to this frame.
struct Diagnostics {
    std::int64_t steps = 0;  ///< accepted since the start of the run
    std::int64_t rejected_steps = 0;
    std::int64_t linear_iterations = 0;
    double dt_s = 0.0;               ///< last accepted step
    double force_residual_nN = 0.0;  ///< RMS nodal force of all terms
    double force_balance_nN = 0.0;   ///< |sum of all forces|
    double step_error_um = 0.0;      ///< last error estimate
    double wall_radius_um = 0.0;     ///< 0: no wall
    double wall_force_nN = 0.0;
};

/// One frame, immutable once published; float32, because it is for eyes and files. The engine's own
/// numbers are double and go to checkpoints.
struct Snapshot {
    std::shared_ptr<const RunHeader> header;
    int frame = 0;
    double time_s = 0.0;                     ///< model time; seeding happens at 0
    int stage = 0;                           ///< index of the stage in the scene
    std::string stage_name;                  ///< "anneal", "compact", ...
    double stage_progress = 0.0;             ///< 0..1 where the stage knows its end, else NaN
    std::vector<float> x_um;                 ///< [n_cells * n_nodes * 3]
    std::vector<float> normal;               ///< [n_cells * n_nodes * 3], outward unit node normals
    std::vector<std::vector<float>> fields;  ///< one array for each of header->fields
    std::vector<float> centre_um;            ///< [n_cells * 3]
    std::vector<float> pressure_kPa;         ///< [n_cells]
    std::vector<float> volume_um3;           ///< [n_cells]
    std::vector<ContactLink> links;
    Load load;  ///< hull and probe, if there are any
    /// What had changed in the header's scene by then, in the order in which it did; nullptr:
    /// nothing.
    std::shared_ptr<const std::vector<Change>> changes;
    Totals totals{};
    Diagnostics diagnostics;
};

using SnapshotPtr = std::shared_ptr<const Snapshot>;

}  // namespace spheroscope
