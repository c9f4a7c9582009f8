#include "render/contact_sheet.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/index.hpp"
#include "render/canvas.hpp"
#include "render/colour_maps.hpp"
#include "render/layers/cell_surfaces.hpp"
#include "render/layers/compose.hpp"
#include "render/layers/furniture.hpp"
#include "render/line_chart.hpp"
#include "render/movie_writer.hpp"
#include "render/osmesa_context.hpp"
#include "render/range.hpp"
#include "render/strokes.hpp"
#include "render/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace spheroscope::render {
namespace {

using inspect::ContactReport;
using inspect::ContactSummary;

constexpr Rgb k_ink{38, 40, 44}, k_soft_ink{104, 108, 116}, k_white{255, 255, 255};
constexpr Rgb k_patch_ink{20, 20, 22};
constexpr double k_Pa_per_kPa = 1000.0;
constexpr int k_n_samples = 2;

// Places, px.
constexpr double k_title_x = 450.0;  // right of the words "Contact 123-456"
constexpr int k_view_x = 30, k_view_width = 520, k_view_height = 380;
constexpr std::array<int, 2> k_view_y{140, 590};
constexpr int k_map_x = 590, k_map_y = 150, k_map_side = 440;
constexpr double k_bar_y = 614.0, k_numbers_x = 1130.0;
constexpr double k_charts_y = 690.0, k_charts_y1 = 985.0;

/// The line of sight in a view of a face: this far from the contact normal. Then the farther cell's
/// face is seen well and the nearer cell stands beside it.
constexpr double k_oblique_rad = 52.0 * std::numbers::pi / 180.0;
/// Between the centres, over the sum of both radii: what that line of sight needs.
constexpr double k_apart = 1.42;

Vec3 point(const std::vector<float>& values, std::size_t i) {
    return {double{values[3 * i]}, double{values[3 * i + 1]}, double{values[3 * i + 2]}};
}

/// "A", "B" and what is left of a picture when both are pulled apart.
struct PulledApart {
    Snapshot cells;                                   ///< two cells
    std::array<Vec3, 2> centre_um;                    ///< A, B
    std::array<std::vector<double>, 2> sigma_nn_kPa;  ///< on the shown triangles; NaN: no contact
    double radius_sum_um = 0.0;
    Vec3 normal = Vec3::UnitZ(), side = Vec3::UnitX();
};

}  // namespace

struct ContactSheet::Hidden {
    std::shared_ptr<const RunHeader> header;
    inspect::ContactKey key;
    std::vector<ContactSummary> history;
    ContactSummary drawn_summary;
    std::shared_ptr<RunHeader> pair_header;
    double largest_Pa = 0.0;
    double map_half_um = 1.0;  ///< half a side of the map
    double largest_seen_Pa = 0.0, largest_area_um2 = 0.0;
    OsmesaContext context;  // before the surfaces: they are destroyed first
    CellSurfaces surfaces;
    TextPainter text;
    Buffers drawn;

    Hidden(std::shared_ptr<const RunHeader> run, const inspect::ContactKey& contact)
        : header(std::move(run)), key(contact),
          context(k_n_samples * k_view_width, k_n_samples * k_view_height) {
        pair_header = std::make_shared<RunHeader>();
        pair_header->topology = header->topology;
        pair_header->n_cells = 2;
        set_ranges();
    }

    void make_room_for(const ContactSummary& row) {
        if (!row.exists || row.is_seeding) return;
        largest_seen_Pa = std::max({largest_seen_Pa, k_Pa_per_kPa * std::abs(row.sigma_nn_low_kPa),
                                    k_Pa_per_kPa * std::abs(row.sigma_nn_high_kPa)});
        largest_area_um2 = std::max(largest_area_um2, row.area_um2);
    }
    void set_ranges() {
        largest_Pa = nice_ceil(std::max(1.0, largest_seen_Pa));
        map_half_um = 1.55 * std::sqrt(std::max(0.1, largest_area_um2) / std::numbers::pi);
    }

    [[nodiscard]] Rgb colour(double sigma_Pa) const {
        return ColourMap::diverging().at(0.5 + 0.5 * sigma_Pa / largest_Pa);
    }
    void write(Image& image, double x, double y, const std::string& words, double size = 19.0,
               Rgb ink = k_ink, Anchor anchor = Anchor::left, FontStyle font = FontStyle::normal,
               TextMode mode = TextMode::plain) {
        text.draw(image, x, y, words, {size, ink, font, mode}, anchor);
    }

