#include "render/node_sheet.hpp"

#include "engine/base/index.hpp"
#include "render/canvas.hpp"
#include "render/colour_maps.hpp"
#include "render/layers/furniture.hpp"
#include "render/range.hpp"
#include "render/strokes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace spheroscope::render {
namespace {

constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116}, k_white{255, 255, 255};
constexpr Rgb k_surface{214, 219, 227}, k_edge{150, 157, 168}, k_paper{246, 247, 248};
// Places, px.
constexpr double k_title_x = 640.0;  // right of the words "Forces on node 1234 of cell 123"
constexpr int k_view_x = 30, k_view_width = 700, k_view_height = 390;
constexpr int k_side_y = 140, k_outside_y = 580;
constexpr int k_chain_x = 790, k_chain_width = 780;
constexpr double k_numbers_x = 790.0, k_numbers_x1 = 1570.0;
/// Of the longest arrow, over the height of a view.
constexpr double k_longest = 0.40;
/// An arrow that is shorter has no direction that could be seen.
constexpr double k_shortest_px = 5.0;
/// A view in which no component is larger than this share of a force shows all of them end-on.
constexpr double k_end_on = 1e-6;
/// Half the width of a view over the mean edge at the node.
constexpr double k_edges_across = 4.0;

Vec3 point(const std::vector<float>& values, int i) {
    const std::size_t at = 3 * idx(i);
    return {double{values[at]}, double{values[at + 1]}, double{values[at + 2]}};
}

/// A force that has an arrow.
struct Row {
    std::string name;
    Vec3 force_nN;
    bool is_friction;
    int number;
    /// Rows that are more than the colours begin again; they have their numbers.
    [[nodiscard]] Rgb colour() const {
        return k_distinct_colours[idx(number - 1) % k_distinct_colours.size()];
    }
};

std::vector<Row> rows_of(const inspect::NodeForces& forces) {
    std::vector<Row> rows;
    const auto add = [&](const inspect::NodeForce& force, bool is_friction) {
        rows.push_back(
            {force.name, force.force_nN, is_friction, static_cast<int>(rows.size()) + 1});
    };
    for (const inspect::NodeForce& force : forces.terms) add(force, false);
    for (const inspect::NodeForce& force : forces.frictions) add(force, true);
    return rows;
}

/// What the views are drawn in: outward from the cell, and two axes along its surface. Most of what
/// is not outward lies along `along`.
struct Axes {
    Vec3 outward, along, across;
};

Axes axes_of(const inspect::NodeMoment& moment, const std::vector<Row>& rows) {
    const inspect::NodeForces& forces = moment.forces;
    const int n_nodes = moment.frame->header->topology->n_nodes();
    Axes axes;
    axes.outward = point(moment.frame->normal, forces.cell * n_nodes + forces.node).normalized();
    Vec3 largest = Vec3::Zero();
    double longest_nN = 0.0;
    for (const Row& row : rows) {
        longest_nN = std::max(longest_nN, row.force_nN.norm());
        const Vec3 flat = row.force_nN - row.force_nN.dot(axes.outward) * axes.outward;
        if (flat.norm() > largest.norm()) largest = flat;
    }
    // What is left of outward forces by rounding points anywhere.
    axes.along = largest.norm() > k_end_on * longest_nN ? Vec3(largest.normalized())
                                                        : axes.outward.unitOrthogonal();
    axes.across = axes.outward.cross(axes.along);
    return axes;
}

/// Mean length of the edges at the node, um.
double edge_length_um(const inspect::NodeMoment& moment) {
    const MeshTopology& mesh = *moment.frame->header->topology;
    const int first = moment.forces.cell * mesh.n_nodes();
    double sum = 0.0;
    int n = 0;
    for (const MeshTopology::Edge& edge : mesh.edges) {
        if (edge.i != moment.forces.node && edge.j != moment.forces.node) continue;
        sum +=
            (point(moment.frame->x_um, first + edge.i) - point(moment.frame->x_um, first + edge.j))
                .norm();
        ++n;
    }
    return sum / n;
}

/// One of the two views: x to the right, y up, seen against `towards_eye`.
struct View {
    const char* title;
    const char* subtitle;
    Vec3 x, y, towards_eye;
    double node_y;  ///< where the node stands, share of the height from above
};

class Drawing {
  public:
    Drawing(const inspect::NodeMoment& moment, TextPainter& text)
        : moment_(moment), text_(text), rows_(rows_of(moment.forces)),
          axes_(axes_of(moment, rows_)),
          um_px_(0.5 * k_view_width / (k_edges_across * edge_length_um(moment))) {
        for (const Row& row : rows_) largest_nN_ = std::max(largest_nN_, row.force_nN.norm());
        longest_first_ = rows_;
        std::stable_sort(
            longest_first_.begin(), longest_first_.end(),
            [](const Row& p, const Row& q) { return p.force_nN.norm() > q.force_nN.norm(); });
    }

