#include "render/layers/caption.hpp"

#include "render/text.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope::render {
namespace {

// All sizes in px of a picture with 720 rows.
constexpr double k_text = 20.0, k_line = 28.0, k_margin = 28.0;
/// Letters of 10 px can just be read.
constexpr double k_smallest_scale = 0.5;

/// The text in lines that have room; a word that is longer than one is shortened.
std::vector<std::string> broken(TextPainter& text, const std::string& words,
                                const TextPainter::Style& style, double width_px) {
    std::vector<std::string> lines(1);
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        const std::string word = words.substr(at, end - at);
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (lines.back().empty() || text.width(longer, style) <= width_px)
            lines.back() = longer;
        else
            lines.push_back(word);
        at = end + 1;
    }
    for (std::string& line : lines) line = shortened(text, line, style, width_px, Cut::middle);
    return lines;
}

}  // namespace

Image draw_caption(const std::vector<std::string>& lines, int width_px, int picture_height_px) {
    const double scale = std::max(k_smallest_scale, picture_height_px / 720.0);
    const TextPainter::Style style{scale * k_text, {90, 94, 102}};
    TextPainter text;
    std::vector<std::string> shown;
    for (const std::string& line : lines)
        for (std::string& part : broken(text, line, style, width_px - 2.0 * scale * k_margin))
            shown.push_back(std::move(part));
    const double height = scale * (k_line * static_cast<double>(shown.size()) + k_margin);
    Image image(width_px, 2 * static_cast<int>(std::ceil(0.5 * height)));
    double y = scale * k_text;
    for (const std::string& line : shown) {
        text.draw(image, scale * k_margin, y, line, style);
        y += scale * k_line;
    }
    return image;
}

}  // namespace spheroscope::render
