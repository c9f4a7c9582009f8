// Logarithms are taken by whoever adds the points, and the axes are linear with their own labels:
// VTK's logarithmic axes label a range of less than a decade with nothing, and write 1e-3 where a
// reader expects 10⁻³.

#include "render/plot_axes.hpp"

#include "render/line_chart.hpp"

#include <vtkAxis.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkStringArray.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spheroscope::render {
namespace {

/// "10⁻³", "2·10⁻³", "2".
std::string power_of_ten(int exponent, int times) {
    static const std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                    "⁵", "⁶", "⁷", "⁸", "⁹"};
    if (exponent == 0) return std::to_string(times);
    std::string text = times == 1 ? "10" : std::to_string(times) + "·10";
    if (exponent < 0) text += "⁻";
    for (const char c : std::to_string(std::abs(exponent)))
        text += digits[static_cast<std::size_t>(c - '0')];
    return text;
}

/// Of a logarithmic axis: between 1 and 5 are two intervals of the labels 1, 2, 5; any range of
/// that width holds two of these.
const double k_smallest_decades = std::log10(5.0);

}  // namespace

void set_font(vtkTextProperty* text, int size, const char* file) {
    text->SetFontFamily(VTK_FONT_FILE);
    text->SetFontFile(file == nullptr ? SPHEROSCOPE_FONT : file);
    text->SetFontSize(size);
    text->SetColor(0.15, 0.16, 0.17);
    text->SetBold(0);
    text->SetItalic(0);
}

AxisRange::AxisRange(const reports::Plot::Axis& axis)
    : is_logarithmic(axis.is_logarithmic && axis.categories.empty()) {
    if (axis.categories.empty()) return;
    low = -0.5;
    high = static_cast<double>(axis.categories.size()) - 0.5;
}

double AxisRange::place(double value) const {
    if (is_logarithmic) return std::log10(value);
    if (!broken) return value;
    const Break& b = *broken;
    const double way = b.far_begin < b.near ? -1.0 : 1.0;  // from the near end to the strip
    if (way * (value - b.near) <= 0.0) return value;
    const auto between = [](double v, double v0, double v1, double p0, double p1) {
        return v0 == v1 ? p1 : std::lerp(p0, p1, std::clamp((v - v0) / (v1 - v0), 0.0, 1.0));
    };
    if (way * (value - b.far_begin) <= 0.0)
        return between(value, b.near, b.far_begin, b.near, b.place_begin);
    return between(value, b.far_begin, b.far_end, b.place_begin, b.place_end);
}

void AxisRange::include(double value) {
    if (!std::isfinite(value) || (is_logarithmic && value <= 0.0)) return;
    if (low > high) low = high = place(value);
    low = std::min(low, place(value));
    high = std::max(high, place(value));
}

void AxisRange::widen() {
    if (low > high) {
        low = 0.0;
        high = 1.0;
    }
    if (is_logarithmic) {
        low -= 0.15;
        high += 0.15;
        const double lacking = k_smallest_decades - (high - low);
        if (lacking > 0.0) {
            low -= 0.5 * lacking;
            high += 0.5 * lacking;
        }
        return;
    }
    // What differs in its last digits only is one value.
    const double size = std::max(std::abs(low), std::abs(high));
    const double width = high - low > 1e-9 * size ? high - low : std::max(1e-3, 0.2 * size);
    low = low >= 0.0 && low < 0.5 * high ? 0.0 : low - 0.06 * width;
    high += 0.06 * width;
}

void AxisRange::break_off(double begin, double end) {
    // Shares of what is drawn to scale: a line of text beside the band, and the sign of the break.
    constexpr double k_gap = 0.04, k_first = 0.13, k_last = 0.18, k_strip = 0.25;
    const double height = high - low;
    const bool is_below = end < low;
    const double near = is_below ? low : high, way = is_below ? -height : height;
    broken = Break{near,
                   is_below ? end : begin,
                   is_below ? begin : end,
                   near + k_first * way,
                   near + (begin == end ? k_first : k_last) * way,
                   near + k_gap * way};
    (is_below ? low : high) = near + k_strip * way;
}

std::vector<AxisTick> logarithmic_ticks(const AxisRange& range) {
    std::vector<AxisTick> ticks;
    const int first = static_cast<int>(std::ceil(range.low));
    const int last = static_cast<int>(std::floor(range.high));
    if (last > first) {
        const int step = std::max(1, (last - first) / 5);
        for (int exponent = first; exponent <= last; exponent += step)
            ticks.push_back({static_cast<double>(exponent), power_of_ten(exponent, 1)});
        return ticks;
    }
    for (int exponent = first - 1; exponent <= last + 1; ++exponent)
        for (const int times : {1, 2, 5}) {
            const double place = exponent + std::log10(times);
            if (place >= range.low && place <= range.high)
                ticks.push_back({place, power_of_ten(exponent, times)});
        }
    return ticks;
}

void set_axis(vtkAxis* axis, const std::string& title, const AxisRange& range,
              const std::vector<std::string>& categories) {
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(range.low, range.high);
    axis->SetTitle(title);
    set_font(axis->GetTitleProperties(), 16);
    set_font(axis->GetLabelProperties(), 14);
    axis->SetGridVisible(true);
    axis->GetGridPen()->SetColor(225, 227, 230);
    vtkNew<vtkDoubleArray> places;
    vtkNew<vtkStringArray> labels;
    const auto add = [&](double place, const std::string& label) {
        places->InsertNextValue(place);
        labels->InsertNextValue(label);
    };
    if (!categories.empty()) {
        for (std::size_t i = 0; i < categories.size(); ++i)
            add(static_cast<double>(i), categories[i]);
    } else if (range.is_logarithmic) {
        for (const AxisTick& tick : logarithmic_ticks(range)) add(tick.place, tick.label);
    } else {
        double low = range.low, high = range.high;  // of what is drawn to scale
        if (const auto& broken = range.broken) {
            (broken->far_begin < broken->near ? low : high) = broken->near;
            add(broken->place_begin, tick_label(broken->far_begin, 1.0));
            if (broken->far_end != broken->far_begin)
                add(broken->place_end, tick_label(broken->far_end, 1.0));
        }
        const double step = tick_step(high - low, 5);
        const double first = std::ceil(low / step);
        for (int k = 0; (first + k) * step <= high; ++k)
            add((first + k) * step, tick_label((first + k) * step, step));
    }
    axis->SetCustomTickPositions(places, labels);
}

}  // namespace spheroscope::render
