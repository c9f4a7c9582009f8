#pragma once

#include "engine/inspect/contact_history.hpp"
#include "engine/inspect/contact_report.hpp"
#include "engine/reports/report_table.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

// Contacts as tables, JSON and text, for the verb `inspect`.
namespace spheroscope::cli {

/// One row per contact: its cells, then the table of quantities.
[[nodiscard]] reports::ReportTable contacts_table(const std::vector<inspect::ContactSummary>& rows);
/// One row per frame.
[[nodiscard]] reports::ReportTable
history_table(const std::vector<inspect::ContactSummary>& history);
[[nodiscard]] reports::ReportTable events_table(const std::vector<inspect::ContactEvent>& events);
/// One row per polygon of the pressure map.
[[nodiscard]] reports::ReportTable map_table(const inspect::ContactReport& report);
[[nodiscard]] reports::ReportTable section_table(const inspect::ContactReport& report);
[[nodiscard]] reports::ReportTable node_table(const inspect::NodeForces& forces);

[[nodiscard]] nlohmann::json summary_json(const inspect::ContactSummary& summary);
[[nodiscard]] nlohmann::json report_json(const inspect::ContactReport& report);
[[nodiscard]] nlohmann::json node_json(const inspect::NodeForces& forces);
[[nodiscard]] nlohmann::json event_json(const inspect::ContactEvent& event);

/// The contact in words: numbers with units, plane, balance, section.
[[nodiscard]] std::string report_text(const inspect::ContactReport& report);
[[nodiscard]] std::string node_text(const inspect::NodeForces& forces);

}  // namespace spheroscope::cli