    Image sheet();

  private:
    void write(Image& image, double x, double y, const std::string& words, double size = 19.0,
               Rgb ink = k_ink, Anchor anchor = Anchor::left, FontStyle font = FontStyle::normal,
               double halo_px = 0.0) {
        text_.draw(image, x, y, words, {size, ink, font, TextMode::plain, halo_px}, anchor);
    }
    void draw_title(Image& image);
    void draw_view(const View& view, int y, Image& image);
    void draw_surface(const View& view, PixelPoint node, Image& image);
    void draw_numbers(Image& image);
    void draw_chain(double y0, Image& image);
    void draw_force(const Row& row, PixelPoint from, PixelPoint to, Image& image);
    void draw_scale(double px_per_nN, Image& image);

    const inspect::NodeMoment& moment_;
    TextPainter& text_;
    const std::vector<Row> rows_;
    const Axes axes_;
    const double um_px_;              ///< px for a um
    std::vector<Row> longest_first_;  ///< so that short arrows are drawn over long ones
    double largest_nN_ = 0.0;
};

void Drawing::draw_title(Image& image) {
    const inspect::NodeForces& forces = moment_.forces;
    const RunHeader& run = *moment_.frame->header;
    write(image, k_view_x, 52.0,
          fmt::format("Forces on node {} of cell {}", forces.node, forces.cell), 32.0, k_ink,
          Anchor::left, FontStyle::bold);
    write(image, k_view_x, 88.0,
          fmt::format("{}   {}{}", moment_.frame->stage_name, time_text(moment_.frame->time_s, 2),
                      moment_.frame->frame < 0 ? ""
                                               : fmt::format("   frame {}", moment_.frame->frame)),
          20.0);
    write(image, NodeSheet::k_width_px - 30.0, 52.0,
          shortened(text_, run.title.empty() ? run.scene_name : run.title, {20.0},
                    NodeSheet::k_width_px - 30.0 - k_title_x),
          20.0, k_ink, Anchor::right);
    write(image, NodeSheet::k_width_px - 30.0, 82.0,
          fmt::format("{}, seed {}", run.scene_name, run.seed), 16.0, k_soft_ink, Anchor::right);
}

/// Triangles of the cell that face the eye, far ones first.
void Drawing::draw_surface(const View& view, PixelPoint node, Image& image) {
    const MeshTopology& mesh = *moment_.frame->header->topology;
    const int first = moment_.forces.cell * mesh.n_nodes();
    const Vec3 origin = point(moment_.frame->x_um, first + moment_.forces.node);
    const auto place = [&](const Vec3& x) -> PixelPoint {
        return {node.x + um_px_ * (x - origin).dot(view.x),
                node.y - um_px_ * (x - origin).dot(view.y)};
    };
    struct Facing {
        double depth;
        std::array<PixelPoint, 3> corners;
        double light;
    };
    std::vector<Facing> facing;
    for (const MeshTopology::Triangle& t : mesh.triangles) {
        const std::array<Vec3, 3> x{point(moment_.frame->x_um, first + t[0]),
                                    point(moment_.frame->x_um, first + t[1]),
                                    point(moment_.frame->x_um, first + t[2])};
        const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
        const double towards = normal.dot(view.towards_eye);
        if (towards <= 0.0) continue;
        facing.push_back({(x[0] + x[1] + x[2]).dot(view.towards_eye),
                          {place(x[0]), place(x[1]), place(x[2])},
                          0.72 + 0.28 * towards});
    }
    std::stable_sort(facing.begin(), facing.end(),
                     [](const Facing& p, const Facing& q) { return p.depth < q.depth; });
    for (const Facing& f : facing) {
        fill_convex(image, f.corners, mix({70, 78, 90}, k_surface, f.light));
        for (std::size_t i = 0; i < 3; ++i)
            draw_line(image, f.corners[i], f.corners[(i + 1) % 3], 0.9, k_edge);
    }
}

void Drawing::draw_force(const Row& row, PixelPoint from, PixelPoint to, Image& image) {
    if (std::hypot(to.x - from.x, to.y - from.y) < k_shortest_px) return;
    if (row.is_friction)
        draw_dashed_arrow(image, from, to, 3.0, row.colour());
    else
        draw_arrow(image, from, to, 3.6, row.colour());
}

