#include "viewer/panels/plot.hpp"

#include "render/range.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::viewer {
namespace {

constexpr ImU32 k_ink = IM_COL32(70, 74, 82, 255), k_grid = IM_COL32(226, 229, 234, 255);
constexpr ImU32 k_curve = IM_COL32(48, 84, 150, 255), k_now = IM_COL32(200, 90, 20, 255);

struct Span {
    float low = 0.0F, high = 1.0F;
};

Span span_of(const std::vector<float>& values, bool from_zero) {
    Span span{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (const float v : values)
        if (std::isfinite(v)) span = {std::min(span.low, v), std::max(span.high, v)};
    if (!(span.low <= span.high)) return {};
    if (from_zero) span.low = std::min(span.low, 0.0F);
    if (span.high - span.low < 1e-12F * std::max(1.0F, std::abs(span.high)))
        return {span.low - 0.5F, span.low + 0.5F};
    return span;
}

std::string tick_text(double value) { return fmt::format("{:.3g}", value); }

/// The frame of a plot on the screen.
struct Axes {
    ImVec2 low, high;  // corners: lower left, upper right
    Span x, y;
    [[nodiscard]] ImVec2 at(float px, float py) const {
        return {low.x + (high.x - low.x) * (px - x.low) / (x.high - x.low),
                low.y + (high.y - low.y) * (py - y.low) / (y.high - y.low)};
    }
};

void draw_axes(ImDrawList& list, const Axes& axes, float text_height) {
    for (const double v : render::ticks({double{axes.y.low}, double{axes.y.high}})) {
        const ImVec2 at = axes.at(axes.x.low, static_cast<float>(v));
        list.AddLine(at, {axes.high.x, at.y}, k_grid);
        const std::string text = tick_text(v);
        list.AddText(
            {axes.low.x - ImGui::CalcTextSize(text.c_str()).x - 4.0F, at.y - 0.5F * text_height},
            k_ink, text.c_str());
    }
    float free_from = -1e9F;
    for (const double v : render::ticks({double{axes.x.low}, double{axes.x.high}})) {
        const ImVec2 at = axes.at(static_cast<float>(v), axes.y.low);
        list.AddLine({at.x, axes.low.y}, {at.x, axes.low.y + 3.0F}, k_ink);
        const std::string text = tick_text(v);
        const float half = 0.5F * ImGui::CalcTextSize(text.c_str()).x;
        if (at.x - half < free_from) continue;
        list.AddText({at.x - half, axes.low.y + 3.0F}, k_ink, text.c_str());
        free_from = at.x + half + 6.0F;
    }
    list.AddLine(axes.low, {axes.high.x, axes.low.y}, k_ink);
}

void draw_curve(ImDrawList& list, const Axes& axes, const Plot& plot) {
    const Curve& c = plot.curve;
    const float half_bar =
        c.x.size() > 1 ? 0.45F * (axes.at(c.x[1], 0.0F).x - axes.at(c.x[0], 0.0F).x) : 4.0F;
    for (std::size_t k = 0; k < c.x.size(); ++k) {
        if (!std::isfinite(c.y[k])) continue;
        const ImVec2 here = axes.at(c.x[k], c.y[k]);
        if (plot.kind == PlotKind::bars) {
            list.AddRectFilled({here.x - half_bar, here.y}, {here.x + half_bar, axes.low.y},
                               k_curve);
            continue;
        }
        if (plot.kind == PlotKind::steps) list.AddCircleFilled(here, 2.5F, k_curve, 10);
        if (k > 0 && std::isfinite(c.y[k - 1]))
            list.AddLine(axes.at(c.x[k - 1], c.y[k - 1]), here, k_curve, 1.5F);
    }
}

}  // namespace

void draw_plot(const Plot& plot, float width, float height, ImFont* font) {
    ImGui::PushFont(font);
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, height});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float left = corner.x + 46.0F;  // numbers of the y axis stand before it
    list.AddText({left, corner.y}, k_ink, plot.title.c_str());
    if (plot.curve.x.size() < 2) {
        list.AddText({left, corner.y + 2.0F * line}, k_ink, "nothing to show");
        ImGui::PopFont();
        return;
    }
    Axes axes;
    axes.low = {left, corner.y + height - line - 6.0F};
    axes.high = {corner.x + width - 12.0F, corner.y + line + 8.0F};
    switch (plot.kind) {
    case PlotKind::line: axes.x = span_of(plot.curve.x, false); break;
    case PlotKind::steps: axes.x = {0.0F, 1.0F}; break;
    case PlotKind::bars:  // from zero; the last bar ends half an interval behind its middle
        axes.x = {0.0F, plot.curve.x.back() + plot.curve.x.front()};
        break;
    }
    axes.y = span_of(plot.curve.y, plot.from_zero);
    draw_axes(list, axes, line);
    draw_curve(list, axes, plot);
    if (std::isfinite(plot.now) && plot.now >= axes.x.low && plot.now <= axes.x.high) {
        const ImVec2 foot = axes.at(plot.now, axes.y.low);
        list.AddLine(foot, {foot.x, axes.high.y}, k_now, 1.5F);
    }
    const float label_width = ImGui::CalcTextSize(plot.x_label.c_str()).x;
    list.AddText({axes.high.x - label_width, corner.y}, k_ink, plot.x_label.c_str());
    ImGui::PopFont();
}

}  // namespace spheroscope::viewer
