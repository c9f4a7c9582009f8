#include "engine/base/whole_file.hpp"

#include <utility>

namespace spheroscope {

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), working_path_(path_) {
    std::error_code ignored;  // opening it says what is wrong
    const bool has_another_name = !std::filesystem::exists(path_, ignored) ||
                                  std::filesystem::is_regular_file(path_, ignored);
    if (has_another_name) working_path_ += ".partial";
}

WholeFile::~WholeFile() {
    std::error_code ignored;
    if (working_path_ != path_) std::filesystem::remove(working_path_, ignored);
}

std::error_code WholeFile::publish() {
    std::error_code failed;
    if (working_path_ == path_) return failed;
    std::filesystem::rename(working_path_, path_, failed);
    if (!failed) working_path_ = path_;
    return failed;
}

}  // namespace spheroscope
