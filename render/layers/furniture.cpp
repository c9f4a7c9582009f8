#include "render/layers/furniture.hpp"

#include "render/canvas.hpp"
#include "render/colour_maps.hpp"
#include "render/layers/stress_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::render {

namespace {

// All sizes in px of a picture with 720 rows.
constexpr double k_margin = 28.0;
constexpr double k_text = 22.0, k_title = 30.0, k_halo = 2.5;
constexpr double k_line = 32.0;  // from baseline to baseline
constexpr double k_column = 236.0;
constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116};

/// A value as a tick label: no more digits than it needs, a true minus sign.
std::string tick_text(double value, double step) {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    const std::string digits = std::abs(value) >= 1e5 || decimals > 4
                                   ? fmt::format("{:.2g}", std::abs(value))
                                   : fmt::format("{:.{}f}", std::abs(value), decimals);
    return (value < 0.0 ? "\u2212" : "") + digits;
}

std::string share_text(std::int64_t part, std::int64_t whole) {
    const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    return percent < 0.1 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
}

class Writer {
  public:
    Writer(Image& image, TextPainter& text)
        : image_(image), text_(text), scale_(writing_scale(image.height)) {}

    [[nodiscard]] double scaled(double px) const { return scale_ * px; }

    void line(double x, double y, const std::string& words, Rgb colour = k_ink,
              TextMode mode = TextMode::plain, Anchor anchor = Anchor::left) {
        text_.draw(image_, x, y, words, {scaled(k_text), colour, FontStyle::normal, mode}, anchor);
    }

    /// A line that may stand on cells or bead.
    void line_above(double x, double y, const std::string& words, Rgb colour) {
        text_.draw(image_, x, y, words,
                   {scaled(k_text), colour, FontStyle::normal, TextMode::plain, scaled(k_halo)});
    }

    /// Shrinks a long title to the width that is there, to the size of other text; then cuts it.
    void title(double x, double y, std::string words, double width) {
        TextPainter::Style style{scaled(k_title), k_ink, FontStyle::bold, TextMode::plain,
                                 scaled(k_halo)};
        const double wanted = text_.width(words, style);
        if (wanted > width)
            style.size_px = std::max(scaled(k_text), style.size_px * width / wanted);
        if (text_.width(words, style) > width) {
            while (!words.empty() && text_.width(words + "…", style) > width) {
                while (!words.empty() &&
                       (static_cast<unsigned char>(words.back()) & 0xC0U) == 0x80U)
                    words.pop_back();  // the tail of a letter of several bytes
                if (!words.empty()) words.pop_back();
            }
            words += "…";
        }
        text_.draw(image_, x, y, words, style);
    }

    void swatch(double x, double y_baseline, Rgb colour, const std::string& words) {
        const double side = scaled(18.0);
        fill_rectangle(image_, x, y_baseline - side + scaled(1.0), x + side,
                       y_baseline + scaled(1.0), colour);
        line(x + scaled(26.0), y_baseline, words);
    }

    /// A value bar from (x, y_top) down; returns the y below its last part.
    double colour_bar(double x, double y_top, double height, const Furniture& furniture);
    double network_key(double x, double y, const NetworkCount& network, double px_per_um);
    void stress_axes_key(double x, double y, double longest_kPa);

  private:
    Image& image_;
    TextPainter& text_;
    double scale_;
};

