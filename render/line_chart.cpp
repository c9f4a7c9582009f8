#include "render/line_chart.hpp"

#include "render/canvas.hpp"
#include "render/range.hpp"
#include "render/strokes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::render {
namespace {

constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116}, k_grid{226, 228, 231};
constexpr double k_text_px = 15.0;

struct Span {
    double low = 0.0, high = 0.0;
    bool is_empty = true;
    void include(double value) {
        if (!std::isfinite(value)) return;
        low = is_empty ? value : std::min(low, value);
        high = is_empty ? value : std::max(high, value);
        is_empty = false;
    }
    /// Some room around the values; never of no width.
    void widen(double share) {
        const double width = high > low ? high - low : std::max(1.0, std::abs(high));
        low -= share * width;
        high += share * width;
    }
};

}  // namespace

double tick_step(double span, int n) {
    const double raw = span / n;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
    return 10.0 * power;
}

std::string tick_label(double value, double step) {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    const double shown = std::abs(value) < 1e-9 * step ? 0.0 : value;
    const std::string digits =
        decimals > 5 || std::abs(shown) >= 1e6
            ? fmt::format("{:.{}g}", std::abs(shown), digits_for(shown, step, 3))
            : fmt::format("{:.{}f}", std::abs(shown), decimals);
    return (shown < 0.0 ? "\u2212" : "") + digits;
}

void draw_line_chart(Image& image, TextPainter& text, const LineChart& chart, double x0, double y0,
                     double x1, double y1) {
    const double left = x0 + 74.0, right = x1 - 10.0, top = y0 + 30.0, bottom = y1 - 46.0;
    Span xs, ys;
    ys.include(0.0);
    for (const LineChart::Series& series : chart.series)
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!std::isfinite(series.y[i])) continue;
            xs.include(series.x[i]);
            ys.include(series.y[i]);
        }
    xs.widen(0.02);
    ys.widen(0.06);
    const auto to_x = [&](double x) {
        return left + (x - xs.low) / (xs.high - xs.low) * (right - left);
    };
    const auto to_y = [&](double y) {
        return bottom - (y - ys.low) / (ys.high - ys.low) * (bottom - top);
    };
    const TextPainter::Style label{k_text_px, k_soft_ink, FontStyle::normal, TextMode::plain};
    const TextPainter::Style axis{k_text_px, k_ink, FontStyle::normal, TextMode::symbol};

    const double step_x = tick_step(xs.high - xs.low, 6), step_y = tick_step(ys.high - ys.low, 5);
    for (double x = std::ceil(xs.low / step_x) * step_x; x <= xs.high; x += step_x) {
        draw_line(image, {to_x(x), top}, {to_x(x), bottom}, 1.0, k_grid);
        text.draw(image, to_x(x), bottom + 18.0, tick_label(x, step_x), label, Anchor::middle);
    }
    for (double y = std::ceil(ys.low / step_y) * step_y; y <= ys.high; y += step_y) {
        const bool is_zero = std::abs(y) < 1e-9 * step_y;
        draw_line(image, {left, to_y(y)}, {right, to_y(y)}, 1.0, is_zero ? k_soft_ink : k_grid);
        text.draw(image, left - 8.0, to_y(y) + 5.0, tick_label(y, step_y), label, Anchor::right);
    }
    draw_line(image, {left, top}, {left, bottom}, 1.2, k_ink);
    draw_line(image, {left, bottom}, {right, bottom}, 1.2, k_ink);
    if (chart.cursor)
        draw_line(image, {to_x(*chart.cursor), top}, {to_x(*chart.cursor), bottom}, 1.5,
                  {213, 94, 0});

    double key_x = right;
    for (const LineChart::Series& series : chart.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (!std::isfinite(series.y[i])) continue;
            const PixelPoint here{to_x(series.x[i]), to_y(series.y[i])};
            if (series.dots)
                fill_disc(image, here, 2.6, series.colour);
            else if (i + 1 < series.x.size() && std::isfinite(series.y[i + 1]))
                draw_line(image, here, {to_x(series.x[i + 1]), to_y(series.y[i + 1])}, 1.8,
                          series.colour);
        }
        if (series.name.empty()) continue;
        const TextPainter::Style style{k_text_px, series.colour, FontStyle::normal,
                                       TextMode::plain};
        text.draw(image, key_x, y0 + 18.0, series.name, style, Anchor::right);
        key_x -= text.width(series.name, style) + 18.0;
    }
    text.draw(image, x0, y0 + 18.0, chart.title, {17.0, k_ink, FontStyle::bold, TextMode::symbol});
    text.draw(image, right, y1 - 6.0, chart.x_title, axis, Anchor::right);
    text.draw(image, x0, y1 - 6.0, chart.y_title, axis);
}

}  // namespace spheroscope::render
