#pragma once

#include <filesystem>
#include <string>

namespace spheroscope::render {

/// What is wrong with an MP4 as a file, "" if nothing: it is a row of boxes, each with its length
/// (ISO/IEC 14496-12), that ends with the file, with the one that says where the pictures are
/// ('moov'). A file that was cut short has no such end.
[[nodiscard]] std::string problem_of_mp4(const std::filesystem::path& path);

}  // namespace spheroscope::render