    [[nodiscard]] PulledApart pull_apart(const Snapshot& frame,
                                         const std::optional<ContactReport>& report) const;
    void draw_view(const PulledApart& pair, bool shows_a, Image& image);
    void draw_map(const std::optional<ContactReport>& report, Image& image);
    void draw_bar(const std::optional<ContactReport>& report, Image& image);
    void draw_numbers(const ContactSummary& summary, const std::optional<ContactReport>& report,
                      Image& image);
    void draw_charts(double time_s, const std::optional<ContactReport>& report, Image& image);
};

PulledApart ContactSheet::Hidden::pull_apart(const Snapshot& frame,
                                             const std::optional<ContactReport>& report) const {
    const MeshTopology& mesh = *pair_header->topology;
    PulledApart pair;
    pair.cells.header = pair_header;
    const std::array<int, 2> cells{key.cell_a, key.cell_b};
    std::array<Vec3, 2> centre;
    for (std::size_t c = 0; c < 2; ++c) {
        centre[c] = point(frame.centre_um, idx(cells[c]));
        pair.radius_sum_um += double{header->radius_um[idx(cells[c])]};
    }
    pair.normal = report ? report->normal : Vec3((centre[0] - centre[1]).normalized());
    pair.side = report ? report->u : pair.normal.unitOrthogonal();
    const Vec3 middle = 0.5 * (centre[0] + centre[1]);
    const double half_um = 0.5 * k_apart * pair.radius_sum_um;
    const std::size_t n = 3 * idx(mesh.n_nodes());
    for (std::size_t c = 0; c < 2; ++c) {
        // Along the normal only: how the cells stand to each other is kept.
        const double sign = c == 0 ? 1.0 : -1.0;
        const double along = (centre[c] - middle).dot(pair.normal);
        const Vec3 shift = (sign * half_um - along) * pair.normal;
        pair.centre_um[c] = centre[c] + shift - middle;
        const std::size_t first = idx(cells[c]) * n;
        for (std::size_t i = 0; i < n; ++i) {
            const auto axis = static_cast<Eigen::Index>(i % 3);
            pair.cells.x_um.push_back(
                static_cast<float>(double{frame.x_um[first + i]} + shift[axis] - middle[axis]));
            pair.cells.normal.push_back(frame.normal[first + i]);
        }
        std::vector<double>& sigma = pair.sigma_nn_kPa[c];
        sigma.assign(idx(mesh.n_triangles()), std::numeric_limits<double>::quiet_NaN());
        if (!report) continue;
        // A triangle of a coarser mesh has as many parts for each.
        const int n_coarse = 2 * report->mesh_nodes - 4;
        const int n_parts = mesh.n_triangles() / n_coarse;
        for (const inspect::TriangleStress& row : c == 0 ? report->on_a : report->on_b)
            for (int part = 0; part < n_parts; ++part)
                sigma[idx(row.triangle * n_parts + part)] = row.sigma_nn_kPa;
    }
    return pair;
}

