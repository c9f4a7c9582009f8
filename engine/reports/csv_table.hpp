#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::reports {

/// A file that ReportTable::csv_text has written, read again.
class CsvTable {
  public:
    /// Throws Error with file and line for a file that cannot be read, has no columns, a row of
    /// another length than they, or a quotation without an end.
    explicit CsvTable(const std::string& path);

    [[nodiscard]] const std::vector<std::string>& comments() const { return comments_; }
    [[nodiscard]] std::size_t n_rows() const { return rows_.size(); }
    [[nodiscard]] bool has(std::string_view column) const;
    /// Throws Error when there is no such column.
    [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
    /// NaN where a word stands for what is missing ("-"). Throws Error for any other text.
    [[nodiscard]] double number(std::size_t row, std::string_view column) const;

  private:
    [[nodiscard]] std::size_t column(std::string_view name) const;

    std::string path_;
    std::vector<std::string> comments_, columns_;
    std::vector<std::vector<std::string>> rows_;
    std::vector<int> line_;  // [rows] of the file, from 1
};

/// "1.5" as 1.5, "-" as NaN; false for anything else.
[[nodiscard]] bool read_number(const std::string& text, double& value);

}  // namespace spheroscope::reports
