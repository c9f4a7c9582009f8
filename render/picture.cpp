#include "render/picture.hpp"

#include "engine/run/aggregate_shape.hpp"
#include "engine/run/changes.hpp"
#include "engine/run/exploded.hpp"
#include "engine/run/principal_stress.hpp"
#include "engine/scene/picture_size.hpp"
#include "render/layers/cell_surfaces.hpp"
#include "render/layers/compose.hpp"
#include "render/layers/furniture.hpp"
#include "render/layers/load_surfaces.hpp"
#include "render/layers/stress_axes.hpp"
#include "render/osmesa_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spheroscope::render {

namespace {

constexpr double k_filled_share = 0.87;  // of the picture's height by the aggregate's extent
constexpr int k_coarse_px = 2;           // of a picture to each side, for one that is drawn

Vec3 point(const std::vector<float>& values, std::size_t i) {
    return {static_cast<double>(values[3 * i]), static_cast<double>(values[3 * i + 1]),
            static_cast<double>(values[3 * i + 2])};
}

void check_picture(const scene::Picture& picture) {
    for (const int side : picture.size_px)
        if (side < scene::k_smallest_side_px || side > scene::k_largest_side_px)
            throw Error(picture.loc,
                        fmt::format("picture '{}' wants sides of {} to {} pixels, got {} x {}",
                                    picture.name, scene::k_smallest_side_px,
                                    scene::k_largest_side_px, picture.size_px[0],
                                    picture.size_px[1]));
    if (picture.range == "given" && !(picture.given_range[0] < picture.given_range[1]))
        throw Error(picture.loc,
                    fmt::format("picture '{}' wants a range from low to high, got {} to {}",
                                picture.name, picture.given_range[0], picture.given_range[1]));
}

void set_status(Furniture& furniture, const Snapshot& snapshot, int time_decimals) {
    if (shows_field(snapshot)) {
        furniture.short_status = time_text(snapshot.time_s, time_decimals);
        furniture.status = snapshot.stage_name + "   " + furniture.short_status;
        return;
    }
    // Seeding has no model time; how far it has got is what there is to say.
    furniture.status = furniture.short_status = "seeding";
    if (!std::isnan(snapshot.stage_progress))
        furniture.status += fmt::format("   {:.0f} %", 100.0 * snapshot.stage_progress);
}

/// Cells that are pulled apart are no longer under the bead, which is then left out.
bool draws_load(const Snapshot& snapshot, const scene::Picture& picture) {
    return snapshot.load.probe.acts() && picture.exploded == 0.0;
}

std::vector<std::string> notes(const Snapshot& snapshot, const scene::Picture& picture) {
    const Totals& totals = snapshot.totals;
    std::vector<std::string> lines;
    if (std::isfinite(totals.coordination_Z) && totals.coordination_Z > 0.0)
        lines.push_back(fmt::format("Z = {:.1f}", totals.coordination_Z));
    if (std::isfinite(totals.contact_fraction) && totals.contact_fraction > 0.0)
        lines.push_back(fmt::format("contact area {:.0f} %", 100.0 * totals.contact_fraction));
    if (snapshot.load.probe.acts()) {
        lines.push_back(fmt::format("bead {:.1f} nN{}", totals.probe_force_nN,
                                    draws_load(snapshot, picture) ? "" : ", not drawn"));
        lines.push_back(fmt::format("way {:.2f} µm", totals.probe_way_um));
    }
    return lines;
}

/// "γ changed on the way": a run whose numbers are not those of its scene says so.
std::string note_of_changes(const Snapshot& snapshot) {
    std::vector<std::string_view> symbols;
    if (snapshot.changes)
        for (const Change& change : changes_of_motion(*snapshot.changes)) {
            const std::string_view symbol = find_changeable(change.key)->symbol;
            if (std::find(symbols.begin(), symbols.end(), symbol) == symbols.end())
                symbols.push_back(symbol);
        }
    return symbols.empty() ? "" : fmt::format("{} changed on the way", fmt::join(symbols, ", "));
}

/// Distance from the middle of the aggregate within which everything lies that is drawn.
double drawn_extent_um(const Snapshot& snapshot, const scene::Picture& picture) {
    const Probe& probe = snapshot.load.probe;
    double extent_um = aggregate_extent_um(snapshot);
    if (!draws_load(snapshot, picture)) return extent_um;
    const Vec3 centre_um = aggregate_centre_um(snapshot);
    for (const Vec3& x : snapshot.load.hull->vertex_um)
        extent_um = std::max(extent_um, (x - centre_um).norm());
    return std::max(extent_um, (probe.centre_um() - centre_um).norm() + probe.radius_um);
}

/// From the middle of the aggregate to the middle of all that is shown, half way between the far
/// ends of cells and bead; zero without a bead.
Vec3 bead_aside_um(const Snapshot& snapshot, const scene::Picture& picture) {
    const Probe& probe = snapshot.load.probe;
    if (!draws_load(snapshot, picture)) return Vec3::Zero();
    const Vec3 way_um = probe.centre_um() - aggregate_centre_um(snapshot);
    const double beyond_um = way_um.norm() + probe.radius_um - aggregate_extent_um(snapshot);
    return std::max(0.0, 0.5 * beyond_um) * way_um.normalized();
}

}  // namespace

