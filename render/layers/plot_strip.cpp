#include "render/layers/plot_strip.hpp"

#include "engine/base/error.hpp"
#include "render/canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheroscope::render {

namespace {

// All sizes in px of a strip of 180 rows, which is below a picture of 720.
constexpr double k_text = 20.0;
constexpr double k_left = 112.0, k_right = 40.0, k_top = 40.0, k_bottom = 38.0;  // of the axes
constexpr double k_between = 24.0;  // words that stand beside each other
constexpr double k_width = 480.0;   // in a narrower strip they shrink
/// Rows of the lowest strip: its letters are 12 px high, and a third of it is left for the curve.
constexpr int k_lowest = 108;

constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116}, k_line{214, 216, 220};
/// Okabe and Ito 2008: told apart with all kinds of colour vision.
constexpr std::array<Rgb, 2> k_colours{{{0, 114, 178}, {213, 94, 0}}};

/// Blends a disc over the picture; the edge is one pixel soft.
void fill_disc(Image& image, double x, double y, double radius, Rgb colour) {
    for (int v = static_cast<int>(y - radius) - 1; v <= static_cast<int>(y + radius) + 1; ++v)
        for (int u = static_cast<int>(x - radius) - 1; u <= static_cast<int>(x + radius) + 1; ++u) {
            if (u < 0 || v < 0 || u >= image.width || v >= image.height) continue;
            const double cover =
                std::clamp(radius + 0.5 - std::hypot(u + 0.5 - x, v + 0.5 - y), 0.0, 1.0);
            image.set(u, v, mix(image.at(u, v), colour, cover));
        }
}

/// A line of that width: discs close to each other would blend their edges twice, so each pixel is
/// blended once, by its distance from the line.
void draw_line(Image& image, PlotStripPainter::Point a, PlotStripPainter::Point b, double width,
               Rgb colour) {
    const double reach = 0.5 * width + 1.0;
    const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    const int first_x = std::max(0, static_cast<int>(std::min(a.x, b.x) - reach));
    const int last_x = std::min(image.width - 1, static_cast<int>(std::max(a.x, b.x) + reach));
    const int first_y = std::max(0, static_cast<int>(std::min(a.y, b.y) - reach));
    const int last_y = std::min(image.height - 1, static_cast<int>(std::max(a.y, b.y) + reach));
    for (int y = first_y; y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) {
            const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
            const double along =
                length2 > 0.0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
            const double away = std::hypot(px - along * dx, py - along * dy);
            const double cover = std::clamp(0.5 * width + 0.5 - away, 0.0, 1.0);
            if (cover > 0.0) image.set(x, y, mix(image.at(x, y), colour, cover));
        }
}

std::string number_text(double value) {
    return (value < 0.0 ? "\u2212" : "") + fmt::format("{:g}", std::abs(value));
}

/// Lowest and highest of the finite values of both runs, a little wider; never of no width.
Range span_of(const PlotStrip& strip, std::vector<double> PlotStrip::Curve::*values) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const PlotStrip::Curve& curve : strip.curves)
        for (std::size_t i = 0; i < (curve.*values).size(); ++i) {
            const double value = (curve.*values)[i];
            if (!std::isfinite(value)) continue;
            range.low = std::min(range.low, value);
            range.high = std::max(range.high, value);
        }
    if (!(range.low <= range.high)) return {0.0, 1.0};  // nothing finite: empty axes
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    // A curve that is constant but for rounding is a straight line, not noise.
    if (range.high - range.low <= 1e-9 * size || size == 0.0) {
        const double half = size > 0.0 ? 0.5 * size : 0.5;
        return {range.low - half, range.high + half};
    }
    return range;
}

}  // namespace

ShownUnit shown_unit(std::string_view stored_unit) {
    if (stored_unit == "1") return {"", 1.0};
    if (stored_unit == "kPa") return {"Pa", 1000.0};
    std::string text(stored_unit);
    const auto write = [&text](std::string_view ascii, std::string_view shown) {
        for (std::size_t at = text.find(ascii); at != std::string::npos;
             at = text.find(ascii, at + shown.size()))
            text.replace(at, ascii.size(), shown);
    };
    write("um", "µm");
    write("^2", "²");
    write("^3", "³");
    return {text, 1.0};
}

