#pragma once

#include "engine/reports/mesh_ladder.hpp"
#include "engine/reports/plot.hpp"
#include "engine/reports/precision.hpp"
#include "engine/reports/report_table.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spheroscope::cli {

/// "finished", "failed", "time limit", "not run"
[[nodiscard]] std::string outcome_word(bool was_run, const reports::MeasuredRun& run);

[[nodiscard]] reports::ReportTable table_of(const reports::Precision& precision);
/// What was compared with, how good that is, and why runs failed; below the table.
[[nodiscard]] std::string notes_of(const reports::Precision& precision);
[[nodiscard]] nlohmann::json json_of(const reports::Precision& precision);
/// One panel for each error measure that has a number: error over wall time. Runs that failed are
/// crosses at the upper edge, and named in the caption.
[[nodiscard]] reports::Plot plot_of(const reports::Precision& precision, const std::string& title);

[[nodiscard]] reports::ReportTable table_of(const reports::MeshLadder& ladder);
[[nodiscard]] std::string notes_of(const reports::MeshLadder& ladder, int own_nodes);
[[nodiscard]] nlohmann::json json_of(const reports::MeshLadder& ladder, int own_nodes);
/// One panel for each measure with a limit: its difference to that over the nodes of a cell, and
/// the time error of the scene's own step on own_nodes beside it. No panel: no measure has one.
[[nodiscard]] reports::Plot plot_of(const reports::MeshLadder& ladder, int own_nodes,
                                    const std::string& title);

}  // namespace spheroscope::cli
