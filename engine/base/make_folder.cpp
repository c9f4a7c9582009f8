#include "engine/base/make_folder.hpp"

#include "engine/base/error.hpp"

#include <system_error>

namespace spheroscope {

void make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (!failed) return;
    const bool is_a_file = failed == std::errc::not_a_directory || failed == std::errc::file_exists;
    throw Error(folder.string() + ": cannot make this folder (" + failed.message() + ")",
                is_a_file ? "a file has this name; choose another one with -o"
                          : "is the disk full, or the folder protected? -o chooses another one",
                is_a_file ? ExitCode::usage : ExitCode::environment);
}

}  // namespace spheroscope