void Drawing::draw_scale(double px_per_nN, Image& image) {
    if (px_per_nN <= 0.0) return;
    const double bar_nN = nice_step(0.16 * image.width / px_per_nN);
    const double x1 = image.width - 14.0, y = image.height - 14.0;
    draw_arrow(image, {x1 - bar_nN * px_per_nN, y}, {x1, y}, 3.0, k_ink);
    write(image, x1, y - 12.0, fmt::format("{:g} nN", bar_nN), 16.0, k_ink, Anchor::right,
          FontStyle::normal, 2.5);
}

void Drawing::draw_view(const View& view, int y, Image& image) {
    Image part(k_view_width, k_view_height, k_paper);
    const PixelPoint node{0.5 * k_view_width, view.node_y * k_view_height};
    draw_surface(view, node, part);
    // Each view has its own scale: what is large in one may be seen end-on in the other.
    double longest_nN = 0.0;
    for (const Row& row : rows_)
        longest_nN =
            std::max(longest_nN, std::hypot(row.force_nN.dot(view.x), row.force_nN.dot(view.y)));
    const double px_per_nN =
        longest_nN > k_end_on * largest_nN_ ? k_longest * k_view_height / longest_nN : 0.0;
    const auto tip_of = [&](const Vec3& force_nN) -> PixelPoint {
        return {node.x + px_per_nN * force_nN.dot(view.x),
                node.y - px_per_nN * force_nN.dot(view.y)};
    };
    for (const Row& row : longest_first_) draw_force(row, node, tip_of(row.force_nN), part);
    fill_disc(part, node, 5.0, k_white);
    fill_disc(part, node, 3.5, k_ink);
    // Numbers stand a little beyond the tips.
    for (const Row& row : longest_first_) {
        const PixelPoint tip = tip_of(row.force_nN);
        const double length = std::hypot(tip.x - node.x, tip.y - node.y);
        if (length < k_shortest_px) continue;
        const double beyond = (length + 14.0) / length;
        write(part, node.x + beyond * (tip.x - node.x), node.y + beyond * (tip.y - node.y) + 6.0,
              std::to_string(row.number), 17.0, row.colour(), Anchor::middle, FontStyle::bold, 2.5);
    }
    const double bar_um = nice_step(0.16 * k_view_width / um_px_);
    fill_rectangle(part, 12.0, k_view_height - 16.0, 12.0 + bar_um * um_px_, k_view_height - 12.0,
                   k_ink);
    write(part, 12.0, k_view_height - 22.0, fmt::format("{:g} µm", bar_um), 16.0, k_ink,
          Anchor::left, FontStyle::normal, 2.5);
    draw_scale(px_per_nN, part);
    paste(part, k_view_x, y, image);
    write(image, k_view_x, y - 12.0, view.title, 19.0, k_ink, Anchor::left, FontStyle::bold);
    write(image, k_view_x + k_view_width, y - 12.0, view.subtitle, 15.0, k_soft_ink, Anchor::right);
}

void Drawing::draw_numbers(Image& image) {
    constexpr std::array<double, 4> right{1256.0, 1362.0, 1466.0, k_numbers_x1};
    double y = k_side_y - 12.0;
    write(image, k_numbers_x, y, "Forces, nN", 19.0, k_ink, Anchor::left, FontStyle::bold);
    const std::array<const char*, 4> heads{"size", "outward", "along", "across"};
    for (std::size_t i = 0; i < heads.size(); ++i)
        write(image, right[i], y, heads[i], 15.0, k_soft_ink, Anchor::right);
    const double step = rows_.size() > 12 ? 22.0 : 27.0, size = rows_.size() > 12 ? 15.0 : 17.0;
    const auto numbers = [&](const Vec3& f, Rgb ink) {
        const std::array<double, 4> values{f.norm(), f.dot(axes_.outward), f.dot(axes_.along),
                                           f.dot(axes_.across)};
        for (std::size_t i = 0; i < values.size(); ++i)
            write(image, right[i], y, minus_sign(fmt::format("{:.3g}", values[i])), size, ink,
                  Anchor::right);
    };
    const auto line_of = [&](const Row& row) {
        y += step;
        const PixelPoint from{k_numbers_x, y - 6.0}, to{k_numbers_x + 36.0, y - 6.0};
        draw_force(row, from, to, image);
        write(image, k_numbers_x + 64.0, y, std::to_string(row.number), size, row.colour(),
              Anchor::right, FontStyle::bold);
        write(image, k_numbers_x + 74.0, y, row.name, size);
        numbers(row.force_nN, k_ink);
    };
    const auto sum = [&](const std::string& name, const Vec3& force_nN) {
        y += step;
        write(image, k_numbers_x + 74.0, y, name, size, k_ink, Anchor::left, FontStyle::bold);
        numbers(force_nN, k_ink);
    };
    for (const Row& row : rows_)
        if (!row.is_friction) line_of(row);
    sum("sum: drives the node", moment_.forces.drive_nN);
    y += 6.0;
    for (const Row& row : rows_)
        if (row.is_friction) line_of(row);
    sum("residual: sum of all", moment_.forces.residual_nN);
    y += step;
    write(image, k_numbers_x + 74.0, y,
          fmt::format("residual {:.1e} of all sizes together; it moves with {:.3g} µm/s",
                      moment_.forces.residual_nN.norm() / moment_.forces.scale_nN,
                      moment_.forces.v_um_per_s.norm()),
          15.0, k_soft_ink);
    draw_chain(y + 44.0, image);
}

