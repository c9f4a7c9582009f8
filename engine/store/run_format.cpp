#include "engine/store/run_format.hpp"

#include "engine/base/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>

namespace spheroscope::run_format {
namespace {

constexpr std::array k_diagnostics{
    Column{"steps", "1", "accepted steps since the start", &Diagnostics::steps},
    Column{"rejected_steps", "1", "rejected steps since the start", &Diagnostics::rejected_steps},
    Column{"linear_iterations", "1", "iterations of the linear solver since the start",
           &Diagnostics::linear_iterations},
    Column{"dt", "s", "last accepted step", &Diagnostics::dt_s},
    Column{"force_residual", "nN", "RMS nodal force of all terms", &Diagnostics::force_residual_nN},
    Column{"force_balance", "nN", "length of the sum of all forces",
           &Diagnostics::force_balance_nN},
    Column{"step_error", "um", "error estimate of the last step", &Diagnostics::step_error_um},
    Column{"wall_radius", "um", "radius of the wall; 0: no wall", &Diagnostics::wall_radius_um},
    Column{"wall_force", "nN", "force of the wall on the cells", &Diagnostics::wall_force_nN},
};

// Stops compiling when a member comes or goes: then the table above needs its row.
[[maybe_unused]] void every_member_has_a_column(const Diagnostics& diagnostics) {
    [[maybe_unused]] const auto& [d1, d2, d3, d4, d5, d6, d7, d8, d9] = diagnostics;
    static_assert(k_diagnostics.size() == 9);
}

std::vector<Column> make_columns() {
    std::vector<Column> columns;
    for (const TotalsRow& row : all_totals())
        std::visit(
            [&](auto member) {
                columns.push_back({row.name, row.unit, row.description, member});
            },
            row.member);
    columns.insert(columns.end(), k_diagnostics.begin(), k_diagnostics.end());
    return columns;
}

/// A header together with the texts that its fields point to.
struct HeaderWithFields {
    RunHeader header;
    std::deque<std::string> texts;
    std::deque<Field> rows;