void ContactSheet::Hidden::draw_view(const PulledApart& pair, bool shows_a, Image& image) {
    const MeshTopology& mesh = *pair_header->topology;
    std::vector<Rgb> colours;
    for (const auto& sigma : pair.sigma_nn_kPa)
        for (const double value : sigma)
            colours.push_back(std::isnan(value) ? k_absent_colour : colour(k_Pa_per_kPa * value));
    const std::array<int, 2> both{0, 1};
    surfaces.update(pair.cells, both, Place::triangle, colours);

    // A's face looks along -n, so it is seen from there.
    Camera camera;
    const double sign = shows_a ? -1.0 : 1.0;
    camera.towards_eye =
        sign * std::cos(k_oblique_rad) * pair.normal + std::sin(k_oblique_rad) * pair.side;
    camera.right =
        (pair.normal - pair.normal.dot(camera.towards_eye) * camera.towards_eye).normalized();
    camera.up = camera.towards_eye.cross(camera.right);
    // The same in all frames for two round cells of one size; more where one of them needs it.
    double half_width_um =
        0.5 * k_apart * pair.radius_sum_um * std::sin(k_oblique_rad) + 0.56 * pair.radius_sum_um;
    double half_height_um = 0.56 * pair.radius_sum_um;
    constexpr double margin = 1.03;
    for (std::size_t i = 0; i < pair.cells.x_um.size() / 3; ++i) {
        const Vec3 x_um = point(pair.cells.x_um, i);
        half_width_um = std::max(half_width_um, margin * std::abs(x_um.dot(camera.right)));
        half_height_um = std::max(half_height_um, margin * std::abs(x_um.dot(camera.up)));
    }
    camera.px_per_um =
        std::min(0.5 * k_view_width / half_width_um, 0.46 * k_view_height / half_height_um);
    camera.centre_x_px = 0.5 * k_view_width;
    camera.centre_y_px = 0.5 * k_view_height;
    Camera drawn_camera = camera;
    drawn_camera.px_per_um *= k_n_samples;
    drawn_camera.centre_x_px *= k_n_samples;
    drawn_camera.centre_y_px *= k_n_samples;
    context.draw(surfaces.actor(), drawn_camera, 2.5 * pair.radius_sum_um, drawn);
    Image view = make_image(drawn, k_n_samples, drawn_camera.px_per_um);

    // The patch of the cell whose face is seen, outlined.
    const std::size_t c = shows_a ? 0 : 1;
    const auto node = [&](int i) {
        return point(pair.cells.x_um, c * idx(mesh.n_nodes()) + idx(i));
    };
    for (const MeshTopology::Edge& edge : mesh.edges) {
        const bool left = !std::isnan(pair.sigma_nn_kPa[c][idx(edge.left)]);
        const bool right = !std::isnan(pair.sigma_nn_kPa[c][idx(edge.right)]);
        if (left == right) continue;
        const auto& corners = mesh.triangles[idx(left ? edge.left : edge.right)];
        const Vec3 outward =
            (node(corners[1]) - node(corners[0])).cross(node(corners[2]) - node(corners[0]));
        if (outward.dot(camera.towards_eye) <= 0.0) continue;
        const Camera::Pixel p = camera.project(node(edge.i)), q = camera.project(node(edge.j));
        draw_line(view, {p.x, p.y}, {q.x, q.y}, 2.0, k_patch_ink);
    }
    const double bar_um = nice_step(0.2 * k_view_width / camera.px_per_um);
    fill_rectangle(view, 8.0, k_view_height - 12.0, 8.0 + bar_um * camera.px_per_um,
                   k_view_height - 8.0, k_ink);
    write(view, 8.0, k_view_height - 18.0, fmt::format("{:g} µm", bar_um), 16.0);
    const int y = k_view_y[c];
    paste(view, k_view_x, y, image);
    write(image, k_view_x, y - 14.0,
          fmt::format("Face of cell {} ({}), contact outlined", shows_a ? key.cell_a : key.cell_b,
                      shows_a ? "A" : "B"),
          19.0, k_ink, Anchor::left, FontStyle::bold);
    write(image, k_view_x + k_view_width, y + 14.0, "grey: no contact of A and B", 14.0, k_soft_ink,
          Anchor::right);
    for (std::size_t cell = 0; cell < 2; ++cell) {
        const Camera::Pixel p = camera.project(pair.centre_um[cell]);
        write(
            image, k_view_x + p.x, y + k_view_height + 16.0,
            fmt::format("{} = cell {}", cell == 0 ? "A" : "B", cell == 0 ? key.cell_a : key.cell_b),
            16.0, k_soft_ink, Anchor::middle);
    }
}

