#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/hash_text.hpp"
#include "engine/scene/same_run.hpp"
#include "engine/store/hdf5_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/run_format.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace spheroscope {
namespace {

using hdf5::File;
using hdf5::Packing;
using hdf5::Shape;

void write_end(File& file, const RunEnd& end) {
    file.write_attribute("/", "complete", std::int64_t{end.is_complete ? 1 : 0});
    file.write_attribute("/", "outcome", end.outcome);
    file.write_attribute("/", "wall_time_s", end.wall_time_s);
    file.write_attribute("/", run_format::k_state_hash,
                         end.state_hash ? hash_text(*end.state_hash) : std::string());
    if (file.exists(run_format::k_accuracy)) file.remove(run_format::k_accuracy);
    if (end.errors.empty()) return;
    file.create_group(run_format::k_accuracy);
    for (const MeasureError& error : end.errors) {
        const std::string group = std::string(run_format::k_accuracy) + "/" + error.measure;
        file.create_group(group);
        file.write_attribute(group, "unit", error.unit);
        file.write_attribute(group, "value", error.value);
        file.write_attribute(group, "time", error.time);
        // Readers of earlier versions take an error without this for a guess.
        file.write_attribute(group, "time_is_measured",
                             std::int64_t{std::isnan(error.time) ? 0 : 1});
        file.write_attribute(group, "halves_time", error.halves_time);
        file.write_attribute(group, "rest", error.rest);
        file.write_attribute(group, "mesh", error.mesh);
    }
}

void write_floats(File& file, const std::string& object, const std::vector<float>& values,
                  const Shape& shape, std::string_view unit) {
    file.write_array<float>(object, values, shape, Packing::gzip);
    file.write_attribute(object, "unit", std::string(unit));
}

void check_positions(const File& file, const Snapshot& frame) {
    const auto n_nodes = static_cast<std::size_t>(frame.header->topology->n_nodes());
    for (std::size_t k = 0; k < frame.x_um.size(); ++k)
        if (!std::isfinite(frame.x_um[k]))
            throw Error(
                Loc{file.path()},
                fmt::format("frame {} is not stored: the position of cell {}, node {} is {}",
                            frame.frame, k / 3 / n_nodes, k / 3 % n_nodes, frame.x_um[k]),
                "the run became unstable", ExitCode::not_converged);
    if (!std::isfinite(frame.time_s))
        throw Error(
            Loc{file.path()},
            fmt::format("frame {} is not stored: its time is {}", frame.frame, frame.time_s), "",
            ExitCode::not_converged);
}

void write_contacts(File& file, const std::string& step, const std::vector<ContactLink>& links) {
    std::vector<std::int32_t> pairs;
    std::vector<float> forces, areas;
    for (const ContactLink& link : links) {
        pairs.insert(pairs.end(), {link.cell_a, link.cell_b});
        forces.push_back(link.force_nN);
        areas.push_back(link.area_um2);
    }
    file.create_group(step + "/contacts");
    file.write_array<std::int32_t>(step + "/contacts/pairs", pairs, {links.size(), 2},
                                   Packing::gzip);
    write_floats(file, step + "/contacts/force", forces, {links.size()}, "nN");
    write_floats(file, step + "/contacts/area", areas, {links.size()}, "um^2");
}

/// The probe of this frame, and the hull, which stands still, once for the whole run.
void write_load(File& file, const std::string& step, const Load& load) {
    const Vec3 centre_um = load.probe.centre_um();
    file.write_array<double>(
        step + "/probe",
        std::array{centre_um.x(), centre_um.y(), centre_um.z(), load.probe.radius_um}, {4});
    file.write_attribute(step + "/probe", "unit", std::string("um"));
    const Probe& probe = load.probe;
    file.write_array<double>(step + "/probe_motion",
                             std::array{probe.direction.x(), probe.direction.y(),
                                        probe.direction.z(), probe.force_nN,
                                        probe.friction_nN_s_per_um, probe.speed_um_per_s},
                             {6});
    if (file.exists(run_format::k_hull)) return;
    const Hull& hull = *load.hull;
    file.create_group(run_format::k_hull);
    std::vector<double> planes;
    for (const Hull::Plane& plane : hull.planes)
        planes.insert(planes.end(),
                      {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset_um});
    file.write_array<double>(run_format::k_hull + std::string("/planes"), planes,
                             {hull.planes.size(), 4});
    std::vector<float> vertices;
    for (const Vec3& x : hull.vertex_um)
        for (const double component : {x.x(), x.y(), x.z()})
            vertices.push_back(static_cast<float>(component));
    std::vector<std::int32_t> triangles;
    for (const auto& triangle : hull.triangle)
        triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    write_floats(file, run_format::k_hull + std::string("/vertices"), vertices,
                 {hull.vertex_um.size(), 3}, "um");
    file.write_array<std::int32_t>(run_format::k_hull + std::string("/triangles"), triangles,
                                   {hull.triangle.size(), 3}, Packing::gzip);
}

void write_step(File& file, const Snapshot& frame) {
    const RunHeader& header = *frame.header;
    const auto n_cells = static_cast<std::uint64_t>(header.n_cells);
    const std::uint64_t n_nodes = run_format::n_entries(header, Place::node);
    SPHEROSCOPE_ASSERT(frame.x_um.size() == 3 * n_nodes, "positions");
    SPHEROSCOPE_ASSERT(frame.fields.size() == header.fields.size(), "fields");

    const std::string step = run_format::step_path(frame.frame);
    file.create_group(step);
    file.write_attribute(step, "time_s", frame.time_s);
    file.write_attribute(step, "stage", std::int64_t{frame.stage});
    file.write_attribute(step, "stage_name", frame.stage_name);
    file.write_attribute(step, "stage_progress", frame.stage_progress);
    write_floats(file, step + "/x", frame.x_um, {n_nodes, 3}, "um");
    write_floats(file, step + "/normal", frame.normal, {n_nodes, 3}, "1");

    file.create_group(step + "/fields");
    for (std::size_t f = 0; f < header.fields.size(); ++f) {
        const Field& field = *header.fields[f];
        const std::string object = run_format::field_path(frame.frame, field.name);
        write_floats(file, object, frame.fields[f], {run_format::n_entries(header, field.place)},
                     field.unit);
        file.write_attribute(object, "place", std::string(run_format::place_name(field.place)));
    }
    file.create_group(step + "/cells");
    write_floats(file, step + "/cells/centre", frame.centre_um, {n_cells, 3}, "um");
    write_floats(file, step + "/cells/pressure", frame.pressure_kPa, {n_cells}, "kPa");
    write_floats(file, step + "/cells/volume", frame.volume_um3, {n_cells}, "um^3");
    write_contacts(file, step, frame.links);
    if (frame.load.probe.acts()) write_load(file, step, frame.load);
}

/// The first thing in which two runs differ, "" if they are the same.
std::string difference(const RunHeader& stored, const RunHeader& wanted) {
    if (stored.seed != wanted.seed)
        return fmt::format("seed {}, got seed {}", wanted.seed, stored.seed);
    if (stored.n_cells != wanted.n_cells)
        return fmt::format("{}, got {}", counted(wanted.n_cells, "cell"), stored.n_cells);
    if (stored.topology->triangles != wanted.topology->triangles)
        return fmt::format("the mesh with {} nodes, got one with {}", wanted.topology->n_nodes(),
                           stored.topology->n_nodes());
    if (stored.radius_um != wanted.radius_um) return "the same radii, got others";
    const auto names = [](const RunHeader& header) {
        std::string text;
        for (const Field* field : header.fields)
            text += (text.empty() ? "" : ", ") + std::string(field->name);
        return text;
    };
    if (names(stored) != names(wanted))
        return fmt::format("the fields {}, got {}", names(wanted), names(stored));
    if (!scene::is_same_run(stored.resolved_scene, wanted.resolved_scene))
        return "the same scene, got another one";
    return "";
}

}  // namespace