int PlotStripPainter::height_px(int picture_height_px) {
    return std::max(k_lowest, 2 * static_cast<int>(std::lround(picture_height_px / 8.0)));
}

Rgb PlotStripPainter::colour(int curve) const {
    return k_colours.at(static_cast<std::size_t>(curve));
}

PlotStripPainter::Point PlotStripPainter::point(double time_s, double value) const {
    return {left_ + (right_ - left_) * (time_s - time_low_) / (time_high_ - time_low_),
            bottom_ - (bottom_ - top_) * (value - value_low_) / (value_high_ - value_low_)};
}

PlotStripPainter::PlotStripPainter(const PlotStrip& strip, int width_px, int picture_height_px)
    : strip_(strip), background_(width_px, height_px(picture_height_px)),
      scale_(std::max(k_lowest / 180.0, std::min(background_.height / 180.0, width_px / k_width))) {
    SPHEROSCOPE_ASSERT(strip.curves.size() <= k_colours.size(), "a colour for each curve");
    const Range times = span_of(strip, &PlotStrip::Curve::time_s);
    const Range values = span_of(strip, &PlotStrip::Curve::value);
    time_low_ = times.low;
    time_high_ = times.high;
    const double margin = 0.06 * (values.high - values.low);
    value_low_ = values.low - margin;
    value_high_ = values.high + margin;
    left_ = scale_ * k_left;
    right_ = width_px - scale_ * k_right;
    top_ = scale_ * k_top;
    bottom_ = background_.height - scale_ * k_bottom;

    for (const PlotStrip::Curve& curve : strip.curves)
        has_values_ = has_values_ || std::any_of(curve.value.begin(), curve.value.end(),
                                                 [](double value) { return std::isfinite(value); });
    TextPainter text;
    draw_axes(text, values);
    draw_heading(text);
    if (!has_values_)
        text.draw(background_, 0.5 * (left_ + right_), 0.5 * (top_ + bottom_) + scale_ * 7.0,
                  "undefined in all frames",
                  {scale_ * k_text, k_soft_ink, FontStyle::normal, TextMode::plain},
                  Anchor::middle);
    for (std::size_t k = 0; k < strip.curves.size(); ++k) {
        const PlotStrip::Curve& curve = strip.curves[k];
        for (std::size_t i = 1; i < curve.value.size(); ++i)
            if (std::isfinite(curve.value[i - 1]) && std::isfinite(curve.value[i]))
                draw_line(background_, point(curve.time_s[i - 1], curve.value[i - 1]),
                          point(curve.time_s[i], curve.value[i]), scale_ * 2.0, k_colours[k]);
    }
}