/// The forces head to tail, as from the side.
void Drawing::draw_chain(double y0, Image& image) {
    const int height = static_cast<int>(NodeSheet::k_height_px - 30.0 - y0);
    if (height < 120) return;  // so many rows that there is no room
    std::vector<Vec3> at{Vec3::Zero()};
    for (const Row& row : rows_) at.push_back(at.back() + row.force_nN);
    std::array<double, 2> low{0.0, 0.0}, high{0.0, 0.0};
    for (const Vec3& p : at) {
        const std::array<double, 2> q{p.dot(axes_.along), p.dot(axes_.outward)};
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], q[k]);
            high[k] = std::max(high[k], q[k]);
        }
    }
    Image part(k_chain_width, height, k_paper);
    constexpr double margin = 46.0;
    const double px_per_nN =
        std::min((k_chain_width - 2.0 * margin) / std::max(high[0] - low[0], 1e-30),
                 (height - 2.0 * margin) / std::max(high[1] - low[1], 1e-30));
    const auto place = [&](const Vec3& p) -> PixelPoint {
        return {0.5 * k_chain_width + px_per_nN * (p.dot(axes_.along) - 0.5 * (low[0] + high[0])),
                0.5 * height - px_per_nN * (p.dot(axes_.outward) - 0.5 * (low[1] + high[1]))};
    };
    if (largest_nN_ > 0.0) {
        for (std::size_t i = 0; i < rows_.size(); ++i)
            draw_force(rows_[i], place(at[i]), place(at[i + 1]), part);
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const PixelPoint p = place(at[i]), q = place(at[i + 1]);
            if (std::hypot(q.x - p.x, q.y - p.y) < 4.0 * k_shortest_px) continue;
            write(part, 0.5 * (p.x + q.x) + 12.0, 0.5 * (p.y + q.y) + 6.0,
                  std::to_string(rows_[i].number), 16.0, rows_[i].colour(), Anchor::middle,
                  FontStyle::bold, 2.5);
        }
        fill_disc(part, place(Vec3::Zero()), 5.0, k_ink);
        draw_scale(px_per_nN, part);
    }
    paste(part, k_chain_x, static_cast<int>(y0), image);
    write(image, k_chain_x, y0 - 12.0, "Head to tail", 19.0, k_ink, Anchor::left, FontStyle::bold);
    write(image, k_chain_x + k_chain_width, y0 - 12.0,
          "outward is up; from the dot and back to it: in balance", 15.0, k_soft_ink,
          Anchor::right);
}

Image Drawing::sheet() {
    Image image(NodeSheet::k_width_px, NodeSheet::k_height_px, k_white);
    draw_title(image);
    draw_view({"From the side", "outward is up; dashed: friction", axes_.along, axes_.outward,
               -axes_.across, 0.5},
              k_side_y, image);
    draw_view(
        {"From outside", "along is to the right", axes_.along, axes_.across, axes_.outward, 0.5},
        k_outside_y, image);
    draw_numbers(image);
    return image;
}

}  // namespace

Image NodeSheet::draw(const inspect::NodeMoment& moment) { return Drawing(moment, text_).sheet(); }

PngTexts node_sheet_texts(const inspect::NodeMoment& moment, const std::string& made_by,
                          const std::string& command) {
    const RunHeader& run = *moment.frame->header;
    return {{"Title", fmt::format("Forces on node {} of cell {}, {}", moment.forces.node,
                                  moment.forces.cell, run.title)},
            {"Software", "spheroscope " + made_by},
            {"Command", command},
            {"Scene", run.resolved_scene},
            {"Seed", std::to_string(run.seed)},
            {"Frame", std::to_string(moment.frame->frame)},
            {"Time", fmt::format("{} s", moment.frame->time_s)}};
}

}  // namespace spheroscope::render
