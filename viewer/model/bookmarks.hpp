#pragma once

#include "viewer/model/view.hpp"

#include <string>
#include <vector>

namespace spheroscope::viewer {

/// A frame and a view that somebody wants to come back to.
struct Bookmark {
    std::string name;
    int frame = 0;
    ViewSettings view;
};

/// Reads the bookmarks of a run; none if the file is not there. Throws Error for a file that is
/// damaged, or was written by somebody else.
[[nodiscard]] std::vector<Bookmark> read_bookmarks(const std::string& path);
/// The file is complete or as it was before. Throws Error (environment) when it cannot be written.
void write_bookmarks(const std::string& path, const std::vector<Bookmark>& bookmarks);

/// "run.h5" -> "run.bookmarks.json".
[[nodiscard]] std::string bookmarks_path(const std::string& run_file);

}  // namespace spheroscope::viewer
