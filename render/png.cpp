#include "render/png.hpp"

#include "engine/base/error.hpp"
#include "engine/base/whole_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>
#include <vector>

namespace spheroscope::render {

namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileCloser>;

// libpng reports through these; throwing through its C frames is safe here because Debian builds it
// with unwind tables, but not promised, so the message is kept and control returns by longjmp.
[[noreturn]] void keep_message(png_structp png, png_const_charp message) {
    *static_cast<std::string*>(png_get_error_ptr(png)) = message;
    png_longjmp(png, 1);
}
void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

/// libpng's state for writing. No object with a destructor may be made between setjmp and the last
/// call, so `write` gets everything ready-made.
class PngOutput {
  public:
    PngOutput()
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, keep_message,
                                       ignore_warning)),
          info_(png_create_info_struct(png_)) {}
    ~PngOutput() { png_destroy_write_struct(&png_, &info_); }
    PngOutput(const PngOutput&) = delete;
    PngOutput& operator=(const PngOutput&) = delete;

    [[nodiscard]] bool write(std::FILE* file, const Image& image, std::vector<png_text>& texts,
                             std::vector<png_bytep>& rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT: libpng's way of reporting
        png_init_io(png_, file);
        // Level 1 with one fixed filter takes a third of the time of libpng's own choice, for the
        // same size.
        png_set_compression_level(png_, 1);
        png_set_filter(png_, 0, PNG_FILTER_UP);
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(image.width),
                     static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
        png_write_info(png_, info_);
        png_write_image(png_, rows.data());
        png_write_end(png_, nullptr);
        return true;
    }
    [[nodiscard]] const std::string& message() const { return message_; }

  private:
    std::string message_;
    png_structp png_;
    png_infop info_;
};

class PngInput {
  public:
    PngInput()
        : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, keep_message,
                                      ignore_warning)),
          info_(png_create_info_struct(png_)) {}
    ~PngInput() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngInput(const PngInput&) = delete;
    PngInput& operator=(const PngInput&) = delete;

    [[nodiscard]] bool read_header(std::FILE* file) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT
        png_init_io(png_, file);
        // scenes are short; a text of many megabytes is not ours
        png_set_chunk_malloc_max(png_, 64U << 20U);
        png_read_info(png_, info_);
        return true;
    }
    [[nodiscard]] int bits_a_channel() const { return png_get_bit_depth(png_, info_); }
    /// After read_header. Makes every kind of PNG of up to 8 bits a channel RGB on white.
    [[nodiscard]] bool read_pixels(Image& image, std::vector<png_bytep>& rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT
        png_set_expand(png_);
        png_set_gray_to_rgb(png_);
        png_color_16 white{0, 255, 255, 255, 255};
        png_set_background(png_, &white, PNG_BACKGROUND_GAMMA_SCREEN, 0, 1.0);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        if (png_get_rowbytes(png_, info_) != 3 * static_cast<std::size_t>(image.width))
            png_error(png_, "unexpected length of a row");
        png_read_image(png_, rows.data());
        png_read_end(png_, nullptr);
        return true;
    }
    [[nodiscard]] int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
    [[nodiscard]] int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
    [[nodiscard]] PngTexts texts() const {
        png_textp list = nullptr;
        int n = 0;
        png_get_text(png_, info_, &list, &n);
        PngTexts found;
        for (int i = 0; i < n; ++i) found[list[i].key] = list[i].text;
        return found;
    }
    [[nodiscard]] const std::string& message() const { return message_; }

  private:
    std::string message_;
    png_structp png_;
    png_infop info_;
};

std::vector<png_bytep> row_pointers(Image& image) {
    std::vector<png_bytep> rows;
    for (int y = 0; y < image.height; ++y) rows.push_back(image.rgb.data() + image.offset(0, y));
    return rows;
}

File open_png(const std::filesystem::path& path) {
    File file(std::fopen(path.c_str(), "rb"));
    if (!file)
        throw Error("the picture " + path.string() + " cannot be opened: " + std::strerror(errno));
    return file;
}

Error damaged(const std::filesystem::path& path, const std::string& why) {
    return Error(path.string() + " is not a complete PNG picture: " + why);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, const PngTexts& texts) {
    WholeFile whole(path);
    const std::string what = "the picture " + path.string() + " cannot be written: ";
    const auto fail = [&](int error) {
        const std::string why = std::generic_category().message(error);
        // A path that cannot be is the caller's; everything else is the file system's.
        if (error == ENOENT || error == ENOTDIR || error == EISDIR || error == ENOTEMPTY)
            return Error(what + why);
        return Error(what + why, "is the disk full, or the folder protected?",
                     ExitCode::environment);
    };

    Image pixels = image;  // libpng wants rows that are not const
    std::vector<png_bytep> rows = row_pointers(pixels);
    PngTexts kept = texts;
    std::vector<png_text> png_texts;
    for (auto& [key, text] : kept) {
        png_text entry{};
        entry.compression =
            text.size() > 1024 ? PNG_ITXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_NONE;
        entry.key = const_cast<char*>(key.c_str());
        entry.text = text.data();
        entry.itxt_length = text.size();
        png_texts.push_back(entry);
    }

    File file(std::fopen(whole.working_path().c_str(), "wb"));
    if (!file) throw fail(errno);
    PngOutput output;
    errno = 0;
    if (!output.write(file.get(), pixels, png_texts, rows)) {
        if (std::ferror(file.get()) != 0) throw fail(errno != 0 ? errno : EIO);
        throw Error(what + output.message());
    }
    // Data can still be lost between our buffer and the disk (a full disk shows here).
    if (std::fflush(file.get()) != 0 || std::ferror(file.get()) != 0) throw fail(errno);
    file.reset();
    if (const std::error_code error = whole.publish()) throw fail(error.value());
}

PngFile read_png(const std::filesystem::path& path) {
    const File file = open_png(path);
    PngInput input;
    if (!input.read_header(file.get())) throw damaged(path, input.message());
    if (input.bits_a_channel() > 8)
        throw Error(fmt::format("{}: a picture of 8 bits a channel is wanted, got {}",
                                path.string(), input.bits_a_channel()),
                    "what is in the other bits would be lost");
    PngFile result{Image(input.width(), input.height()), input.texts()};
    std::vector<png_bytep> rows = row_pointers(result.image);
    if (!input.read_pixels(result.image, rows)) throw damaged(path, input.message());
    return result;
}

PngTexts read_png_texts(const std::filesystem::path& path) {
    const File file = open_png(path);
    PngInput input;
    if (!input.read_header(file.get())) throw damaged(path, input.message());
    return input.texts();
}

}  // namespace spheroscope::render