RunFileWriter::RunFileWriter(std::unique_ptr<File> file, int n_frames)
    : file_(std::move(file)), n_frames_(n_frames) {}
RunFileWriter::~RunFileWriter() = default;
RunFileWriter::RunFileWriter(RunFileWriter&&) noexcept = default;
RunFileWriter& RunFileWriter::operator=(RunFileWriter&&) noexcept = default;

RunFileWriter RunFileWriter::create(const std::string& path, const RunHeader& header,
                                    Existing existing) {
    std::error_code ignored;  // opening the file says what is wrong
    if (existing == Existing::refuse && std::filesystem::is_regular_file(path, ignored))
        throw Error(Loc{path}, "the file exists already",
                    "choose another output, continue that run with --resume, or remove the file");
    auto file = std::make_unique<File>(path, File::Mode::create);
    run_format::write_header(*file, header);
    write_end(*file, {});
    file->commit();
    return RunFileWriter(std::move(file), 0);
}

RunFileWriter RunFileWriter::append(const std::string& path, const RunHeader& header,
                                    int n_frames) {
    auto file = std::make_unique<File>(path, File::Mode::append);
    const std::string other = difference(*run_format::read_header(*file), header);
    if (!other.empty())
        file->fail("this file cannot be continued: wanted " + other,
                   "resume with the scene, seed and settings of the run");
    const auto kept = static_cast<std::uint64_t>(n_frames);
    const std::uint64_t stored = file->shape("/time").at(0);
    if (kept > stored)
        file->fail(fmt::format("wanted a file with at least {} to continue, got {}",
                               counted(n_frames, "frame"), stored));
    for (const run_format::Column& column : run_format::columns())
        if (!file->exists(run_format::column_path(column)))
            file->fail(fmt::format("this file cannot be continued: it has no {}, another version "
                                   "of the program wrote it",
                                   run_format::column_path(column)),
                       "continue it with that version, or run the scene anew into another folder");
    file->truncate_column("/time", kept);
    for (const run_format::Column& column : run_format::columns())
        file->truncate_column(run_format::column_path(column), kept);
    for (std::uint64_t frame = kept; frame < stored; ++frame)
        file->remove(run_format::step_path(static_cast<int>(frame)));
    write_end(*file, {});
    file->commit();
    return RunFileWriter(std::move(file), n_frames);
}

void RunFileWriter::write(const Snapshot& frame) {
    SPHEROSCOPE_ASSERT(frame.frame == n_frames_, std::to_string(frame.frame));
    check_positions(*file_, frame);
    write_step(*file_, frame);
    for (const run_format::Column& column : run_format::columns())
        file_->append_to_column(run_format::column_path(column),
                                run_format::column_value(column, frame));
    file_->append_to_column("/time", frame.time_s);
    file_->commit();
    ++n_frames_;
}

void RunFileWriter::record_changes(const std::vector<Change>& changes) {
    if (file_->exists(run_format::k_changes)) file_->remove(run_format::k_changes);
    file_->write_text(run_format::k_changes, changes_text(changes));
    file_->commit();
}

void RunFileWriter::finish(const RunEnd& end) {
    write_end(*file_, end);
    file_->commit();
}

}  // namespace spheroscope
