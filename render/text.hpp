#pragma once

#include "render/image.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace spheroscope::render {

enum class FontStyle { normal, bold };
/// Which point of the text's line stands at the given x.
enum class Anchor { left, middle, right };
/// `symbol`: "σ^c_nn" has a lowered nn below a raised c; either runs until a space, '(' or the
/// other mark.
enum class TextMode { plain, symbol };

/// Writes text into pictures: DejaVu Sans, which has Greek letters and superscripts, through
/// FreeType.
class TextPainter {
  public:
    /// Throws Error (ExitCode::environment) when the font files are missing.
    TextPainter();
    ~TextPainter();
    TextPainter(const TextPainter&) = delete;
    TextPainter& operator=(const TextPainter&) = delete;

    struct Style {
        double size_px = 22.0;  ///< of the em square; capitals are 0.73 of it high
        Rgb colour{38, 40, 44};
        FontStyle font = FontStyle::normal;
        TextMode mode = TextMode::plain;
        /// Width of a white edge about the letters, unseen on white.
        double halo_px = 0.0;
    };

    /// Width of the line of UTF-8 text, px. Throws Error for text that is not UTF-8.
    [[nodiscard]] double width(std::string_view text, const Style& style);
    /// Draws the line with its baseline at y. Parts outside the picture are cut off.
    void draw(Image& image, double x, double y_baseline, std::string_view text, const Style& style,
              Anchor anchor = Anchor::left);

  private:
    struct Hidden;
    double lay_out(Image* image, double x, double y, std::string_view text, const Style& style);
    void draw_halo(Image& image, double x, double y, std::string_view text, const Style& style);
    std::unique_ptr<Hidden> hidden_;
};

/// Where a text that is too long loses letters: names of runs often differ in their last word only.
enum class Cut { end, middle };
/// The words, or as many letters of them as have room beside a "…"; "" where two have none.
[[nodiscard]] std::string shortened(TextPainter& text, std::string_view words,
                                    const TextPainter::Style& style, double width_px,
                                    Cut cut = Cut::end);

}  // namespace spheroscope::render