bool shows_field(const Snapshot& snapshot) { return snapshot.stage_name != "anneal"; }

double shown_extent_um(const Snapshot& snapshot, const scene::Picture& picture) {
    return aggregate_extent_um(snapshot) + bead_aside_um(snapshot, picture).norm();
}

int find_picture_field(const RunHeader& header, const scene::Picture& picture) {
    if (picture.field.empty()) return -1;
    std::string held;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        if (header.fields[i]->name == picture.field) return static_cast<int>(i);
        held += (held.empty() ? "" : ", ") + std::string(header.fields[i]->name);
    }
    throw Error(picture.loc,
                fmt::format("picture '{}' wants the field '{}', which the run of {} does not hold",
                            picture.name, picture.field, header.scene_name),
                "fields of this run: " + (held.empty() ? "none" : held));
}

bool holds_stress_axes(const RunHeader& header) {
    return find_stress_components(header).has_value();
}

namespace {

void check_axes(const RunHeader& header, const scene::Picture& picture) {
    if (picture.stress_axes && !holds_stress_axes(header))
        throw Error(picture.loc,
                    fmt::format("picture '{}' wants the axes of stress, whose components the run "
                                "does not hold",
                                picture.name),
                    fmt::format("a scene whose picture says stress_axes = true stores them; or "
                                "measures.fields = [{}]",
                                fmt::join(scene::k_stress_components, ", ")));
}

double mean_radius_um(const RunHeader& header) {
    return std::accumulate(header.radius_um.begin(), header.radius_um.end(), 0.0) / header.n_cells;
}

/// Drawn pixels along each side of a final one.
int most_samples(const scene::Picture& picture) { return picture.smooth ? 2 : 1; }

}  // namespace

struct Renderer::Hidden {
    std::shared_ptr<const RunHeader> header;
    scene::Picture picture;
    std::string difference;
    int field_index = -1;
    const Field* field = nullptr;
    OsmesaContext context;  // before the layers: they are destroyed first
    CellSurfaces surfaces;
    std::unique_ptr<ForceNetwork> network;
    std::unique_ptr<StressAxes> stress_axes;
    std::optional<StressComponents> stress_components;
    std::unique_ptr<LoadSurfaces> load;  // made when the first probe comes
    TextPainter text;
    Buffers cells_drawn, network_drawn, axes_drawn, load_drawn;

    Hidden(std::shared_ptr<const RunHeader> run, const scene::Picture& wanted,
           std::string difference_of_run)
        : header(std::move(run)), difference(std::move(difference_of_run)),
          context(most_samples(wanted) * wanted.size_px[0],
                  most_samples(wanted) * wanted.size_px[1]) {
        set_picture(wanted);
    }

    void set_picture(const scene::Picture& wanted) {
        field_index = find_picture_field(*header, wanted);
        field = field_index < 0 ? nullptr : header->fields[static_cast<std::size_t>(field_index)];
        picture = wanted;
        if (picture.network && network == nullptr)
            network = std::make_unique<ForceNetwork>(mean_radius_um(*header));
        if (picture.stress_axes && stress_axes == nullptr) {
            stress_axes = std::make_unique<StressAxes>(mean_radius_um(*header));
            stress_components = find_stress_components(*header);
        }
    }

    [[nodiscard]] FurnitureLayout layout() const {
        return lay_out_furniture(picture.size_px[0], picture.size_px[1],
                                 {field, picture.network, picture.stress_axes});
    }

    /// Cells that are drawn: all, or with the cutaway those whose centre is not on the near side of
    /// the plane that faces the eye in the middle of the aggregate.
    [[nodiscard]] std::vector<int> drawn_cells(const Snapshot& snapshot, const Camera& camera,
                                               bool cutaway) const {
        std::vector<int> cells;
        for (int c = 0; c < header->n_cells; ++c) {
            const Vec3 centre = point(snapshot.centre_um, static_cast<std::size_t>(c));
            if (!cutaway || camera.project(centre).nearness_um <= 0.0) cells.push_back(c);
        }
        return cells;
    }

