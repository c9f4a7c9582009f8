#include "engine/run/run_state.hpp"

#include "engine/base/error.hpp"

#include <utility>

namespace spheroscope {
namespace {

std::vector<double> flat(const std::vector<Vec3>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const Vec3& v : vectors) values.insert(values.end(), {v.x(), v.y(), v.z()});
    return values;
}

std::vector<Vec3> unflat(const std::vector<double>& values) {
    std::vector<Vec3> vectors;
    vectors.reserve(values.size() / 3);
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
        vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
    return vectors;
}

/// Reads a named array of a checkpoint; says what is missing.
template <class T> const std::vector<T>& find(const std::map<std::string, std::vector<T>>& arrays,
                                              const std::string& name, std::size_t size_at_least) {
    const auto it = arrays.find(name);
    if (it == arrays.end() || it->second.size() < size_at_least)
        throw Error("the checkpoint has no '" + name + "', or it is too short",
                    "it was written by another version; start the run anew", ExitCode::usage);
    return it->second;
}

void save_load(const Load& load, CheckpointData& data) {
    const Probe& p = load.probe;
    if (!p.acts()) return;
    data.float64["probe"] = {p.radius_um,     p.force_nN,      p.friction_nN_s_per_um,
                             p.start_um.x(),  p.start_um.y(),  p.start_um.z(),
                             p.direction.x(), p.direction.y(), p.direction.z(),
                             p.way_um,        p.speed_um_per_s};
    std::vector<double>& planes = data.float64["hull_planes"];
    for (const Hull::Plane& plane : load.hull->planes)
        planes.insert(planes.end(),
                      {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset_um});
    data.float64["hull_vertices"] = flat(load.hull->vertex_um);
    std::vector<std::int64_t>& corners = data.int64["hull_triangles"];
    for (const auto& triangle : load.hull->triangle)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
}

Load load_of(const CheckpointData& data) {
    Load load;
    if (!data.float64.contains("probe")) return load;
    const auto& p = find(data.float64, "probe", 11);
    load.probe = {.radius_um = p[0],
                  .force_nN = p[1],
                  .friction_nN_s_per_um = p[2],
                  .start_um = Vec3(p[3], p[4], p[5]),
                  .direction = Vec3(p[6], p[7], p[8]),
                  .way_um = p[9],
                  .speed_um_per_s = p[10]};
    Hull hull;
    const auto& planes = find(data.float64, "hull_planes", 0);
    for (std::size_t i = 0; i + 3 < planes.size(); i += 4)
        hull.planes.push_back({Vec3(planes[i], planes[i + 1], planes[i + 2]), planes[i + 3]});
    hull.vertex_um = unflat(find(data.float64, "hull_vertices", 0));
    const auto& corners = find(data.int64, "hull_triangles", 0);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        hull.triangle.push_back({static_cast<int>(corners[i]), static_cast<int>(corners[i + 1]),
                                 static_cast<int>(corners[i + 2])});
    load.hull = std::make_shared<const Hull>(std::move(hull));
    return load;
}

}  // namespace

CheckpointData save(const RunState& run) {
    CheckpointData data;
    auto& f = data.float64;
    auto& i = data.int64;
    const State& s = run.state;
    f["x_um"] = flat(s.x_um);
    f["v_um_per_s"] = flat(s.v_um_per_s);
    f["volume_integral_s"] = s.volume_integral_s;
    f["radius_um"] = run.radius_um;
    save_load(s.load, data);
    f["state"] = {s.time_s,      s.next_dt_s,          s.wall.radius_um, s.wall.speed_um_per_s,
                  s.wall.time_s, s.fastest_rate_per_s, s.rate_time_s};
    f["stage_memory"] = {run.memory.start_s, run.memory.touching_wall_um};
    f["stage_samples"] = run.memory.samples;
    f["power_balance"] = {run.energy_fJ, run.dissipated_fJ, run.driven_fJ,
                          run.dissipation_nN_um_per_s};
    const Diagnostics& d = run.diagnostics;
    f["diagnostics"] = {d.dt_s,          d.force_residual_nN, d.force_balance_nN,
                        d.step_error_um, d.wall_radius_um,    d.wall_force_nN};
    const ApproachToRest::Memory& m = run.approach.memory;
    f["approach_to_rest"] = {m.dt_s, m.time_s[0], m.time_s[1], m.speed_um_per_s[0],
                             m.speed_um_per_s[1]};
    i["counters"] = {d.steps, d.rejected_steps, d.linear_iterations};
    i["schedule"] = {run.stage,
                     run.stage_has_begun ? 1 : 0,
                     run.outputs_in_stage,
                     run.frames,
                     s.has_velocity ? 1 : 0,
                     run.has_energy ? 1 : 0,
                     static_cast<std::int64_t>(run.end),
                     run.met_cap ? 1 : 0};
    const BeadPackingState& b = run.beads;
    f["bead_x"] = flat(b.x);
    f["bead_fire_velocity"] = flat(b.fire.velocity);
    f["bead_fire"] = {b.fire.dt, b.fire.mixing, b.largest_force};
    i["bead_schedule"] = {static_cast<std::int64_t>(b.phase), b.step, b.descent_step,
                          b.fire.n_downhill};
    return data;
}

