#include "render/text.hpp"

#include "engine/base/error.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace spheroscope::render {

namespace {

Error no_font(const char* path) {
    return Error("the font file " + std::string(path) + " cannot be read",
                 "install DejaVu Sans (Debian: fonts-dejavu-core)", ExitCode::environment);
}

/// Code points of UTF-8 text. Titles of scenes get here, so bad bytes are the user's mistake.
std::vector<FT_ULong> decode_utf8(std::string_view text) {
    std::vector<FT_ULong> points;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i++]);
        const int n_more = lead < 0x80    ? 0
                           : lead >= 0xF0 ? 3
                           : lead >= 0xE0 ? 2
                           : lead >= 0xC0 ? 1
                                          : -1;
        FT_ULong point = n_more <= 0 ? lead : lead & (0x3FU >> n_more);
        bool good = n_more >= 0;
        for (int k = 0; good && k < n_more; ++k) {
            good = i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
            if (good) point = (point << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3FU);
        }
        if (!good) throw Error("text for a picture is not UTF-8: \"" + std::string(text) + "\"");
        points.push_back(point);
    }
    return points;
}

void blend_glyph(Image& image, const FT_Bitmap& bitmap, int left, int top, Rgb colour) {
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
        const int y = top + row;
        if (y < 0 || y >= image.height) continue;
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
            const int x = left + column;
            if (x < 0 || x >= image.width) continue;
            const int cover = bitmap.buffer[row * bitmap.pitch + column];
            if (cover > 0) image.set(x, y, mix(image.at(x, y), colour, cover / 255.0));
        }
    }
}

}  // namespace

struct TextPainter::Hidden {
    FT_Library library = nullptr;
    std::array<FT_Face, 2> faces{};

    ~Hidden() {
        for (FT_Face face : faces)
            if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }
};

TextPainter::TextPainter() : hidden_(std::make_unique<Hidden>()) {
    if (FT_Init_FreeType(&hidden_->library) != 0)
        throw Error("FreeType does not start", "", ExitCode::environment);
    constexpr std::array<const char*, 2> paths{SPHEROSCOPE_FONT, SPHEROSCOPE_FONT_BOLD};
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (FT_New_Face(hidden_->library, paths[i], 0, &hidden_->faces[i]) != 0)
            throw no_font(paths[i]);
}

TextPainter::~TextPainter() = default;

double TextPainter::lay_out(Image* image, double x, double y, std::string_view text,
                            const Style& style) {
    FT_Face face = hidden_->faces[style.font == FontStyle::bold ? 1 : 0];
    double pen = x;
    double lift = 0.0, scale = 1.0;
    double scripts_begin = x,
           widest = x;  // of the scripts behind one letter, which stand above each other
    FT_UInt previous = 0;
    const auto set_size = [&] {
        FT_Set_Char_Size(face, 0, std::lround(64.0 * scale * style.size_px), 72, 72);
    };
    set_size();
    for (const FT_ULong point : decode_utf8(text)) {
        if (style.mode == TextMode::symbol) {
            const bool opens = point == '_' || point == '^';
            const bool closes = scale != 1.0 && (point == ' ' || point == '(');
            if (opens && scale == 1.0) scripts_begin = widest = pen;
            if (opens || closes) {
                widest = std::max(widest, pen);
                pen = opens ? scripts_begin : widest;
                scale = opens ? 0.72 : 1.0;
                lift = opens ? (point == '_' ? -0.2 : 0.38) * style.size_px : 0.0;
                previous = 0;
                set_size();
            }
            if (opens) continue;
        }
        const FT_UInt glyph = FT_Get_Char_Index(face, point);
        if (previous != 0) {
            FT_Vector kerning{};
            FT_Get_Kerning(face, previous, glyph, FT_KERNING_UNFITTED, &kerning);
            pen += static_cast<double>(kerning.x) / 64.0;
        }
        // Not hinted: letters stand where they belong to a 64th of a pixel, in all sizes alike.
        const double whole = std::floor(pen);
        FT_Vector shift{std::lround(64.0 * (pen - whole)), 0};
        FT_Set_Transform(face, nullptr, &shift);
        if (FT_Load_Char(face, point, FT_LOAD_NO_HINTING | (image ? FT_LOAD_RENDER : 0)) != 0)
            throw Error("a letter of \"" + std::string(text) + "\" cannot be drawn", "",
                        ExitCode::environment);
        if (image != nullptr)
            blend_glyph(
                *image, face->glyph->bitmap, static_cast<int>(whole) + face->glyph->bitmap_left,
                static_cast<int>(std::lround(y - lift)) - face->glyph->bitmap_top, style.colour);
        pen += static_cast<double>(face->glyph->linearHoriAdvance) / 65536.0;
        previous = glyph;
    }
    return std::max(pen, widest) - x;
}