    [[nodiscard]] Range choose_range(const Snapshot& snapshot, const View& view) const {
        if (field == nullptr) return {};
        if (view.range) return *view.range;
        if (picture.range == "given") return {picture.given_range[0], picture.given_range[1]};
        RangeFinder finder(*field);
        finder.add(snapshot.fields[static_cast<std::size_t>(field_index)]);
        return finder.range();
    }

    /// Colours the drawn cells; plain tints where no field is shown.
    void colour_cells(const Snapshot& snapshot, const std::vector<int>& cells,
                      Furniture& furniture);
    void draw_network(const Snapshot& snapshot, const Camera& camera, double reach_um, bool cutaway,
                      Furniture& furniture);
    void draw_stress_axes(const Snapshot& snapshot, const std::vector<int>& cells,
                          const Camera& camera, double reach_um, Furniture& furniture);
    void draw_load(const Snapshot& snapshot, const Camera& camera, double reach_um, bool cutaway);
};

void Renderer::Hidden::colour_cells(const Snapshot& snapshot, const std::vector<int>& cells,
                                    Furniture& furniture) {
    std::vector<Rgb> colours;
    if (field == nullptr || !shows_field(snapshot)) {
        for (const int c : cells)
            colours.push_back(mix(plain_cell_colour(c), {255, 255, 255}, furniture.paleness));
        surfaces.update(snapshot, cells, Place::cell, colours);
        return;
    }
    const std::vector<float>& values = snapshot.fields[static_cast<std::size_t>(field_index)];
    const std::size_t n_each = values.size() / static_cast<std::size_t>(header->n_cells);
    for (const int c : cells)
        add_colours(*field, std::span(values).subspan(static_cast<std::size_t>(c) * n_each, n_each),
                    furniture.range, furniture.paleness, colours, furniture.count);
    surfaces.update(snapshot, cells, field->place, colours);
}

void Renderer::Hidden::draw_network(const Snapshot& snapshot, const Camera& camera, double reach_um,
                                    bool cutaway, Furniture& furniture) {
    furniture.network = network->update(snapshot);
    context.draw(network->actor(), camera, reach_um, network_drawn);
    // With the near half taken away the network stands free in it, and the hidden rest is a hint
    // only.
    add_network(cells_drawn, network_drawn, cutaway ? 0.25 : 0.65);
}

void Renderer::Hidden::draw_stress_axes(const Snapshot& snapshot, const std::vector<int>& cells,
                                        const Camera& camera, double reach_um,
                                        Furniture& furniture) {
    furniture.longest_axis_kPa = stress_axes->update(snapshot, *stress_components, cells);
    context.draw(stress_axes->actor(), camera, reach_um, axes_drawn);
    // All rods are inside of cells.
    add_network(cells_drawn, axes_drawn, 0.75);
}

void Renderer::Hidden::draw_load(const Snapshot& snapshot, const Camera& camera, double reach_um,
                                 bool cutaway) {
    if (!load) load = std::make_unique<LoadSurfaces>();
    load->update(snapshot);
    for (vtkActor* actor : {load->hull_behind(), load->probe_behind()}) {
        context.draw(actor, camera, reach_um, load_drawn);
        add_network(cells_drawn, load_drawn, 0.0);
    }
    // A cutaway takes the near side of everything away.
    if (cutaway) return;
    context.draw(load->probe_in_front(), camera, reach_um, load_drawn);
    add_glass(cells_drawn, load_drawn, k_glass_opacity);
}

Renderer::Renderer(std::shared_ptr<const RunHeader> header, const scene::Picture& picture,
                   std::string difference) {
    check_picture(picture);
    static_cast<void>(find_picture_field(*header, picture));  // before OpenGL is asked for anything
    check_axes(*header, picture);
    hidden_ = std::make_unique<Hidden>(std::move(header), picture, std::move(difference));
}

Renderer::~Renderer() = default;

void Renderer::set_picture(const scene::Picture& picture) {
    check_picture(picture);
    check_axes(*hidden_->header, picture);
    hidden_->set_picture(picture);
}

Image Renderer::render(const Snapshot& snapshot, const View& view) {
    SPHEROSCOPE_ASSERT(snapshot.centre_um.size() ==
                           3 * static_cast<std::size_t>(hidden_->header->n_cells),
                       "the snapshot belongs to the renderer's run");
    const double share = hidden_->picture.exploded;
    if (!(share > 0.0)) return draw(snapshot, view);
    View of_all = view;
    if (!view.fit_radius_um) of_all.fit_radius_um = shown_extent_um(snapshot, hidden_->picture);
    return draw(exploded(snapshot, share), of_all);
}

