// ffmpeg may end with success although the disk was full when it wrote the last of a movie.
#include "render/mp4_boxes.hpp"

#include <cstdint>
#include <fstream>
#include <system_error>

namespace spheroscope::render {
namespace {

/// The next n_bytes as a number, highest first.
std::uint64_t read_number(std::ifstream& file, int n_bytes) {
    std::uint64_t number = 0;
    for (int i = 0; i < n_bytes; ++i) number = number << 8 | (file.get() & 0xff);
    return number;
}

}  // namespace

std::string problem_of_mp4(const std::filesystem::path& path) {
    std::error_code failed;
    const std::uint64_t size = std::filesystem::file_size(path, failed);
    std::ifstream file(path, std::ios::binary);
    if (failed || !file) return "the file cannot be read";
    bool has_moov = false;
    for (std::uint64_t begin = 0; begin < size;) {
        file.seekg(static_cast<std::streamoff>(begin));
        std::uint64_t length = read_number(file, 4);
        std::string kind(4, '\0');
        file.read(kind.data(), 4);
        if (length == 1) length = read_number(file, 8);  // longer than 32 bits can say
        if (length == 0) length = size - begin;          // up to the end of the file
        if (!file || length < 8 || length > size - begin) return "the file was cut short";
        has_moov = has_moov || kind == "moov";
        begin += length;
    }
    return has_moov ? "" : "the file was cut short";
}

}  // namespace spheroscope::render
