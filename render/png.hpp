#pragma once

#include "render/image.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace spheroscope::render {

/// Words that travel inside a picture's file: key -> UTF-8 text. Keys have 1 to 79 ASCII
/// characters.
using PngTexts = std::map<std::string, std::string>;

/// Writes a PNG that is complete or absent: under a temporary name in the same folder, then
/// renamed. Throws Error when it cannot be written.
void write_png(const std::filesystem::path& path, const Image& image, const PngTexts& texts = {});

struct PngFile {
    Image image;
    PngTexts texts;
};
/// Reads an 8-bit PNG of any colour type (transparency is put on white). Throws Error when the file
/// is missing, is no PNG, is damaged, or has 16 bits a channel.
[[nodiscard]] PngFile read_png(const std::filesystem::path& path);

/// Only the texts that stand before the pixels; fast.
[[nodiscard]] PngTexts read_png_texts(const std::filesystem::path& path);

}  // namespace spheroscope::render