Image Renderer::draw(const Snapshot& snapshot, const View& view) {
    Hidden& h = *hidden_;
    const int n_samples = view.quality == Quality::full ? most_samples(h.picture) : 1;
    const int enlargement = view.quality == Quality::coarse ? k_coarse_px : 1;
    const auto drawn_side = [&](int px) {
        return (n_samples * px + enlargement - 1) / enlargement;
    };
    h.context.set_size(drawn_side(h.picture.size_px[0]), drawn_side(h.picture.size_px[1]));
    const Camera final_camera = camera(snapshot, view);
    Camera drawn_camera = final_camera;
    const double drawn_per_final = static_cast<double>(n_samples) / enlargement;
    drawn_camera.px_per_um *= drawn_per_final;
    drawn_camera.centre_x_px *= drawn_per_final;
    drawn_camera.centre_y_px *= drawn_per_final;
    const double reach_um = 1.05 * drawn_extent_um(snapshot, h.picture);

    Furniture furniture;
    furniture.title = h.header->title.empty() ? h.header->scene_name : h.header->title;
    if (!view.heading.empty()) furniture.title = view.heading;
    furniture.difference = h.difference;
    furniture.layout = h.layout();
    set_status(furniture, snapshot, view.time_decimals);
    furniture.footer = h.header->scene_name;
    furniture.px_per_um = final_camera.px_per_um;
    // A bar or a network beside cells that show neither would be read into them.
    const bool has_mechanics = shows_field(snapshot);
    const bool draws_network = has_mechanics && h.picture.network;
    if (has_mechanics) {
        furniture.notes = notes(snapshot, h.picture);
        furniture.field = h.field;
    }
    // The scale bar holds for the cells, not for the room between them. First: it has to be seen.
    if (h.picture.exploded > 0.0)
        furniture.notes.insert(furniture.notes.begin(),
                               fmt::format("pulled apart by {:g}", h.picture.exploded));
    if (std::string changes = note_of_changes(snapshot); !changes.empty())
        furniture.notes.insert(furniture.notes.begin(), std::move(changes));
    furniture.range = h.choose_range(snapshot, view);
    furniture.range_is_of_this_frame =
        h.field != nullptr && !view.range && h.picture.range != "given";
    const bool draws_axes = has_mechanics && h.picture.stress_axes;
    furniture.paleness = draws_network || draws_axes ? k_paleness_behind_network : 0.0;

    const bool cutaway = view.cutaway.value_or(h.picture.cutaway);
    const std::vector<int> cells = h.drawn_cells(snapshot, final_camera, cutaway);
    h.colour_cells(snapshot, cells, furniture);
    h.context.draw(h.surfaces.actor(), drawn_camera, reach_um, h.cells_drawn);
    if (draws_load(snapshot, h.picture)) h.draw_load(snapshot, drawn_camera, reach_um, cutaway);
    if (draws_axes) h.draw_stress_axes(snapshot, cells, drawn_camera, reach_um, furniture);
    if (draws_network) h.draw_network(snapshot, drawn_camera, reach_um, cutaway, furniture);
    Image image = make_image(h.cells_drawn, n_samples, drawn_camera.px_per_um);
    if (enlargement > 1)
        image = enlarged(image, enlargement, h.picture.size_px[0], h.picture.size_px[1]);
    draw_furniture(image, h.text, furniture);
    return image;
}

Camera Renderer::camera(const Snapshot& snapshot, const View& view) const {
    const Hidden& h = *hidden_;
    const int width = h.picture.size_px[0], height = h.picture.size_px[1];
    Camera camera =
        make_camera(aggregate_centre_um(snapshot),
                    h.picture.azimuth_deg + view.turned_deg + view.progress * h.picture.orbit_deg,
                    h.picture.elevation_deg);
    const FurnitureLayout layout = h.layout();
    const double free_width = width - layout.column_px;
    // No node of the aggregate pulled apart is farther out than this; extents are those of frames
    // as they are.
    const double radius_um =
        (1.0 + h.picture.exploded) *
        (view.fit_radius_um ? *view.fit_radius_um : shown_extent_um(snapshot, h.picture));
    camera.px_per_um = k_filled_share * 0.5 * std::min<double>(height, free_width) / radius_um;
    camera.centre_x_px = 0.5 * free_width;
    camera.centre_y_px = 0.5 * height + 8.0 * layout.scale;  // room for the title
    const Camera::Pixel middle =
        camera.project(camera.focal_um + bead_aside_um(snapshot, h.picture));
    camera.centre_x_px += camera.centre_x_px - middle.x;
    camera.centre_y_px += camera.centre_y_px - middle.y;
    return camera;
}

std::string Renderer::drawn_with() { return hidden_->context.description(); }

const Field* Renderer::field() const { return hidden_->field; }

int Renderer::field_index() const { return hidden_->field_index; }

const scene::Picture& Renderer::picture() const { return hidden_->picture; }

}  // namespace spheroscope::render
