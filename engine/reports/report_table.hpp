#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spheroscope::reports {

/// What a table shows where it has no number, and why.
struct Missing {
    std::string_view word;  ///< "-": there is nothing to measure; "failed"; "< ref"
    friend bool operator==(const Missing&, const Missing&) = default;
};
using TableCell = std::variant<Missing, double, std::int64_t, bool, std::string>;

/// Rows and columns of a report, once for people (aligned), once for other programs (CSV).
struct ReportTable {
    struct Column {
        std::string name;      ///< with its unit: "wall_s"
        bool is_shown = true;  ///< in the aligned table; the CSV has all columns
    };
    std::vector<Column> columns;
    std::vector<std::vector<TableCell>> rows;

    /// Numbers to the right, texts to the left, four digits.
    [[nodiscard]] std::string aligned_text() const;
    /// RFC 4180; every digit; what is missing stands as its word. `comments` come first, each line
    /// behind "# ".
    [[nodiscard]] std::string csv_text(const std::vector<std::string>& comments = {}) const;
};

}  // namespace spheroscope::reports
