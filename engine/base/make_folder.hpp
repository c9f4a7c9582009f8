#pragma once

#include <filesystem>

namespace spheroscope {

/// Makes a folder for results, and those that it is in, unless they are there. Throws Error:
/// environment where the disk or its owner forbids it, usage where a file has the name.
void make_folder(const std::filesystem::path& folder);

}  // namespace spheroscope