void PlotStripPainter::draw_axes(TextPainter& text, const Range& values) {
    const auto scaled = [this](double px) { return scale_ * px; };
    const TextPainter::Style style{scaled(k_text), k_ink, FontStyle::normal, TextMode::plain};
    const double thin = std::max(1.0, scaled(1.0));
    const std::vector<double> value_ticks = has_values_ ? ticks(values) : std::vector<double>{};
    for (const double value : value_ticks)
        left_ = std::max(left_, text.width(number_text(value), style) + scaled(18.0));
    // In a narrow strip the curve needs the room of the numbers.
    const bool has_labels = right_ - left_ > 0.5 * background_.width;
    if (!has_labels) {
        right_ = background_.width - scaled(8.0);
        left_ = background_.width - right_;
    }

    for (const double time_s : strip_.stage_begin_s) {
        const double x = std::round(point(time_s, value_low_).x);
        fill_rectangle(background_, x, top_, x + thin, bottom_, k_line);
    }
    // As many labels as have room, at equal distances, and 0 wherever it is in between.
    const auto y_of = [&](double value) { return std::round(point(time_low_, value).y); };
    std::size_t stride = 1;
    if (value_ticks.size() > 1) {
        const double pitch = y_of(value_ticks[0]) - y_of(value_ticks[1]);
        stride = static_cast<std::size_t>(std::ceil(scaled(1.2 * k_text) / pitch));
    }
    const auto zero = std::find(value_ticks.begin(), value_ticks.end(), 0.0);
    const auto first = zero == value_ticks.end()
                           ? std::size_t{0}
                           : static_cast<std::size_t>(zero - value_ticks.begin()) % stride;
    for (std::size_t i = 0; i < value_ticks.size(); ++i) {
        const double value = value_ticks[i], y = y_of(value);
        fill_rectangle(background_, left_, y, right_, y + thin, value == 0.0 ? k_soft_ink : k_line);
        if (!has_labels || i % stride != first) continue;
        text.draw(background_, left_ - scaled(10.0), y + scaled(7.0), number_text(value), style,
                  Anchor::right);
    }
    fill_rectangle(background_, left_, bottom_, right_, bottom_ + thin, k_ink);
    // From the last one, which has the unit; none that would touch its neighbour.
    const std::vector<double> time_ticks = ticks({time_low_, time_high_});
    double free_until = background_.width - scaled(8.0);
    for (std::size_t i = time_ticks.size(); i-- > 0;) {
        const double x = std::round(point(time_ticks[i], value_low_).x);
        fill_rectangle(background_, x, bottom_, x + thin, bottom_ + scaled(6.0), k_ink);
        const std::string label =
            number_text(time_ticks[i]) + (i + 1 == time_ticks.size() ? " s" : "");
        const double width = text.width(label, style);
        const bool is_last = i + 1 == time_ticks.size();
        const double begin =
            is_last ? std::min(x - 0.5 * width, free_until - width) : x - 0.5 * width;
        if (begin < 0.0 || begin + width > free_until) continue;
        text.draw(background_, begin, bottom_ + scaled(27.0), label, style);
        free_until = begin - scaled(0.5 * k_between);
    }
}

void PlotStripPainter::draw_heading(TextPainter& text) {
    const auto scaled = [this](double px) { return scale_ * px; };
    const TextPainter::Style style{scaled(k_text), k_ink, FontStyle::normal, TextMode::plain};
    const TextPainter::Style soft{scaled(k_text), k_soft_ink, FontStyle::normal, TextMode::plain};
    const double y = scaled(26.0), end = background_.width - scaled(8.0);
    double x = left_;
    const std::string heading = shortened(text, strip_.heading, style, end - x);
    text.draw(background_, x, y, heading, style);
    x += text.width(heading, style) + scaled(k_between);
    if (strip_.curves.size() < 2) return;
    constexpr double line = 24.0, gap = 8.0;
    const double each = (end - x) / static_cast<double>(strip_.curves.size());
    for (std::size_t k = 0; k < strip_.curves.size(); ++k) {
        const std::string name = shortened(text, strip_.curves[k].name, soft,
                                           each - scaled(line + gap + k_between), Cut::middle);
        if (name.empty()) continue;
        fill_rectangle(background_, x, scaled(17.0), x + scaled(line), scaled(21.0), k_colours[k]);
        x += scaled(line + gap);
        text.draw(background_, x, y, name, soft);
        x += text.width(name, soft) + scaled(k_between);
    }
}

Image PlotStripPainter::draw(std::span<const double> time_s) const {
    Image image = background_;
    const double width = std::max(1.0, scale_ * 1.5);
    for (std::size_t k = 0; k < strip_.curves.size(); ++k) {
        const PlotStrip::Curve& curve = strip_.curves[k];
        const double x = point(time_s[k], value_low_).x;
        if (k == 0)
            fill_rectangle(image, x - 0.5 * width, top_, x + 0.5 * width, bottom_, k_soft_ink);
        // The last of the frames at this time: those of seeding all have time 0.
        const auto after = std::upper_bound(curve.time_s.begin(), curve.time_s.end(), time_s[k]);
        if (after == curve.time_s.begin()) continue;
        const double value =
            curve.value[static_cast<std::size_t>(after - curve.time_s.begin()) - 1];
        if (!std::isfinite(value)) continue;
        const Point at = point(time_s[k], value);
        fill_disc(image, at.x, at.y, scale_ * 7.0, {255, 255, 255});
        fill_disc(image, at.x, at.y, scale_ * 5.0, k_colours[k]);
    }
    return image;
}

}  // namespace spheroscope::render