RunState load_run_state(const CheckpointData& data) {
    RunState run;
    const auto& f = data.float64;
    const auto& i = data.int64;
    State& s = run.state;
    s.x_um = unflat(find(f, "x_um", 3));
    s.v_um_per_s = unflat(find(f, "v_um_per_s", 3));
    s.volume_integral_s = find(f, "volume_integral_s", 1);
    run.radius_um = find(f, "radius_um", 1);
    s.load = load_of(data);
    const auto& state = find(f, "state", 7);
    s.time_s = state[0];
    s.next_dt_s = state[1];
    s.wall = {state[2], state[3], state[4]};
    s.fastest_rate_per_s = state[5];
    s.rate_time_s = state[6];
    const auto& memory = find(f, "stage_memory", 2);
    run.memory.start_s = memory[0];
    run.memory.touching_wall_um = memory[1];
    run.memory.samples = find(f, "stage_samples", 0);
    const auto& power = find(f, "power_balance", 4);
    run.energy_fJ = power[0];
    run.dissipated_fJ = power[1];
    run.driven_fJ = power[2];
    run.dissipation_nN_um_per_s = power[3];
    Diagnostics& d = run.diagnostics;
    const auto& diagnostics = find(f, "diagnostics", 6);
    d.dt_s = diagnostics[0];
    d.force_residual_nN = diagnostics[1];
    d.force_balance_nN = diagnostics[2];
    d.step_error_um = diagnostics[3];
    d.wall_radius_um = diagnostics[4];
    d.wall_force_nN = diagnostics[5];
    const auto& approach = find(f, "approach_to_rest", 5);
    run.approach.memory = {approach[0], {approach[1], approach[2]}, {approach[3], approach[4]}};
    const auto& counters = find(i, "counters", 3);
    d.steps = counters[0];
    d.rejected_steps = counters[1];
    d.linear_iterations = counters[2];
    const auto& schedule = find(i, "schedule", 8);
    run.stage = static_cast<int>(schedule[0]);
    run.stage_has_begun = schedule[1] != 0;
    run.outputs_in_stage = schedule[2];
    run.frames = static_cast<int>(schedule[3]);
    s.has_velocity = schedule[4] != 0;
    run.has_energy = schedule[5] != 0;
    run.end = static_cast<StageEnd>(schedule[6]);
    run.met_cap = schedule[7] != 0;
    BeadPackingState& b = run.beads;
    b.x = unflat(find(f, "bead_x", 0));
    b.fire.velocity = unflat(find(f, "bead_fire_velocity", 0));
    const auto& fire = find(f, "bead_fire", 3);
    b.fire.dt = fire[0];
    b.fire.mixing = fire[1];
    b.largest_force = fire[2];
    const auto& beads = find(i, "bead_schedule", 4);
    b.phase = static_cast<PackingPhase>(beads[0]);
    b.step = static_cast<int>(beads[1]);
    b.descent_step = static_cast<int>(beads[2]);
    b.fire.n_downhill = static_cast<int>(beads[3]);
    return run;
}

}  // namespace spheroscope