void ContactSheet::Hidden::draw_map(const std::optional<ContactReport>& report, Image& image) {
    write(image, k_map_x, k_map_y - 14.0, "Pressure in its plane", 19.0, k_ink, Anchor::left,
          FontStyle::bold);
    Image map(k_map_side, k_map_side, {246, 247, 248});
    const double px_per_um = 0.5 * k_map_side / map_half_um;
    const auto place = [&](const inspect::PlanePoint& p) -> PixelPoint {
        return {0.5 * k_map_side + px_per_um * p.u_um, 0.5 * k_map_side - px_per_um * p.v_um};
    };
    if (report) {
        std::vector<std::vector<PixelPoint>> polygons;
        double area_px2 = 0.0;
        for (const inspect::MapPolygon& row : report->map) {
            std::vector<PixelPoint>& corners = polygons.emplace_back();
            for (const inspect::PlanePoint& p : row.corners) corners.push_back(place(p));
            fill_convex(map, corners, colour(-k_Pa_per_kPa * row.pressure_kPa));
            area_px2 += px_per_um * px_per_um * row.area_um2;
        }
        const double mean_px = std::sqrt(area_px2 / static_cast<double>(report->map.size()));
        for (const std::vector<PixelPoint>& corners : polygons)
            for (std::size_t i = 0; i < corners.size(); ++i)
                draw_line(map, corners[i], corners[(i + 1) % corners.size()], 0.7, k_soft_ink,
                          0.55);
        const double dot_px = std::clamp(0.05 * mean_px, 0.4, 1.5);
        for (const inspect::MapPolygon& row : report->map)
            for (const inspect::PlanePoint& p : row.quadrature)
                fill_disc(map, place(p), dot_px, k_ink, 0.75);
        for (double x = 0.0; x < k_map_side; x += 12.0)
            draw_line(map, {x, 0.5 * k_map_side}, {x + 6.0, 0.5 * k_map_side}, 1.5, k_ink, 0.8);
        write(map, k_map_side - 8.0, 0.5 * k_map_side - 8.0, "u", 17.0, k_ink, Anchor::right);
        write(map, k_map_side - 8.0, k_map_side - 12.0,
              report->law == "traction"
                  ? fmt::format("{}, dots: quadrature points",
                                counted(report->map.size(), "clip polygon"))
                  : fmt::format("{} of A, dots: samples", counted(report->map.size(), "triangle")),
              14.0, k_soft_ink, Anchor::right);
    } else {
        write(map, 0.5 * k_map_side, 0.5 * k_map_side, "no contact in this frame", 19.0, k_soft_ink,
              Anchor::middle);
    }
    const double bar_um = nice_step(0.2 * k_map_side / px_per_um);
    fill_rectangle(map, 12.0, k_map_side - 16.0, 12.0 + bar_um * px_per_um, k_map_side - 12.0,
                   k_ink);
    write(map, 12.0, k_map_side - 22.0, fmt::format("{:g} µm", bar_um), 16.0);
    paste(map, k_map_x, k_map_y, image);
}

void ContactSheet::Hidden::draw_bar(const std::optional<ContactReport>& report, Image& image) {
    const double x0 = k_map_x + 20.0, width = k_map_side - 40.0;
    for (int i = 0; i < static_cast<int>(width); ++i) {
        const double pressure_Pa = largest_Pa * (2.0 * (i + 0.5) / width - 1.0);
        fill_rectangle(image, x0 + i, k_bar_y, x0 + i + 1.0, k_bar_y + 16.0, colour(-pressure_Pa));
    }
    for (const double share : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        const double x = x0 + 0.5 * width * (share + 1.0);
        draw_line(image, {x, k_bar_y + 16.0}, {x, k_bar_y + 22.0}, 1.2, k_ink);
        write(image, x, k_bar_y + 39.0, tick_label(share * largest_Pa, 0.5 * largest_Pa), 16.0,
              k_ink, Anchor::middle);
    }
    // What is beyond either end has colours of its own, and is counted.
    fill_rectangle(image, x0 - 16.0, k_bar_y, x0 - 4.0, k_bar_y + 16.0,
                   ColourMap::diverging().above());
    fill_rectangle(image, x0 + width + 4.0, k_bar_y, x0 + width + 16.0, k_bar_y + 16.0,
                   ColourMap::diverging().below());
    if (report) {
        const auto n_beyond = std::count_if(
            report->map.begin(), report->map.end(), [&](const inspect::MapPolygon& row) {
                return k_Pa_per_kPa * std::abs(row.pressure_kPa) > largest_Pa;
            });
        if (n_beyond > 0)
            write(image, k_map_x + k_map_side, k_map_y - 14.0,
                  counted(n_beyond, "polygon") + " beyond the range", 14.0, k_soft_ink,
                  Anchor::right);
    }
    write(image, x0, k_bar_y + 60.0, "pull", 16.0, k_soft_ink);
    write(image, x0 + 0.5 * width, k_bar_y + 60.0, "P = \u2212σ^c_nn in Pa", 16.0, k_ink,
          Anchor::middle, FontStyle::normal, TextMode::symbol);
    write(image, x0 + width, k_bar_y + 60.0, "push", 16.0, k_soft_ink, Anchor::right);
}

