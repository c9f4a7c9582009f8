#include "render/layers/furniture.hpp"

#include "render/canvas.hpp"
#include "render/colour_maps.hpp"
#include "render/layers/stress_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace spheroscope::render {

namespace {

// All sizes in px of a picture with 720 rows.
constexpr double k_margin = 28.0;
constexpr double k_text = 22.0, k_title = 30.0, k_halo = 2.5;
constexpr double k_line = 32.0;   // from baseline to baseline
constexpr double k_block = 44.0;  // from the last baseline of a block to the first of the next
constexpr double k_column = 236.0;
constexpr double k_tip = 18.0;  // of the colour bar
constexpr double k_above_bar = 14.0, k_below_bar = 4.0;
constexpr double k_descent = 8.0;                 // of letters below their baseline, and a little
constexpr double k_smallest_bar = 56.0;           // has room for three labels
constexpr double k_left_height = 300.0;           // title, status, four notes and scale bar
constexpr double k_left_width = 480.0;            // stage and time
constexpr double k_shortest_text = 6.0 * k_text;  // less of a title says nothing

/// Letters of 11 px, capitals of 8.
constexpr double k_smallest_scale = 0.5;
/// Share of the width for the column, before sizes shrink; and when they cannot shrink any more.
constexpr double k_column_share = 0.4, k_largest_column_share = 0.6;

constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116};

/// Height of the column on the right with everything that it may hold in any frame, and a bar of
/// that height, in px of a picture with 720 rows.
double column_height(const FurnitureLayout& layout, const FurnitureParts& parts, double bar) {
    double y = k_margin + k_text - k_block;  // the baseline before the first block, as it were
    if (layout.has_bar) {
        const int n_sides = is_tension_or_compression(*parts.field) ? 1 : 0;
        y += k_block;
        if (layout.has_bar_words) y += k_line * (1 + n_sides);
        y += k_above_bar + k_tip + bar + k_tip + k_below_bar;
        if (layout.has_bar_words) y += k_text * n_sides;
        if (layout.has_counts) y += k_line * (parts.field->absent.empty() ? 2 : 3) + 4.0;
    }
    if (layout.has_network_key) y += k_block + k_line * (layout.has_network_numbers ? 4 : 2);
    if (layout.has_axes_key) y += k_block + k_line * 3;
    return y + (layout.has_footer ? k_line + k_margin : k_descent + 0.5 * k_margin);
}

/// A value as a tick label: no more digits than it needs, a true minus sign.
std::string tick_text(double value, double step) {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    const std::string digits =
        std::abs(value) >= 1e5 || decimals > 4
            ? fmt::format("{:.{}g}", std::abs(value), digits_for(value, step, 2))
            : fmt::format("{:.{}f}", std::abs(value), decimals);
    return (value < 0.0 ? "\u2212" : "") + digits;
}

struct TickLabel {
    double value;
    std::string text;
};

/// Labels of a bar of that height that are at least `apart_px` from each other; zero has one
/// wherever it is in between, and there are never fewer than two.
std::vector<TickLabel> tick_labels(const Range& range, double height, double apart_px) {
    const std::vector<double> values = ticks(range);
    const double px_per_value = height / (range.high - range.low);
    const double step = values.size() > 1 ? values[1] - values[0] : range.high - range.low;
    const int every = std::max(1, static_cast<int>(std::ceil(apart_px / (step * px_per_value))));
    std::vector<TickLabel> labels;
    for (const double value : values)
        if (std::lround(value / step) % every == 0)
            labels.push_back({value, tick_text(value, step)});
    if (labels.size() >= 2) return labels;
    // Its ends are round numbers, or the scene's.
    labels.clear();
    for (const double value : {range.low, 0.0, range.high}) {
        const bool is_end = value == range.low || value == range.high;
        const double away_px = std::min(value - range.low, range.high - value) * px_per_value;
        if (is_end || away_px >= apart_px)
            labels.push_back(
                {value, minus_sign(fmt::format("{:.{}g}", value,
                                               digits_for(value, range.high - range.low, 4)))});
    }
    return labels;
}

std::string share_text(std::int64_t part, std::int64_t whole) {
    const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
    return percent < 0.1 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
}

class Writer {
  public:
    Writer(Image& image, TextPainter& text, double scale)
        : image_(image), text_(text), scale_(scale) {}

