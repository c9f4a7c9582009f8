#pragma once

#include "engine/run/snapshot.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace spheroscope::samples {

/// A run of made-up numbers: every array has its own, none is round, NaN where it is allowed.
[[nodiscard]] std::shared_ptr<const RunHeader> make_header(int n_cells = 2, int n_nodes = 42);
/// Frame `number` of that run. The number of contacts changes from frame to frame, beginning with
/// none.
[[nodiscard]] Snapshot make_frame(const std::shared_ptr<const RunHeader>& header, int number);

/// Compares everything, bit by bit (NaN equals NaN), as test expectations.
void expect_equal(const Snapshot& got, const Snapshot& wanted);
/// True if the frame has all bits of `wanted`.
[[nodiscard]] bool is_equal(const Snapshot& got, const Snapshot& wanted);
void expect_equal(const RunHeader& got, const RunHeader& wanted);

/// what() of the Error that `action` throws; "" if it throws none.
template <class F> std::string error_of(const F& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

/// An empty folder that goes away with the object.
class Folder {
  public:
    Folder();
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] std::string path() const { return path_.string(); }
    [[nodiscard]] std::string operator/(const std::string& name) const {
        return (path_ / name).string();
    }
    /// Names of the files inside, sorted, separated by spaces.
    [[nodiscard]] std::string list() const;

  private:
    std::filesystem::path path_;
};

[[nodiscard]] std::string read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace spheroscope::samples
