#pragma once

#include "engine/base/hash_text.hpp"
#include "engine/base/vec3.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/options.hpp"
#include "engine/cli/verb.hpp"
#include "engine/reports/report_table.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

// What the verbs that print reports have in common.
namespace spheroscope::cli {

/// Where a report goes: what -o says, or the standard.
[[nodiscard]] std::string report_place(const CommonOptions& options, const std::string& standard);
/// The same, and the folder is made.
[[nodiscard]] std::string report_folder(const CommonOptions& options, const std::string& standard);

/// Throws Error when the file to be written is the one that is read.
void refuse_own_input(const std::string& output, const std::string& input);

/// Throws Error (environment) when the text cannot be written.
void write_text_file(const std::string& path, const std::string& text);

/// Under which circumstances numbers were made: version, command, processor, and the threads, if
/// all numbers were made by as many (n_threads; 0: each says it itself, or none was used).
[[nodiscard]] std::vector<std::string> report_comments(const Invocation& invocation, int n_threads);
[[nodiscard]] nlohmann::json machine_json(const Invocation& invocation, int n_threads);

/// null where a number is missing or not finite: JSON has no word for it.
[[nodiscard]] nlohmann::json number_or_null(double value);

/// A vector as a list, and as "(x, y, z)".
[[nodiscard]] nlohmann::json vector_json(const Vec3& v);
[[nodiscard]] std::string vector_text(const Vec3& v);

/// Draws the plot, or says why there is none. Returns the names of the files.
[[nodiscard]] std::vector<std::string>
draw_report_plot(const reports::DrawPlot& draw, const reports::Plot& plot, const std::string& path);

}  // namespace spheroscope::cli