    [[nodiscard]] double scaled(double px) const { return scale_ * px; }
    [[nodiscard]] double width(const std::string& words) const {
        return text_.width(words, {scaled(k_text)});
    }
    [[nodiscard]] std::vector<DrawnBox>& boxes() { return boxes_; }

    void rectangle(const std::string& what, double x0, double y0, double x1, double y1,
                   Rgb colour) {
        fill_rectangle(image_, x0, y0, x1, y1, colour);
        boxes_.push_back({what, x0, y0, x1, y1});
    }

    void write(double x, double y, const std::string& words, const TextPainter::Style& style) {
        text_.draw(image_, x, y, words, style);
        boxes_.push_back({words, x, y - 0.75 * style.size_px, x + text_.width(words, style),
                          y + 0.22 * style.size_px});
    }

    /// A line of the column on the right, narrower letters where it is longer than the column.
    void line(double x, double y, const std::string& words, Rgb colour = k_ink) {
        TextPainter::Style style{scaled(k_text), colour};
        const double room = image_.width - scaled(0.25 * k_margin) - x;
        style.size_px *= std::min(1.0, room / text_.width(words, style));
        write(x, y, words, style);
    }

    /// A line that may stand on cells or bead.
    void line_above(double x, double y, const std::string& words, Rgb colour) {
        write(x, y, words,
              {scaled(k_text), colour, FontStyle::normal, TextMode::plain, scaled(k_halo)});
    }

    /// Shrinks a long title to the width that is there, to the size of other text; then cuts it.
    void title(double x, double y, const std::string& words, double width) {
        TextPainter::Style style{scaled(k_title), k_ink, FontStyle::bold, TextMode::plain,
                                 scaled(k_halo)};
        const double wanted = text_.width(words, style);
        if (wanted > width)
            style.size_px = std::max(scaled(k_text), style.size_px * width / wanted);
        write(x, y, shortened(text_, words, style, width), style);
    }

    void footer(double x_right, double y, const std::string& words, double width) {
        if (width < scaled(k_shortest_text)) return;
        const std::string shown = shortened(text_, words, {scaled(k_text)}, width);
        line_above(x_right - this->width(shown), y, shown, k_soft_ink);
    }

    void swatch(double x, double y_baseline, Rgb colour, const std::string& words) {
        const double side = scaled(18.0);
        rectangle("swatch", x, y_baseline - side + scaled(1.0), x + side, y_baseline + scaled(1.0),
                  colour);
        line(x + scaled(26.0), y_baseline, words);
    }

    /// Title, difference, status and notes from the upper left corner down, as far as they have
    /// room above y_end. Returns whether the title has.
    bool left_block(const Furniture& furniture, double width, double y_end);
    // Parts of the column on the right, each from its first baseline; they return their last one.
    double colour_bar(double x, double y, const Furniture& furniture);
    double network_key(double x, double y, const Furniture& furniture);
    double stress_axes_key(double x, double y, double longest_kPa);

  private:
    Image& image_;
    TextPainter& text_;
    double scale_;
    std::vector<DrawnBox> boxes_;
};

bool Writer::left_block(const Furniture& furniture, double width, double y_end) {
    const double left = scaled(k_margin), first = k_margin + 24.0, pitch = k_line + 6.0;
    double y = scaled(first - pitch);
    const auto has_room = [&](int n_lines) {
        return y + scaled(n_lines * pitch + k_descent) <= y_end;
    };
    std::string status = furniture.status;
    if (this->width(status) > width) status = furniture.short_status;
    if (this->width(status) > width) status.clear();  // a part of a number is another number
    const std::string difference = shortened(text_, furniture.difference, {scaled(k_text)}, width);
    // The time matters more than the difference, and that more than a title that both runs may
    // have.
    const int n_status = status.empty() ? 0 : 1, n_difference = difference.empty() ? 0 : 1;
    const bool has_title =
        width >= scaled(k_shortest_text) && has_room(1 + n_difference + n_status);
    if (has_title) title(left, y += scaled(pitch), furniture.title, width);
    if (n_difference > 0 && has_room(1 + n_status))
        line_above(left, y += scaled(has_title ? k_line : pitch), difference, k_ink);
    if (status.empty() || !has_room(1)) return has_title;
    line_above(left, y += scaled(pitch), status, k_ink);
    for (const std::string& note : furniture.notes) {
        if (y + scaled(k_line + k_descent) > y_end || this->width(note) > width) break;
        line_above(left, y += scaled(k_line), note, k_soft_ink);
    }
    return has_title;
}