void ContactSheet::Hidden::draw_numbers(const ContactSummary& summary,
                                        const std::optional<ContactReport>& report, Image& image) {
    double y = k_map_y - 14.0;
    write(image, k_numbers_x, y, "Numbers", 19.0, k_ink, Anchor::left, FontStyle::bold);
    y += 8.0;
    const auto line = [&](const std::string& name, const std::string& value) {
        y += 28.0;
        write(image, k_numbers_x, y, name, 18.0, k_soft_ink, Anchor::left, FontStyle::normal,
              TextMode::symbol);
        write(image, ContactSheet::k_width_px - 30.0, y, minus_sign(value), 18.0, k_ink,
              Anchor::right);
    };
    const auto number = [](double value, const char* unit) {
        return std::isnan(value) ? std::string("no contact")
                                 : fmt::format("{:.4g}{}{}", value, *unit == '\0' ? "" : " ", unit);
    };
    line("normal force (> 0: push)", number(summary.normal_force_nN, "nN"));
    line("shear force", number(summary.shear_force_nN, "nN"));
    line("area", number(summary.area_um2, "µm²"));
    line("mean overlap", number(summary.mean_overlap_h0, "h₀"));
    line("largest overlap", number(summary.largest_overlap_h0, "h₀"));
    line("lowest σ^c_nn (push)", number(k_Pa_per_kPa * summary.sigma_nn_low_kPa, "Pa"));
    line("highest σ^c_nn (pull)", number(k_Pa_per_kPa * summary.sigma_nn_high_kPa, "Pa"));
    line(fmt::format("contacts of A, of B"), fmt::format("{}, {}", summary.Z_a, summary.Z_b));
    if (!report) return;
    const inspect::Balance& balance = report->balance;
    y += 12.0;
    line("|sum of forces| / Σ|f|",
         fmt::format("{:.1e}", balance.force_sum_nN.norm() / balance.force_scale_nN));
    line("|sum of moments| / Σ|x||f|",
         fmt::format("{:.1e}", balance.moment_sum_nN_um.norm() / balance.moment_scale_nN_um));
    line("h₀", number(report->h0_um, "µm"));
    line("largest pull of the law P₀", number(k_Pa_per_kPa * report->P0_kPa, "Pa"));
    line("largest |P \u2212 P(δ)|", number(k_Pa_per_kPa * report->largest_deviation_kPa, "Pa"));
    line("contact normal", fmt::format("({:.2f}, {:.2f}, {:.2f})", report->normal.x(),
                                       report->normal.y(), report->normal.z()));
    line("law, nodes per cell", fmt::format("{}, {}", report->law, report->mesh_nodes));
}

void ContactSheet::Hidden::draw_charts(double time_s, const std::optional<ContactReport>& report,
                                       Image& image) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    LineChart profile;
    profile.title = "P along u";
    profile.x_title = "u, µm";
    profile.y_title = "P, Pa";
    LineChart::Series law{"law P(δ)", {0, 114, 178}, {}, {}, false};
    LineChart::Series kernel{"force / area of a polygon", {213, 94, 0}, {}, {}, true};
    if (report)
        for (const inspect::SectionPoint& point : report->section) {
            for (const auto& [u, p] : {std::pair{point.u_low_um, point.law_low_kPa},
                                       std::pair{point.u_high_um, point.law_high_kPa},
                                       std::pair{point.u_high_um, nan}}) {
                law.x.push_back(u);
                law.y.push_back(k_Pa_per_kPa * p);
            }
            kernel.x.push_back(0.5 * (point.u_low_um + point.u_high_um));
            kernel.y.push_back(k_Pa_per_kPa * point.pressure_kPa);
        }
    profile.series = {law, kernel};
    draw_line_chart(image, text, profile, k_map_x - 20.0, k_charts_y, k_map_x + k_map_side + 10.0,
                    k_charts_y1);

    const auto chart_of = [&](const char* title, const char* unit, double ContactSummary::*member,
                              double y0, double y1) {
        LineChart chart;
        chart.title = title;
        chart.x_title = "t, s";
        chart.y_title = unit;
        LineChart::Series series{"", {0, 114, 178}, {}, {}, false};
        for (const ContactSummary& row : history) {
            if (row.is_seeding) continue;
            series.x.push_back(row.time_s);
            series.y.push_back(row.exists ? row.*member : nan);
        }
        chart.series = {series};
        chart.cursor = time_s;
        draw_line_chart(image, text, chart, k_numbers_x - 20.0, y0, k_width_px - 20.0, y1);
    };
    chart_of("Normal force", "nN", &ContactSummary::normal_force_nN, 590.0, 790.0);
    chart_of("Area", "µm²", &ContactSummary::area_um2, 790.0, k_charts_y1);
}