    std::string_view keep(std::string text) { return texts.emplace_back(std::move(text)); }
};

void write_topology(hdf5::File& file, const RunHeader& header) {
    const MeshTopology& mesh = *header.topology;
    file.create_group("/topology");
    file.write_attribute("/topology", "n_subdivisions", std::int64_t{mesh.n_subdivisions});
    std::vector<std::int32_t> triangles;
    triangles.reserve(static_cast<std::size_t>(header.n_cells) * mesh.triangles.size() * 3);
    for (int cell = 0; cell < header.n_cells; ++cell)
        for (const MeshTopology::Triangle& triangle : mesh.triangles)
            for (const int node : triangle) triangles.push_back(cell * mesh.n_nodes() + node);
    file.write_array<std::int32_t>("/topology/triangles", triangles, {triangles.size() / 3, 3},
                                   hdf5::Packing::gzip);
    std::vector<double> shape;
    for (const Vec3& x : mesh.unit_shape) shape.insert(shape.end(), {x.x(), x.y(), x.z()});
    file.write_array<double>("/topology/unit_shape", shape, {shape.size() / 3, 3},
                             hdf5::Packing::gzip);
    file.write_attribute("/topology/unit_shape", "unit", "um");
}

std::shared_ptr<const MeshTopology> read_topology(const hdf5::File& file, std::uint64_t n_cells) {
    const auto n_nodes = static_cast<std::uint64_t>(file.int_attribute("/", "n_nodes"));
    const auto n_triangles = static_cast<std::uint64_t>(file.int_attribute("/", "n_triangles"));
    const auto all =
        file.read_array<std::int32_t>("/topology/triangles", {n_cells * n_triangles, 3});
    const auto shape = file.read_array<double>("/topology/unit_shape", {n_nodes, 3});
    std::vector<MeshTopology::Triangle> triangles(n_triangles);
    for (std::uint64_t k = 0; k < all.size(); ++k) {
        const std::uint64_t cell = k / (3 * n_triangles), in_cell = k % (3 * n_triangles);
        const std::int64_t node = all[k] - static_cast<std::int64_t>(cell * n_nodes);
        int& corner = triangles[in_cell / 3][in_cell % 3];
        if (cell == 0) corner = static_cast<int>(node);
        if (node < 0 || node >= static_cast<std::int64_t>(n_nodes) || node != corner)
            file.fail(
                fmt::format("/topology/triangles of cell {} is not the mesh of a cell", cell));
    }
    std::vector<Vec3> nodes;
    for (std::size_t i = 0; i < n_nodes; ++i)
        nodes.emplace_back(shape[3 * i], shape[3 * i + 1], shape[3 * i + 2]);
    MeshTopology mesh = make_closed_topology(std::move(triangles), std::move(nodes));
    mesh.n_subdivisions = static_cast<int>(file.int_attribute("/topology", "n_subdivisions"));
    return std::make_shared<const MeshTopology>(std::move(mesh));
}

std::string_view range_name(RangeKind range) {
    return range == RangeKind::signed_about_zero ? "signed_about_zero" : "magnitude";
}

void write_field(hdf5::File& file, const Field& field, std::int64_t index) {
    const std::string group = "/fields/" + std::string(field.name);
    file.create_group(group);
    file.write_attribute(group, "index", index);
    const auto write = [&](const char* name, std::string_view text) {
        file.write_attribute(group, name, std::string(text));
    };
    write("symbol", field.symbol);
    write("unit", field.unit);
    write("shown_unit", field.shown_unit);
    file.write_attribute(group, "shown_per_stored", field.shown_per_stored);
    write("place", place_name(field.place));
    write("range", range_name(field.range));
    write("absent", field.absent);
    write("description", field.description);
    write("source", field.source);
}

Field read_field(const hdf5::File& file, const std::string& name, HeaderWithFields& owner) {
    const std::string group = "/fields/" + name;
    const auto read = [&](const char* attribute) {
        return owner.keep(file.text_attribute(group, attribute));
    };
    Field field{};
    field.name = owner.keep(name);
    field.symbol = read("symbol");
    field.unit = read("unit");
    field.shown_unit = read("shown_unit");
    field.shown_per_stored = file.double_attribute(group, "shown_per_stored");
    field.absent = read("absent");
    field.description = read("description");
    field.source = read("source");
    const std::string_view place = read("place"), range = read("range");
    constexpr std::array k_places{Place::node, Place::triangle, Place::cell};
    const auto found = std::find_if(k_places.begin(), k_places.end(),
                                    [&](Place p) { return place_name(p) == place; });
    if (found == k_places.end())
        file.fail(fmt::format("wanted the place of field {} to be node, triangle or cell, got '{}'",
                              name, place));
    field.place = *found;
    field.range = RangeKind::magnitude;
    if (range == range_name(RangeKind::signed_about_zero))
        field.range = RangeKind::signed_about_zero;
    else if (range != range_name(RangeKind::magnitude))
        file.fail(fmt::format("field {} has the unknown kind of range '{}'", name, range));
    return field;
}

void check_that_it_is_ours(const hdf5::File& file) {
    const std::string format =
        file.has_attribute("/", "format") ? file.text_attribute("/", "format") : "";
    if (format != k_format)
        file.fail(format.empty() ? "wanted a run of spheroscope, got another HDF5 file"
                                 : "wanted a run of spheroscope, got a '" + format + "'");
    const std::int64_t version = file.int_attribute("/", "format_version");
    if (version > k_format_version || version < 1)
        file.fail(
            fmt::format("wanted a run of format 1 to {}, got format {}", k_format_version, version),
            "it was written by version " + file.text_attribute("/", "version"));
}

}  // namespace

std::span<const Column> columns() {
    static const std::vector<Column> columns = make_columns();
    return columns;
}

double column_value(const Column& column, const Snapshot& frame) {
    struct Get {
        const Snapshot& frame;
        double operator()(double Totals::*m) const { return frame.totals.*m; }
        double operator()(int Totals::*m) const { return frame.totals.*m; }
        double operator()(double Diagnostics::*m) const { return frame.diagnostics.*m; }
        double operator()(std::int64_t Diagnostics::*m) const {
            return static_cast<double>(frame.diagnostics.*m);
        }
    };
    return std::visit(Get{frame}, column.member);
}

bool is_count(const Column& column) {
    return std::holds_alternative<int Totals::*>(column.member) ||
           std::holds_alternative<std::int64_t Diagnostics::*>(column.member);
}

void set_column_value(const Column& column, Snapshot& frame, double value) {
    struct Set {
        Snapshot& frame;
        double value;
        void operator()(double Totals::*m) const { frame.totals.*m = value; }
        void operator()(int Totals::*m) const { frame.totals.*m = static_cast<int>(value); }
        void operator()(double Diagnostics::*m) const { frame.diagnostics.*m = value; }
        void operator()(std::int64_t Diagnostics::*m) const {
            frame.diagnostics.*m = static_cast<std::int64_t>(value);
        }
    };
    std::visit(Set{frame, value}, column.member);
}

std::string column_path(const Column& column) { return "/diagnostics/" + std::string(column.name); }

std::string step_path(int frame) { return fmt::format("/steps/{:06d}", frame); }

std::string field_path(int frame, std::string_view field) {
    return fmt::format("{}/fields/{}", step_path(frame), field);
}

std::uint64_t n_entries(const RunHeader& header, Place place) {
    const auto n_cells = static_cast<std::uint64_t>(header.n_cells);
    if (place == Place::node) return n_cells * header.topology->unit_shape.size();
    if (place == Place::triangle) return n_cells * header.topology->triangles.size();
    return n_cells;
}

std::string_view place_name(Place place) {
    if (place == Place::node) return "node";
    return place == Place::triangle ? "triangle" : "cell";
}

void write_header(hdf5::File& file, const RunHeader& header) {
    SPHEROSCOPE_ASSERT(header.radius_um.size() == static_cast<std::size_t>(header.n_cells),
                       file.path());
    file.write_attribute("/", "format", std::string(k_format));
    file.write_attribute("/", "format_version", k_format_version);
    file.write_attribute("/", "title", header.title);
    file.write_attribute("/", "scene_name", header.scene_name);
    file.write_attribute("/", "seed", header.seed);
    file.write_attribute("/", "version", header.version);
    file.write_attribute("/", "n_cells", std::int64_t{header.n_cells});
    file.write_attribute("/", "n_nodes", std::int64_t{header.topology->n_nodes()});
    file.write_attribute("/", "n_triangles", std::int64_t{header.topology->n_triangles()});
    file.write_attribute("/", "contact_arithmetic", header.contact_arithmetic);
    file.write_text("/command_line", header.command_line);
    file.write_text("/resolved_scene", header.resolved_scene);
    write_topology(file, header);
    file.write_array<float>("/radius", header.radius_um, {header.radius_um.size()});
    file.write_attribute("/radius", "unit", "um");
    file.create_group("/fields");
    for (std::size_t f = 0; f < header.fields.size(); ++f)
        write_field(file, *header.fields[f], static_cast<std::int64_t>(f));
    file.create_group("/diagnostics");
    for (const Column& column : columns()) {
        file.create_column(column_path(column));
        file.write_attribute(column_path(column), "unit", std::string(column.unit));
        file.write_attribute(column_path(column), "description", std::string(column.description));
    }
    file.create_column("/time");
    file.write_attribute("/time", "unit", "s");
    file.create_group("/steps");
}

std::shared_ptr<const RunHeader> read_header(const hdf5::File& file) {
    check_that_it_is_ours(file);
    const auto owner = std::make_shared<HeaderWithFields>();
    RunHeader& header = owner->header;
    header.title = file.text_attribute("/", "title");
    header.scene_name = file.text_attribute("/", "scene_name");
    header.seed = file.unsigned_attribute("/", "seed");
    header.version = file.text_attribute("/", "version");
    // Files of earlier versions do not say.
    if (file.has_attribute("/", "contact_arithmetic"))
        header.contact_arithmetic = file.text_attribute("/", "contact_arithmetic");
    header.command_line = file.read_text("/command_line");
    header.resolved_scene = file.read_text("/resolved_scene");
    const auto n_cells = static_cast<std::uint64_t>(file.int_attribute("/", "n_cells"));
    header.radius_um = file.read_array<float>("/radius", {n_cells});
    header.n_cells = static_cast<int>(n_cells);
    try {
        header.topology = read_topology(file, n_cells);
    } catch (const Error& error) {
        if (!error.loc().file.empty()) throw;
        file.fail(std::string("its mesh is damaged: ") + error.what());
    }
    const std::vector<std::string> names = file.children("/fields");
    header.fields.resize(names.size(), nullptr);
    for (const std::string& name : names) {
        const auto index =
            static_cast<std::uint64_t>(file.int_attribute("/fields/" + name, "index"));
        if (index >= names.size() || header.fields[index] != nullptr)
            file.fail(fmt::format("field {} has the impossible index {}", name, index));
        header.fields[index] = &owner->rows.emplace_back(read_field(file, name, *owner));
    }
    return {owner, &header};
}

}  // namespace spheroscope::run_format