double Writer::colour_bar(double x, double y, const Furniture& furniture) {
    const Field& field = *furniture.field;
    const ColourMap& map = ColourMap::of(field.range);
    const auto pale = [&](Rgb colour) { return mix(colour, {255, 255, 255}, furniture.paleness); };
    const bool has_sides = is_tension_or_compression(field) && furniture.layout.has_bar_words;
    const double height = furniture.layout.bar_px;
    const double right = x + scaled(24.0), tip = scaled(k_tip);

    std::string heading(field.symbol);
    if (!field.shown_unit.empty()) heading += " (" + std::string(field.shown_unit) + ")";
    write(x, y, heading, {scaled(26.0), k_ink, FontStyle::normal, TextMode::symbol});
    if (furniture.range_is_of_this_frame && furniture.layout.has_bar_words)
        line(x, y += scaled(k_line), "this frame", k_soft_ink);
    if (has_sides) line(x, y += scaled(k_line), "tension", k_soft_ink);

    const double top = y + scaled(k_above_bar) + tip, bottom = top + height;
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
    boxes_.push_back({"colour bar", x, top - tip, right, bottom + tip});

    const auto place = [&](double value) {
        return bottom - height * (value - furniture.range.low) /
                            (furniture.range.high - furniture.range.low);
    };
    const auto mark = [&](double value) {
        fill_rectangle(image_, right, place(value) - scaled(0.75), right + scaled(6.0),
                       place(value) + scaled(0.75), k_ink);
    };
    for (const double value : ticks(furniture.range)) mark(value);
    for (const TickLabel& label : tick_labels(furniture.range, height, scaled(k_text))) {
        mark(label.value);
        line(right + scaled(12.0), place(label.value) + scaled(0.36 * k_text), label.text);
    }

    y = bottom + tip + scaled(k_below_bar);
    if (has_sides) line(x, y += scaled(k_text), "compression", k_soft_ink);
    if (!furniture.layout.has_counts) return y;
    const ColourCount& count = furniture.count;
    double gap = scaled(4.0);  // before the first one
    const auto entry = [&](Rgb colour, const std::string& words) {
        swatch(x, y += scaled(k_line) + gap, pale(colour), words);
        gap = 0.0;
    };
    if (!field.absent.empty()) entry(k_absent_colour, std::string(field.absent));
    if (count.n_above > 0) entry(map.above(), share_text(count.n_above, count.n_shown) + " above");
    if (count.n_below > 0) entry(map.below(), share_text(count.n_below, count.n_shown) + " below");
    return y;
}

double Writer::network_key(double x, double y, const Furniture& furniture) {
    const NetworkCount& network = *furniture.network;
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
                std::min(scaled(11.0), network.unit_radius_um * std::sqrt(f) * furniture.px_per_um);
            fill_rectangle(image_, x + k, middle - half, x + k + 1.0, middle + half,
                           ForceNetwork::tube_colour(force_nN, f));
        }
        boxes_.push_back({"wedge", x, middle - scaled(11.0), x + n_columns, middle + scaled(11.0)});
        line(x + scaled(54.0), y, words);
    };
    wedge(+1.0, "compression");
    wedge(-1.0, "tension");
    if (!furniture.layout.has_network_numbers) return y;
    if (network.n_links > 0)
        line(x, y += scaled(k_line), fmt::format("⟨|F|⟩ = {:.3g} nN", network.mean_force_nN));
    line(x, y += scaled(k_line),
         fmt::format("{} of {} left out", network.n_left_out, network.n_links), k_soft_ink);
    return y;
}

double Writer::stress_axes_key(double x, double y, double longest_kPa) {
    line(x, y, "principal stress");
    line(x, y += scaled(k_line), fmt::format("longest: {:.3g} Pa", 1000.0 * longest_kPa));
    swatch(x, y += scaled(k_line), StressAxes::rod_colour(-1.0), "compression");
    swatch(x, y += scaled(k_line), StressAxes::rod_colour(+1.0), "tension");
    return y;
}

}  // namespace

