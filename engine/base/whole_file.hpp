#pragma once

#include <filesystem>
#include <system_error>

namespace spheroscope {

/// A file that is complete under its name or not there at all: it is written under another name and
/// gets its own when all of it is there. Until then a file that had the name before stays.
///
/// Something that is no file, such as /dev/stdout, has no other name and is written as it is.
///
/// (Files that change later are AtomicFile's, engine/store.)
class WholeFile {
  public:
    explicit WholeFile(std::filesystem::path path);
    /// Removes what was not published.
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Where to write: beside `path`, with the ending ".partial".
    [[nodiscard]] const std::filesystem::path& working_path() const { return working_path_; }
    /// Gives the file its name, when it was written and closed without an error.
    [[nodiscard]] std::error_code publish();

  private:
    std::filesystem::path path_, working_path_;
};

}  // namespace spheroscope