double Writer::colour_bar(double x, double y_top, double height, const Furniture& furniture) {
    const Field& field = *furniture.field;
    const ColourMap& map = ColourMap::of(field.range);
    const auto pale = [&](Rgb colour) { return mix(colour, {255, 255, 255}, furniture.paleness); };
    const bool is_signed = field.range == RangeKind::signed_about_zero;
    const double right = x + scaled(24.0), tip = scaled(18.0);

    std::string heading(field.symbol);
    if (!field.shown_unit.empty()) heading += " (" + std::string(field.shown_unit) + ")";
    double y = y_top + scaled(k_text);
    text_.draw(image_, x, y, heading, {scaled(26.0), k_ink, FontStyle::normal, TextMode::symbol});
    if (furniture.range_is_of_this_frame) line(x, y += scaled(k_line), "this frame", k_soft_ink);
    if (is_signed) line(x, y += scaled(k_line), "tension", k_soft_ink);

    const double top = y + scaled(14.0) + tip, bottom = top + height;
    fill_tip(image_, x, right, top, top - tip, pale(map.above()));
    const int n_slices = 4 * static_cast<int>(std::lround(height));
    for (int k = 0; k < n_slices; ++k) {
        const double from = bottom - height * (k + 1) / n_slices;
        // the slices overlap by one, so that no background shines through between them
        const double value =
            std::lerp(furniture.range.low, furniture.range.high, (k + 0.5) / n_slices);
        fill_rectangle(image_, x, from, right, std::min(bottom, from + 2.0 * height / n_slices),
                       pale(map.at(map_position(field.range, furniture.range, value))));
    }
    if (furniture.range.low < 0.0 || furniture.count.n_below > 0)
        fill_tip(image_, x, right, bottom, bottom + tip, pale(map.below()));

    const std::vector<double> values = ticks(furniture.range);
    const double step = values.size() > 1 ? values[1] - values[0] : 1.0;
    for (const double value : values) {
        const double share =
            (value - furniture.range.low) / (furniture.range.high - furniture.range.low);
        const double at = bottom - share * height;
        fill_rectangle(image_, right, at - scaled(0.75), right + scaled(6.0), at + scaled(0.75),
                       k_ink);
        // In a low picture there is room for every second or third label; zero always has one.
        const double apart_px = height * step / (furniture.range.high - furniture.range.low);
        const int every = std::max(1, static_cast<int>(std::ceil(scaled(k_text) / apart_px)));
        if (std::lround(value / step) % every != 0) continue;
        line(right + scaled(12.0), at + scaled(0.36 * k_text), tick_text(value, step));
    }

    y = bottom + tip + scaled(4.0);
    if (is_signed) line(x, y += scaled(k_text), "compression", k_soft_ink);
    y += scaled(k_line + 4.0);
    const ColourCount& count = furniture.count;
    const auto entry = [&](Rgb colour, const std::string& words) {
        swatch(x, y, pale(colour), words);
        y += scaled(k_line);
    };
    if (!field.absent.empty()) entry(k_absent_colour, std::string(field.absent));
    if (count.n_above > 0) entry(map.above(), share_text(count.n_above, count.n_shown) + " above");
    if (count.n_below > 0) entry(map.below(), share_text(count.n_below, count.n_shown) + " below");
    return y;
}

double Writer::network_key(double x, double y, const NetworkCount& network, double px_per_um) {
    line(x, y, "contact force");
    // A wedge shows thickness and colour from the thinnest tube to that of three times the mean.
    const auto wedge = [&](double force_nN, const std::string& words) {
        y += scaled(k_line);
        const double middle = y - scaled(0.34 * k_text);
        const int n_columns = static_cast<int>(scaled(44.0));
        for (int k = 0; k < n_columns; ++k) {
            const double f = 3.0 * (k + 0.5) / n_columns;
            if (f < ForceNetwork::k_smallest_drawn) continue;
            const double half =
                std::min(scaled(11.0), network.unit_radius_um * std::sqrt(f) * px_per_um);
            fill_rectangle(image_, x + k, middle - half, x + k + 1.0, middle + half,
                           ForceNetwork::tube_colour(force_nN, f));
        }
        line(x + scaled(54.0), y, words);
    };
    wedge(+1.0, "compression");
    wedge(-1.0, "tension");
    if (network.n_links > 0)
        line(x, y += scaled(k_line), fmt::format("⟨|F|⟩ = {:.3g} nN", network.mean_force_nN));
    line(x, y += scaled(k_line),
         fmt::format("{} of {} left out", network.n_left_out, network.n_links), k_soft_ink);
    return y;
}