ContactSheet::ContactSheet(std::shared_ptr<const RunHeader> header, const inspect::ContactKey& key)
    : hidden_(std::make_unique<Hidden>(std::move(header), key)) {}

ContactSheet::~ContactSheet() = default;

void ContactSheet::set_history(std::vector<ContactSummary> history) {
    Hidden& h = *hidden_;
    h.history = std::move(history);
    h.largest_seen_Pa = h.largest_area_um2 = 0.0;
    for (const ContactSummary& row : h.history) h.make_room_for(row);
}

Image ContactSheet::draw(const inspect::ContactMoment& moment) {
    Hidden& h = *hidden_;
    const ContactSummary& summary = moment.summary;
    h.make_room_for(summary);
    h.set_ranges();
    h.drawn_summary = summary;
    Image image(k_width_px, k_height_px, k_white);
    h.write(image, k_view_x, 52.0, fmt::format("Contact {}\u2013{}", h.key.cell_a, h.key.cell_b),
            32.0, k_ink, Anchor::left, FontStyle::bold);
    h.write(image, k_view_x, 88.0,
            fmt::format("{}   {}   frame {} of {}", moment.frame->stage_name,
                        time_text(summary.time_s, 2), summary.frame,
                        std::max(h.history.size(), idx(summary.frame) + 1)),
            20.0);
    const RunHeader& run = *h.header;
    h.write(image, k_width_px - 30.0, 52.0,
            shortened(h.text, run.title.empty() ? run.scene_name : run.title, {20.0},
                      k_width_px - 30.0 - k_title_x),
            20.0, k_ink, Anchor::right);
    h.write(image, k_width_px - 30.0, 82.0, fmt::format("{}, seed {}", run.scene_name, run.seed),
            16.0, k_soft_ink, Anchor::right);
    const PulledApart pair = h.pull_apart(*moment.frame, moment.report);
    h.draw_view(pair, true, image);
    h.draw_view(pair, false, image);
    h.draw_map(moment.report, image);
    h.draw_bar(moment.report, image);
    h.draw_numbers(summary, moment.report, image);
    h.draw_charts(summary.time_s, moment.report, image);
    return image;
}

PngTexts ContactSheet::texts(const std::string& made_by, const std::string& command) const {
    const Hidden& h = *hidden_;
    const RunHeader& run = *h.header;
    return {{"Title", "Contact " + h.key.text() + ", " + run.title},
            {"Software", "spheroscope " + made_by},
            {"Command", command},
            {"Scene", run.resolved_scene},
            {"Seed", std::to_string(run.seed)},
            {"Frame", std::to_string(h.drawn_summary.frame)},
            {"Time", fmt::format("{} s", h.drawn_summary.time_s)},
            {"Range", fmt::format("{} ... {} Pa", -h.largest_Pa, h.largest_Pa)}};
}

void write_contact_sheet(const inspect::ContactStory& story, int frame,
                         const std::filesystem::path& png) {
    ContactSheet sheet(story.header, story.key);
    sheet.set_history(story.history);
    const Image image = sheet.draw(story.at(frame));
    write_png(png, image, sheet.texts(story.made_by, story.command_line));
}

void write_contact_movie(const inspect::ContactStory& story, const std::filesystem::path& mp4) {
    MovieWriter::Settings settings;
    settings.path = mp4;
    settings.width_px = ContactSheet::k_width_px;
    settings.height_px = ContactSheet::k_height_px;
    settings.fps = 12.0;
    settings.title = "Contact " + story.key.text() + ", " + story.header->title;
    settings.comment = "spheroscope " + story.made_by + ": " + story.command_line;
    MovieWriter writer(settings);
    ContactSheet sheet(story.header, story.key);
    sheet.set_history(story.history);
    for (const ContactSummary& row : story.history)
        if (!row.is_seeding) writer.add(sheet.draw(story.at(row.frame)));
    writer.finish();
}

}  // namespace spheroscope::render
