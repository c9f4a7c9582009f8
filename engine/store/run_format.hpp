#pragma once

#include "engine/run/snapshot.hpp"
#include "engine/store/hdf5_file.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

// What the writer and the reader of a run must agree on (engine/store/README.md is the
// description).
namespace spheroscope::run_format {

/// Group of the error estimates: one group per measure in it.
constexpr const char* k_accuracy = "/accuracy";
constexpr const char* k_state_hash = "state_hash";  // attribute of the file, as text
/// Group of the hull of an indentation.
constexpr const char* k_hull = "/hull";

/// changes_text() of what was changed during the run. Absent: nothing was.
constexpr const char* k_changes = "/changes";

inline constexpr std::string_view k_format = "spheroscope run";
/// Goes up when a reader of the version before would misunderstand the file.
inline constexpr std::int64_t k_format_version = 1;

/// A column of /diagnostics: one number of the whole aggregate per frame.
struct Column {
    std::string_view name;
    std::string_view unit;
    std::string_view description;
    std::variant<double Totals::*, int Totals::*, double Diagnostics::*,
                 std::int64_t Diagnostics::*>
        member;
};
/// The table of totals, then the members of Diagnostics.
[[nodiscard]] std::span<const Column> columns();
[[nodiscard]] double column_value(const Column& column, const Snapshot& frame);
/// True for whole numbers; real numbers may be NaN, 'undefined'.
[[nodiscard]] bool is_count(const Column& column);
/// Precondition: a count's value is a whole number that fits.
void set_column_value(const Column& column, Snapshot& frame, double value);
[[nodiscard]] std::string column_path(const Column& column);  ///< "/diagnostics/dt"
[[nodiscard]] std::string step_path(int frame);               ///< "/steps/000012"

/// "/steps/000012/fields/sigma_nn"
[[nodiscard]] std::string field_path(int frame, std::string_view field);
/// Entries of the arrays at a place, all cells together.
[[nodiscard]] std::uint64_t n_entries(const RunHeader& header, Place place);
[[nodiscard]] std::string_view place_name(Place place);

/// Writes everything that does not change from frame to frame, with no frame yet.
void write_header(hdf5::File& file, const RunHeader& header);

/// Reads it back. The rows of `fields` come from the file, without `compute`, and live as long as
/// the result: so a file keeps the meaning that its numbers had when they were written. Throws
/// Error for a file that is not ours, newer than this program, or inconsistent.
[[nodiscard]] std::shared_ptr<const RunHeader> read_header(const hdf5::File& file);

}  // namespace spheroscope::run_format
