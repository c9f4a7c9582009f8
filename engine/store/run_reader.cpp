#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/hash_text.hpp"
#include "engine/store/hdf5_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/run_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <variant>

namespace spheroscope {
namespace {

using hdf5::File;

/// An array in which nothing is undefined: a NaN in it would take a cell or a tube out of a
/// picture, or all of it, without a word. `what` is one of its numbers, "a force".
template <class T> std::vector<T> read_finite(const File& file, const std::string& object,
                                              const hdf5::Shape& shape, std::string_view what) {
    std::vector<T> values = file.read_array<T>(object, shape);
    const auto bad = std::find_if_not(values.begin(), values.end(),
                                      [](T value) { return std::isfinite(value); });
    if (bad != values.end())
        file.fail(fmt::format("{} holds {} where {} should be", object, *bad, what));
    return values;
}

std::vector<ContactLink> read_contacts(const File& file, const std::string& step, int n_cells) {
    const hdf5::Shape shape = file.shape(step + "/contacts/pairs");
    const std::uint64_t n = shape.at(0);
    const auto pairs = file.read_array<std::int32_t>(step + "/contacts/pairs", {n, 2});
    const auto forces = read_finite<float>(file, step + "/contacts/force", {n}, "a force");
    const auto areas = read_finite<float>(file, step + "/contacts/area", {n}, "an area");
    std::vector<ContactLink> links;
    for (std::uint64_t k = 0; k < n; ++k) {
        const int a = pairs[2 * k], b = pairs[2 * k + 1];
        if (a < 0 || b <= a || b >= n_cells)
            file.fail(fmt::format("{} has a contact between cells {} and {}", step, a, b));
        links.push_back({a, b, forces[k], areas[k]});
    }
    return links;
}

/// What the writer has left of a load: the probe, whose way begins here, and the hull. Files of
/// earlier versions do not say how the probe moves: its friction is 0 then.
Load read_load(const File& file, const std::string& step) {
    Load load;
    if (!file.exists(step + "/probe")) return load;
    const auto probe =
        read_finite<double>(file, step + "/probe", {4}, "the bead's place or radius");
    load.probe.start_um = Vec3(probe[0], probe[1], probe[2]);
    load.probe.radius_um = probe[3];
    if (file.exists(step + "/probe_motion")) {
        const auto motion = read_finite<double>(file, step + "/probe_motion", {6},
                                                "the bead's way, force, friction or speed");
        load.probe.direction = Vec3(motion[0], motion[1], motion[2]);
        load.probe.force_nN = motion[3];
        load.probe.friction_nN_s_per_um = motion[4];
        load.probe.speed_um_per_s = motion[5];
    }
    const std::string group = run_format::k_hull;
    const std::uint64_t n_vertices = file.shape(group + "/vertices").at(0);
    const std::uint64_t n_triangles = file.shape(group + "/triangles").at(0);
    const auto vertices =
        read_finite<float>(file, group + "/vertices", {n_vertices, 3}, "a position");
    const auto corners = file.read_array<std::int32_t>(group + "/triangles", {n_triangles, 3});
    const std::uint64_t n_planes = file.shape(group + "/planes").at(0);
    const auto planes = read_finite<double>(file, group + "/planes", {n_planes, 4}, "a plane");
    Hull hull;
    for (std::size_t i = 0; i < planes.size(); i += 4)
        hull.planes.push_back({Vec3(planes[i], planes[i + 1], planes[i + 2]), planes[i + 3]});
    for (std::size_t i = 0; i < vertices.size(); i += 3)
        hull.vertex_um.emplace_back(double{vertices[i]}, double{vertices[i + 1]},
                                    double{vertices[i + 2]});
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        for (std::size_t k = i; k < i + 3; ++k)
            if (corners[k] < 0 || static_cast<std::uint64_t>(corners[k]) >= n_vertices)
                file.fail(fmt::format("{} has a triangle with the corner {}", group, corners[k]));
        hull.triangle.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    load.hull = std::make_shared<const Hull>(std::move(hull));
    return load;
}

/// A number that the file's version of the program did not have yet is undefined.
double read_column(const File& file, const run_format::Column& column, int frame) {
    const std::string path = run_format::column_path(column);
    if (!run_format::is_count(column) && !file.exists(path))
        return std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> values = file.read_array<double>(path);
    if (values.size() <= static_cast<std::size_t>(frame))
        file.fail(fmt::format("{} has no value for frame {}", path, frame));
    const double value = values[static_cast<std::size_t>(frame)];
    constexpr double k_largest_count = std::numeric_limits<int>::max();
    const double largest = std::holds_alternative<int Totals::*>(column.member)
                               ? k_largest_count
                               : 9007199254740992.0;  // 2^53: whole numbers are exact up to it
    if (run_format::is_count(column) && !(std::abs(value) <= largest && value == std::trunc(value)))
        file.fail(
            fmt::format("wanted {} of frame {} to be a whole number, got {}", path, frame, value));
    return value;
}

std::optional<std::uint64_t> read_state_hash(const File& file) {
    if (!file.has_attribute("/", run_format::k_state_hash)) return {};  // of an earlier version
    const std::string text = file.text_attribute("/", run_format::k_state_hash);
    if (text.empty()) return {};
    const auto hash = hash_of_text(text);
    if (!hash)
        file.fail(fmt::format("wanted {} to be 16 hexadecimal digits, got '{}'",
                              run_format::k_state_hash, text));
    return hash;
}

RunEnd read_end(const File& file) {
    RunEnd end{file.int_attribute("/", "complete") != 0,
               file.text_attribute("/", "outcome"),
               file.double_attribute("/", "wall_time_s"),
               {},
               read_state_hash(file)};
    for (const std::string_view measure : estimated_measures()) {
        const std::string group = std::string(run_format::k_accuracy) + "/" + std::string(measure);
        if (!file.exists(run_format::k_accuracy) || !file.exists(group)) continue;
        MeasureError error{std::string(measure), file.text_attribute(group, "unit"),
                           file.double_attribute(group, "value")};
        // Earlier versions wrote guesses as well, far too small ones: nothing was measured there.
        if (file.has_attribute(group, "time_is_measured") &&
            file.int_attribute(group, "time_is_measured") != 0)
            error.time = file.double_attribute(group, "time");
        error.mesh = file.double_attribute(group, "mesh");
        error.rest = file.double_attribute(group, "rest");
        if (file.has_attribute(group, "halves_time"))
            error.halves_time = file.text_attribute(group, "halves_time");
        end.errors.push_back(std::move(error));
    }
    return end;
}

}  // namespace

RunFileReader::RunFileReader(std::string path) : path_(std::move(path)) {
    const File file(path_, File::Mode::read);
    header_ = run_format::read_header(file);
    time_s_ = file.read_array<double>("/time");
    const auto bad = std::find_if_not(time_s_.begin(), time_s_.end(),
                                      [](double time_s) { return std::isfinite(time_s); });
    if (bad != time_s_.end())
        file.fail(fmt::format("the time of frame {} is {}", bad - time_s_.begin(), *bad));
    end_ = read_end(file);
    if (file.exists(run_format::k_changes))
        changes_ =
            parse_changes(file.read_text(run_format::k_changes), path_ + run_format::k_changes);
}

double RunFileReader::time(int frame) const {
    if (frame < 0 || frame >= n_frames())
        throw Error(
            Loc{path_},
            fmt::format("wanted frame {}, got a run of {}", frame, counted(n_frames(), "frame")),
            "frames are counted from 0");
    return time_s_[static_cast<std::size_t>(frame)];
}

std::vector<double> RunFileReader::number_of_frames(const std::string& name) const {
    const File file(path_, File::Mode::read);
    for (const run_format::Column& column : run_format::columns())
        if (column.name == name) return file.read_array<double>(run_format::column_path(column));
    file.fail("there is no number '" + name + "' of its frames");
}

/// A change is made with the step that begins at its time, after the frame of that time.
std::shared_ptr<const std::vector<Change>> RunFileReader::changes_before(double time_s) const {
    const auto end = std::find_if(changes_.begin(), changes_.end(),
                                  [&](const Change& change) { return change.time_s >= time_s; });
    if (end == changes_.begin()) return nullptr;
    return std::make_shared<const std::vector<Change>>(changes_.begin(), end);
}

SnapshotPtr RunFileReader::frame(int number) const {
    auto frame = std::make_shared<Snapshot>();
    frame->header = header_;
    frame->frame = number;
    frame->time_s = time(number);

    const File file(path_, File::Mode::read);
    const std::string step = run_format::step_path(number);
    if (!file.exists(step)) file.fail("frame " + std::to_string(number) + " is missing");
    const auto n_cells = static_cast<std::uint64_t>(header_->n_cells);
    const std::uint64_t n_nodes = run_format::n_entries(*header_, Place::node);
    frame->stage = static_cast<int>(file.int_attribute(step, "stage"));
    frame->stage_name = file.text_attribute(step, "stage_name");
    frame->stage_progress = file.double_attribute(step, "stage_progress");
    frame->x_um = read_finite<float>(file, step + "/x", {n_nodes, 3}, "a position");
    frame->normal = read_finite<float>(file, step + "/normal", {n_nodes, 3}, "a direction");
    for (const Field* field : header_->fields)
        frame->fields.push_back(
            file.read_array<float>(run_format::field_path(number, field->name),
                                   {run_format::n_entries(*header_, field->place)}));
    frame->centre_um = read_finite<float>(file, step + "/cells/centre", {n_cells, 3}, "a position");
    frame->pressure_kPa =
        read_finite<float>(file, step + "/cells/pressure", {n_cells}, "a pressure");
    frame->volume_um3 = read_finite<float>(file, step + "/cells/volume", {n_cells}, "a volume");
    frame->links = read_contacts(file, step, header_->n_cells);
    frame->load = read_load(file, step);
    frame->changes = changes_before(frame->time_s);
    for (const run_format::Column& column : run_format::columns())
        run_format::set_column_value(column, *frame, read_column(file, column, number));
    if (file.double_attribute(step, "time_s") != frame->time_s)
        file.fail(fmt::format("{} and /time disagree about the time of frame {}", step, number));
    return frame;
}

}  // namespace spheroscope