FurnitureLayout lay_out_furniture(int width_px, int height_px, const FurnitureParts& parts) {
    FurnitureLayout layout;
    layout.has_bar = layout.has_bar_words = layout.has_counts = parts.field != nullptr;
    layout.has_network_key = layout.has_network_numbers = parts.network;
    layout.has_axes_key = parts.stress_axes;
    const bool has_column = layout.has_bar || layout.has_network_key || layout.has_axes_key;
    const double width = has_column ? k_column / k_column_share : k_left_width;
    const double height = std::max(k_left_height, column_height(layout, parts, k_smallest_bar));
    layout.scale =
        std::min({std::max(1.0, height_px / 720.0), width_px / width, height_px / height});
    if (layout.scale < k_smallest_scale) {
        layout.scale = k_smallest_scale;
        const bool is_too_wide =
            layout.scale * k_column > k_largest_column_share * static_cast<double>(width_px);
        const bool is_title_below =
            width_px - layout.scale * (k_column + 2.0 * k_margin) < layout.scale * k_shortest_text;
        std::vector<bool FurnitureLayout::*> parts_in_order{
            &FurnitureLayout::has_counts, &FurnitureLayout::has_network_numbers,
            &FurnitureLayout::has_axes_key, &FurnitureLayout::has_network_key,
            &FurnitureLayout::has_bar_words};
        parts_in_order.insert(is_title_below ? parts_in_order.end() : parts_in_order.begin(),
                              &FurnitureLayout::has_footer);
        parts_in_order.push_back(&FurnitureLayout::has_bar);
        for (bool FurnitureLayout::*part : parts_in_order)
            if (is_too_wide ||
                layout.scale * column_height(layout, parts, k_smallest_bar) > height_px)
                layout.*part = false;
    }
    if (layout.has_bar || layout.has_network_key || layout.has_axes_key)
        layout.column_px = layout.scale * k_column;
    if (layout.has_bar)
        layout.bar_px = height_px - layout.scale * column_height(layout, parts, 0.0);
    return layout;
}

ScaleBar make_scale_bar(int width_px, int height_px, double writing_scale, double px_per_um) {
    ScaleBar bar;
    bar.length_um = nice_step(0.18 * width_px / px_per_um);
    bar.x0 = std::round(writing_scale * k_margin);
    bar.x1 = bar.x0 + bar.length_um * px_per_um;
    bar.y1 = std::round(height_px - writing_scale * k_margin);
    bar.y0 = bar.y1 - std::round(writing_scale * 6.0);
    bar.label = fmt::format("{:g} µm", bar.length_um);
    return bar;
}

std::vector<DrawnBox> draw_furniture(Image& image, TextPainter& text, const Furniture& furniture) {
    const FurnitureLayout& layout = furniture.layout;
    Writer writer(image, text, layout.scale);
    const auto scaled = [&](double px) { return writer.scaled(px); };
    const double left = scaled(k_margin);

    const ScaleBar bar =
        make_scale_bar(image.width, image.height, layout.scale, furniture.px_per_um);
    writer.rectangle("scale bar", bar.x0, bar.y0, bar.x1, bar.y1, k_ink);
    const double label_px = writer.width(bar.label);
    const double label_x = std::max(left, 0.5 * (bar.x0 + bar.x1 - label_px));
    const double label_y = bar.y0 - scaled(10.0);
    writer.line_above(label_x, label_y, bar.label, k_ink);
    const bool has_title = writer.left_block(furniture, image.width - layout.column_px - 2.0 * left,
                                             label_y - scaled(k_text));
    if (layout.has_footer)
        writer.footer(image.width - left, image.height - scaled(k_margin),
                      has_title ? furniture.footer : furniture.title,
                      image.width - left - std::max(bar.x1, label_x + label_px) - scaled(k_block));

    const double x = image.width - layout.column_px;
    double y = scaled(k_margin + k_text - k_block);
    if (layout.has_bar && furniture.field != nullptr)
        y = writer.colour_bar(x, y + scaled(k_block), furniture);
    if (layout.has_network_key && furniture.network)
        y = writer.network_key(x, y + scaled(k_block), furniture);
    if (layout.has_axes_key && furniture.longest_axis_kPa)
        writer.stress_axes_key(x, y + scaled(k_block), *furniture.longest_axis_kPa);
    return std::move(writer.boxes());
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