void Writer::stress_axes_key(double x, double y, double longest_kPa) {
    line(x, y, "principal stress");
    line(x, y += scaled(k_line), fmt::format("longest: {:.3g} Pa", 1000.0 * longest_kPa));
    swatch(x, y += scaled(k_line), StressAxes::rod_colour(-1.0), "compression");
    swatch(x, y += scaled(k_line), StressAxes::rod_colour(+1.0), "tension");
}

}  // namespace

double writing_scale(int height_px) { return std::max(1.0, height_px / 720.0); }

double key_column_px(int height_px, bool has_field, bool has_keys) {
    return has_field || has_keys ? writing_scale(height_px) * k_column : 0.0;
}

ScaleBar make_scale_bar(int width_px, int height_px, double px_per_um) {
    const double scale = writing_scale(height_px);
    ScaleBar bar;
    bar.length_um = nice_step(0.18 * width_px / px_per_um);
    bar.x0 = std::round(scale * k_margin);
    bar.x1 = bar.x0 + bar.length_um * px_per_um;
    bar.y1 = std::round(height_px - scale * k_margin);
    bar.y0 = bar.y1 - std::round(scale * 6.0);
    bar.label = fmt::format("{:g} µm", bar.length_um);
    return bar;
}

void draw_furniture(Image& image, TextPainter& text, const Furniture& furniture) {
    Writer writer(image, text);
    const auto scaled = [&](double px) { return writer.scaled(px); };
    const double left = scaled(k_margin);
    const double column =
        key_column_px(image.height, furniture.field != nullptr, furniture.has_keys());

    double y = scaled(k_margin + 24.0);
    writer.title(left, y, furniture.title, image.width - column - 2.0 * left);
    y += scaled(6.0);
    writer.line_above(left, y += scaled(k_line), furniture.status, k_ink);
    for (const std::string& note : furniture.notes)
        writer.line_above(left, y += scaled(k_line), note, k_soft_ink);

    const ScaleBar bar = make_scale_bar(image.width, image.height, furniture.px_per_um);
    fill_rectangle(image, bar.x0, bar.y0, bar.x1, bar.y1, k_ink);
    writer.line(0.5 * (bar.x0 + bar.x1), bar.y0 - scaled(10.0), bar.label, k_ink, TextMode::plain,
                Anchor::middle);
    writer.line(image.width - left, image.height - scaled(k_margin), furniture.footer, k_soft_ink,
                TextMode::plain, Anchor::right);

    const double x = image.width - column;
    y = scaled(k_margin);
    if (furniture.field != nullptr) {
        // what is left of the column below the heading and above the entries of the keys
        const double height = std::max(
            scaled(60.0), image.height - scaled(330.0 + (furniture.network ? 170.0 : 0.0) +
                                                (furniture.longest_axis_kPa ? 110.0 : 0.0)));
        y = writer.colour_bar(x, y, height, furniture) + scaled(12.0);
    } else {
        y += scaled(k_text);
    }
    if (furniture.network)
        y = writer.network_key(x, y, *furniture.network, furniture.px_per_um) +
            scaled(k_line + 8.0);
    if (furniture.longest_axis_kPa) writer.stress_axes_key(x, y, *furniture.longest_axis_kPa);
}

std::string minus_sign(std::string text) {
    for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-', at + 3))
        text.replace(at, 1, "\u2212");
    return text;
}

std::string time_text(double time_s, int decimals) {
    if (time_s < 600.0) return fmt::format("t = {:.{}f} s", time_s, decimals);
    const auto seconds = static_cast<long>(std::lround(time_s));
    return fmt::format("t = {} min {:02d} s", seconds / 60, seconds % 60);
}

}  // namespace spheroscope::render
