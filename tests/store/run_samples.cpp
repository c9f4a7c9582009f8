#include "run_samples.hpp"

#include "engine/store/run_format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>

namespace spheroscope::samples {
namespace {

const Field k_tension{
    "gamma_eff",          "γ_eff",   "nN/um", "nN/µm", 1.0, Place::node, RangeKind::magnitude, "",
    "Effective tension.", "eqn (1)", nullptr};
const Field k_contact{"sigma_nn",
                      "σ_nn",
                      "kPa",
                      "Pa",
                      1000.0,
                      Place::triangle,
                      RangeKind::signed_about_zero,
                      "no contact",
                      "Normal stress <&> more.",
                      "eqn (3)",
                      nullptr};
const Field k_cell{"sigma_h",
                   "σ_h",
                   "kPa",
                   "Pa",
                   1000.0,
                   Place::cell,
                   RangeKind::signed_about_zero,
                   "",
                   "Hydrostatic stress.",
                   "eqn (4)",
                   nullptr};

std::vector<float> numbers(std::size_t n, double seed) {
    std::vector<float> values(n);
    for (std::size_t k = 0; k < n; ++k)
        values[k] = static_cast<float>(std::sin(seed + 0.37 * static_cast<double>(k)));
    return values;
}

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

std::shared_ptr<const RunHeader> make_header(int n_cells, int n_nodes) {
    auto header = std::make_shared<RunHeader>();
    header->topology = make_icosphere(n_nodes);
    header->n_cells = n_cells;
    header->title = "Zwei Zellen, γ";
    header->scene_name = "pair.toml";
    header->resolved_scene.assign(100000, '#');  // longer than an attribute
    header->resolved_scene += "\n[cells]\n";
    header->seed = 0xfedcba9876543210U;
    header->version = "0.1.0-abc";
    header->command_line = "spheroscope run pair.toml";
    header->fields = {&k_contact, &k_tension, &k_cell};  // not in the order of their names
    header->radius_um = numbers(static_cast<std::size_t>(n_cells), 9.0);
    return header;
}

Snapshot make_frame(const std::shared_ptr<const RunHeader>& header, int number) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto n_nodes = run_format::n_entries(*header, Place::node);
    const auto n_triangles = run_format::n_entries(*header, Place::triangle);
    const auto n_cells = static_cast<std::size_t>(header->n_cells);
    const double s = 1.0 + number;
    Snapshot frame;
    frame.header = header;
    frame.frame = number;
    frame.time_s = 0.1 * number;
    frame.stage = number / 2;
    frame.stage_name = number < 2 ? "anneal" : "compact";
    frame.stage_progress = number == 1 ? nan : 0.25 * s;
    frame.x_um = numbers(3 * n_nodes, s);
    frame.normal = numbers(3 * n_nodes, 2 * s);
    frame.fields = {numbers(n_triangles, 3 * s), numbers(n_nodes, 4 * s), numbers(n_cells, 5 * s)};
    frame.fields[0][3] = std::numeric_limits<float>::quiet_NaN();
    frame.centre_um = numbers(3 * n_cells, 6 * s);
    frame.pressure_kPa = numbers(n_cells, 7 * s);
    frame.volume_um3 = numbers(n_cells, 8 * s);
    if (n_cells > 1)
        for (int k = 0; k < number % 3; ++k)
            frame.links.push_back({0, 1, static_cast<float>(s) / 3, static_cast<float>(k) / 7});
    if (number > 1) {  // later frames are under load; the hull stays the same
        Hull hull;
        hull.vertex_um = {Vec3(0.5, 0.25, 0.0), Vec3(0.0, 1.5, 0.0), Vec3(0.0, 0.0, 2.75)};
        hull.triangle = {{0, 1, 2}, {2, 1, 0}};
        frame.load.hull = std::make_shared<const Hull>(std::move(hull));
        frame.load.probe.radius_um = 27.1;
        frame.load.probe.start_um = Vec3(0.1 * s, -0.3, 1.0 / 3.0);
        frame.load.probe.direction = Vec3(0.6, 0.0, -0.8);
        frame.load.probe.way_um = 0.25 * s;
        frame.load.probe.force_nN = 15.0;
        frame.load.probe.friction_nN_s_per_um = 25.5;
        frame.load.probe.speed_um_per_s = s / 7.0;
    }
    double value = 11.5 * s;
    for (const run_format::Column& column : run_format::columns()) {
        run_format::set_column_value(column, frame,
                                     run_format::is_count(column) ? std::floor(value) : value);
        value += 1.25;
    }
    frame.totals.sigma_h_rim_kPa = nan;
    return frame;
}

namespace {

bool same_load(const Load& got, const Load& wanted) {
    const auto motion = [](const Probe& probe) {
        return std::tuple(probe.force_nN, probe.friction_nN_s_per_um, probe.speed_um_per_s);
    };
    if (got.probe.radius_um != wanted.probe.radius_um ||
        got.probe.centre_um() != wanted.probe.centre_um() ||
        got.probe.direction != wanted.probe.direction || motion(got.probe) != motion(wanted.probe))
        return false;
    if ((got.hull == nullptr) != (wanted.hull == nullptr)) return false;
    return got.hull == nullptr || (got.hull->vertex_um == wanted.hull->vertex_um &&
                                   got.hull->triangle == wanted.hull->triangle);
}

}  // namespace

bool is_equal(const Snapshot& got, const Snapshot& wanted) {
    bool equal = got.frame == wanted.frame && same_number(got.time_s, wanted.time_s) &&
                 got.stage == wanted.stage && got.stage_name == wanted.stage_name &&
                 same_number(got.stage_progress, wanted.stage_progress) &&
                 same_bits(got.x_um, wanted.x_um) && same_bits(got.normal, wanted.normal) &&
                 got.fields.size() == wanted.fields.size() &&
                 same_bits(got.centre_um, wanted.centre_um) &&
                 same_bits(got.pressure_kPa, wanted.pressure_kPa) &&
                 same_bits(got.volume_um3, wanted.volume_um3) &&
                 same_bits(got.links, wanted.links) && same_load(got.load, wanted.load);
    for (std::size_t f = 0; equal && f < wanted.fields.size(); ++f)
        equal = same_bits(got.fields[f], wanted.fields[f]);
    for (const run_format::Column& column : run_format::columns())
        equal = equal && same_number(run_format::column_value(column, got),
                                     run_format::column_value(column, wanted));
    return equal;
}

void expect_equal(const Snapshot& got, const Snapshot& wanted) {
    EXPECT_EQ(got.frame, wanted.frame);
    EXPECT_EQ(got.time_s, wanted.time_s);
    EXPECT_EQ(got.stage, wanted.stage);
    EXPECT_EQ(got.stage_name, wanted.stage_name);
    EXPECT_TRUE(same_number(got.stage_progress, wanted.stage_progress)) << got.stage_progress;
    EXPECT_TRUE(same_bits(got.x_um, wanted.x_um));
    EXPECT_TRUE(same_bits(got.normal, wanted.normal));
    ASSERT_EQ(got.fields.size(), wanted.fields.size());
    for (std::size_t f = 0; f < wanted.fields.size(); ++f)
        EXPECT_TRUE(same_bits(got.fields[f], wanted.fields[f])) << wanted.header->fields[f]->name;
    EXPECT_TRUE(same_bits(got.centre_um, wanted.centre_um));
    EXPECT_TRUE(same_bits(got.pressure_kPa, wanted.pressure_kPa));
    EXPECT_TRUE(same_bits(got.volume_um3, wanted.volume_um3));
    EXPECT_EQ(got.links.size(), wanted.links.size());
    EXPECT_TRUE(same_bits(got.links, wanted.links));
    EXPECT_TRUE(same_load(got.load, wanted.load));
    for (const run_format::Column& column : run_format::columns())
        EXPECT_TRUE(same_number(run_format::column_value(column, got),
                                run_format::column_value(column, wanted)))
            << column.name;
}

void expect_equal(const RunHeader& got, const RunHeader& wanted) {
    EXPECT_EQ(got.n_cells, wanted.n_cells);
    EXPECT_EQ(got.title, wanted.title);
    EXPECT_EQ(got.scene_name, wanted.scene_name);
    EXPECT_EQ(got.resolved_scene, wanted.resolved_scene);
    EXPECT_EQ(got.seed, wanted.seed);
    EXPECT_EQ(got.version, wanted.version);
    EXPECT_EQ(got.command_line, wanted.command_line);
    EXPECT_EQ(got.radius_um, wanted.radius_um);
    EXPECT_EQ(got.topology->n_subdivisions, wanted.topology->n_subdivisions);
    EXPECT_EQ(got.topology->triangles, wanted.topology->triangles);
    EXPECT_EQ(got.topology->neighbours, wanted.topology->neighbours);
    EXPECT_EQ(got.topology->unit_shape, wanted.topology->unit_shape);
    ASSERT_EQ(got.fields.size(), wanted.fields.size());
    for (std::size_t f = 0; f < wanted.fields.size(); ++f) {
        const Field &a = *got.fields[f], &b = *wanted.fields[f];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.symbol, b.symbol);
        EXPECT_EQ(a.unit, b.unit);
        EXPECT_EQ(a.shown_unit, b.shown_unit);
        EXPECT_EQ(a.shown_per_stored, b.shown_per_stored);
        EXPECT_EQ(a.place, b.place);
        EXPECT_EQ(a.range, b.range);
        EXPECT_EQ(a.absent, b.absent);
        EXPECT_EQ(a.description, b.description);
        EXPECT_EQ(a.source, b.source);
    }
}

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "spheroscope.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;  // a test may have left it on purpose
    std::filesystem::remove_all(path_, ignored);
}

std::string Folder::list() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        names.insert(entry.path().filename().string());
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
    return text;
}

std::string read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace spheroscope::samples