double TextPainter::width(std::string_view text, const Style& style) {
    return lay_out(nullptr, 0.0, 0.0, text, style);
}

void TextPainter::draw_halo(Image& image, double x, double y, std::string_view text,
                            const Style& style) {
    // The letters on a sheet of their own, at the same fractions of a pixel.
    const int reach = static_cast<int>(std::ceil(style.halo_px));
    const int left = static_cast<int>(std::floor(x)) - reach;
    const int top = static_cast<int>(std::floor(y - 1.2 * style.size_px)) - reach;
    Image sheet(static_cast<int>(std::ceil(width(text, style))) + 2 * reach + 2,
                static_cast<int>(std::ceil(1.6 * style.size_px)) + 2 * reach);
    Style black = style;
    black.colour = {0, 0, 0};
    lay_out(&sheet, x - left, y - top, text, black);
    // Every inked pixel whitens the disc around it.
    std::vector<std::array<int, 2>> disc;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx)
            if (dx * dx + dy * dy <= style.halo_px * style.halo_px) disc.push_back({dx, dy});
    std::vector<int> white(static_cast<std::size_t>(sheet.width) *
                           static_cast<std::size_t>(sheet.height));
    const auto at = [&](int column, int row) -> int& {
        return white[static_cast<std::size_t>(row) * static_cast<std::size_t>(sheet.width) +
                     static_cast<std::size_t>(column)];
    };
    for (int row = reach; row < sheet.height - reach; ++row)
        for (int column = reach; column < sheet.width - reach; ++column) {
            const int cover = 255 - sheet.at(column, row).r;
            if (cover == 0) continue;
            for (const auto& [dx, dy] : disc)
                at(column + dx, row + dy) = std::max(at(column + dx, row + dy), cover);
        }
    for (int row = 0; row < sheet.height; ++row)
        for (int column = 0; column < sheet.width; ++column) {
            const int px = left + column, py = top + row;
            if (at(column, row) == 0 || px < 0 || px >= image.width || py < 0 || py >= image.height)
                continue;
            image.set(px, py, mix(image.at(px, py), {255, 255, 255}, at(column, row) / 255.0));
        }
}

void TextPainter::draw(Image& image, double x, double y_baseline, std::string_view text,
                       const Style& style, Anchor anchor) {
    double start = x;
    if (anchor != Anchor::left) start -= width(text, style) * (anchor == Anchor::right ? 1.0 : 0.5);
    if (style.halo_px > 0.0) draw_halo(image, start, y_baseline, text, style);
    lay_out(&image, start, y_baseline, text, style);
}

std::string shortened(TextPainter& text, std::string_view words, const TextPainter::Style& style,
                      double width_px, Cut cut) {
    if (text.width(words, style) <= width_px) return std::string(words);
    std::vector<std::size_t> letters;  // where each begins, and the end
    for (std::size_t i = 0; i < words.size(); ++i)
        if ((static_cast<unsigned char>(words[i]) & 0xC0U) != 0x80U) letters.push_back(i);
    letters.push_back(words.size());
    for (std::size_t n = letters.size() - 2; n >= 2 && n < letters.size(); --n) {
        const std::size_t n_back = cut == Cut::middle ? n / 3 : 0;
        std::string kept(words.substr(0, letters[n - n_back]));
        kept += "…";
        kept += words.substr(letters[letters.size() - 1 - n_back]);
        if (text.width(kept, style) <= width_px) return kept;
    }
    return "";
}

}  // namespace spheroscope::render
