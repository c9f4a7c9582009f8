#include "engine/cli/contact_output.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/report_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace spheroscope::cli {
namespace {

using inspect::ContactSummary;
using reports::Missing;
using reports::ReportTable;
using reports::TableCell;

TableCell number(double value) {
    return std::isfinite(value) ? TableCell(value) : TableCell(Missing{"-"});
}
TableCell count(int value) { return std::int64_t{value}; }

bool is_count(const inspect::Quantity& quantity) {
    return std::holds_alternative<int ContactSummary::*>(quantity.member);
}

/// um repeat h0 and would make rows too long for a screen.
bool is_shown(const inspect::Quantity& quantity) {
    return quantity.name != "mean_overlap_um" && quantity.name != "largest_overlap_um";
}

void add_quantity_columns(ReportTable& table) {
    for (const inspect::Quantity& quantity : inspect::all_quantities())
        table.columns.push_back({std::string(quantity.name), is_shown(quantity)});
}

void add_quantities(const ContactSummary& summary, std::vector<TableCell>& row) {
    for (const inspect::Quantity& quantity : inspect::all_quantities()) {
        const double value = inspect::value_of(quantity, summary);
        row.push_back(is_count(quantity) ? count(static_cast<int>(value)) : number(value));
    }
}

nlohmann::json points_json(const std::vector<inspect::PlanePoint>& points) {
    nlohmann::json rows = nlohmann::json::array();
    for (const inspect::PlanePoint& p : points)
        rows.push_back({{"u_um", p.u_um},
                        {"v_um", p.v_um},
                        {"overlap_um", p.overlap_um},
                        {"pressure_kPa", p.pressure_kPa}});
    return rows;
}

nlohmann::json stresses_json(const std::vector<inspect::TriangleStress>& stresses) {
    nlohmann::json rows = nlohmann::json::array();
    for (const inspect::TriangleStress& s : stresses)
        rows.push_back({{"triangle", s.triangle}, {"sigma_nn_kPa", s.sigma_nn_kPa}});
    return rows;
}

double law_kPa(const inspect::ContactReport& report, double overlap_um) {
    return report.k_kPa_per_um * overlap_um - report.P0_kPa;
}

}  // namespace

ReportTable contacts_table(const std::vector<ContactSummary>& rows) {
    ReportTable table{{{"contact"}, {"cell_a", false}, {"cell_b", false}}, {}};
    add_quantity_columns(table);
    for (const ContactSummary& summary : rows) {
        std::vector<TableCell> row{summary.key.text(), count(summary.key.cell_a),
                                   count(summary.key.cell_b)};
        add_quantities(summary, row);
        table.rows.push_back(std::move(row));
    }
    return table;
}

ReportTable history_table(const std::vector<ContactSummary>& history) {
    ReportTable table{{{"frame"}, {"time_s"}, {"exists"}}, {}};
    add_quantity_columns(table);
    for (const ContactSummary& summary : history) {
        std::vector<TableCell> row{count(summary.frame), summary.time_s, summary.exists};
        add_quantities(summary, row);
        table.rows.push_back(std::move(row));
    }
    return table;
}

ReportTable events_table(const std::vector<inspect::ContactEvent>& events) {
    ReportTable table{{{"event"}, {"frame"}, {"time_s"}, {"force_before_nN"}, {"force_after_nN"}},
                      {}};
    for (const inspect::ContactEvent& event : events)
        table.rows.push_back({std::string(inspect::name_of(event.kind)), count(event.frame),
                              event.time_s, number(event.force_before_nN),
                              number(event.force_after_nN)});
    return table;
}

ReportTable map_table(const inspect::ContactReport& report) {
    ReportTable table{{{"triangle_a"},
                       {"triangle_b"},
                       {"u_um"},
                       {"v_um"},
                       {"area_um2"},
                       {"overlap_um"},
                       {"pressure_kPa"},
                       {"law_kPa"}},
                      {}};
    for (const inspect::MapPolygon& polygon : report.map) {
        double u_um = 0.0, v_um = 0.0;
        for (const inspect::PlanePoint& corner : polygon.corners) {
            u_um += corner.u_um / static_cast<double>(polygon.corners.size());
            v_um += corner.v_um / static_cast<double>(polygon.corners.size());
        }
        table.rows.push_back(
            {count(polygon.triangle_a),
             polygon.triangle_b < 0 ? TableCell(Missing{"-"}) : count(polygon.triangle_b), u_um,
             v_um, polygon.area_um2, polygon.overlap_um, polygon.pressure_kPa,
             law_kPa(report, polygon.overlap_um)});
    }
    return table;
}

ReportTable section_table(const inspect::ContactReport& report) {
    ReportTable table{{{"u_um"}, {"overlap_h0"}, {"pressure_kPa"}, {"law_kPa"}}, {}};
    for (const inspect::SectionPoint& point : report.section)
        table.rows.push_back({0.5 * (point.u_low_um + point.u_high_um),
                              point.overlap_um / report.h0_um, point.pressure_kPa,
                              law_kPa(report, point.overlap_um)});
    return table;
}

ReportTable node_table(const inspect::NodeForces& forces) {
    ReportTable table{{{"force"}, {"x_nN"}, {"y_nN"}, {"z_nN"}, {"size_nN"}}, {}};
    const auto add = [&](const std::string& name, const Vec3& f) {
        table.rows.push_back({name, f.x(), f.y(), f.z(), f.norm()});
    };
    for (const inspect::NodeForce& row : forces.terms) add(row.name, row.force_nN);
    add("sum of these, drives the node", forces.drive_nN);
    for (const inspect::NodeForce& row : forces.frictions) add(row.name, row.force_nN);
    add("residual: sum of all", forces.residual_nN);
    return table;
}

nlohmann::json summary_json(const ContactSummary& summary) {
    nlohmann::json row{{"contact", summary.key.text()}, {"cell_a", summary.key.cell_a},
                       {"cell_b", summary.key.cell_b},  {"frame", summary.frame},
                       {"time_s", summary.time_s},      {"exists", summary.exists}};
    for (const inspect::Quantity& quantity : inspect::all_quantities()) {
        const double value = inspect::value_of(quantity, summary);
        row[std::string(quantity.name)] =
            is_count(quantity) ? nlohmann::json(static_cast<int>(value)) : number_or_null(value);
    }
    return row;
}

nlohmann::json report_json(const inspect::ContactReport& report) {
    nlohmann::json document = summary_json(report.summary);
    document["law"] = {{"name", report.law},
                       {"h0_um", report.h0_um},
                       {"P0_kPa", report.P0_kPa},
                       {"k_kPa_per_um", report.k_kPa_per_um},
                       {"largest_deviation_kPa", report.largest_deviation_kPa}};
    document["mesh_nodes"] = report.mesh_nodes;
    document["plane"] = {{"centre_um", vector_json(report.centre_um)},
                         {"normal", vector_json(report.normal)},
                         {"u", vector_json(report.u)},
                         {"v", vector_json(report.v)}};
    nlohmann::json map = nlohmann::json::array();
    for (const inspect::MapPolygon& polygon : report.map)
        map.push_back({{"triangle_a", polygon.triangle_a},
                       {"triangle_b", polygon.triangle_b < 0 ? nlohmann::json()
                                                             : nlohmann::json(polygon.triangle_b)},
                       {"area_um2", polygon.area_um2},
                       {"overlap_um", polygon.overlap_um},
                       {"pressure_kPa", polygon.pressure_kPa},
                       {"corners", points_json(polygon.corners)},
                       {"quadrature", points_json(polygon.quadrature)}});
    document["map"] = std::move(map);
    nlohmann::json section = nlohmann::json::array();
    for (const inspect::SectionPoint& point : report.section)
        section.push_back({{"u_low_um", point.u_low_um},
                           {"u_high_um", point.u_high_um},
                           {"overlap_um", point.overlap_um},
                           {"pressure_kPa", point.pressure_kPa},
                           {"law_kPa", law_kPa(report, point.overlap_um)},
                           {"law_low_kPa", point.law_low_kPa},
                           {"law_high_kPa", point.law_high_kPa}});
    document["section"] = std::move(section);
    const inspect::Balance& balance = report.balance;
    document["balance"] = {{"force_on_a_nN", vector_json(balance.force_on_a_nN)},
                           {"force_on_b_nN", vector_json(balance.force_on_b_nN)},
                           {"force_sum_nN", vector_json(balance.force_sum_nN)},
                           {"force_scale_nN", balance.force_scale_nN},
                           {"moment_sum_nN_um", vector_json(balance.moment_sum_nN_um)},
                           {"moment_scale_nN_um", balance.moment_scale_nN_um}};
    document["triangles_of_a"] = stresses_json(report.on_a);
    document["triangles_of_b"] = stresses_json(report.on_b);
    return document;
}

nlohmann::json node_json(const inspect::NodeForces& forces) {
    const auto rows = [](const std::vector<inspect::NodeForce>& list) {
        nlohmann::json array = nlohmann::json::array();
        for (const inspect::NodeForce& row : list)
            array.push_back({{"name", row.name}, {"force_nN", vector_json(row.force_nN)}});
        return array;
    };
    return {{"cell", forces.cell},
            {"node", forces.node},
            {"x_um", vector_json(forces.x_um)},
            {"v_um_per_s", vector_json(forces.v_um_per_s)},
            {"terms", rows(forces.terms)},
            {"frictions", rows(forces.frictions)},
            {"drive_nN", vector_json(forces.drive_nN)},
            {"residual_nN", vector_json(forces.residual_nN)},
            {"scale_nN", forces.scale_nN}};
}

nlohmann::json event_json(const inspect::ContactEvent& event) {
    return {{"event", inspect::name_of(event.kind)},
            {"frame", event.frame},
            {"time_s", event.time_s},
            {"force_before_nN", number_or_null(event.force_before_nN)},
            {"force_after_nN", number_or_null(event.force_after_nN)}};
}

std::string report_text(const inspect::ContactReport& report) {
    const ContactSummary& s = report.summary;
    std::string text;
    const auto line = [&](const std::string& name, const std::string& value) {
        text += fmt::format("{:<21}{}\n", name, value);
    };
    line("normal force",
         fmt::format("{:.5g} nN ({})", s.normal_force_nN,
                     s.normal_force_nN > 0.0 ? "they push each other" : "they pull each other"));
    line("shear force", fmt::format("{:.4g} nN", s.shear_force_nN));
    line("along the centres", fmt::format("{:.5g} nN", s.centre_force_nN));
    line("area", fmt::format("{:.5g} um^2", s.area_um2));
    line("mean overlap",
         fmt::format("{:.4g} um = {:.4g} h0", s.mean_overlap_um, s.mean_overlap_h0));
    line("largest overlap",
         fmt::format("{:.4g} um = {:.4g} h0", s.largest_overlap_um, s.largest_overlap_h0));
    line("sigma_nn", fmt::format("{:.4g} ... {:.4g} kPa, tension positive", s.sigma_nn_low_kPa,
                                 s.sigma_nn_high_kPa));
    line("Z", fmt::format("{} (cell {}), {} (cell {})", s.Z_a, s.key.cell_a, s.Z_b, s.key.cell_b));
    line("centre of contact", vector_text(report.centre_um) + " um");
    line("contact normal", fmt::format("{} from cell {} to cell {}", vector_text(report.normal),
                                       s.key.cell_b, s.key.cell_a));
    const inspect::Balance& balance = report.balance;
    line(fmt::format("force on cell {}", s.key.cell_a), vector_text(balance.force_on_a_nN) + " nN");
    line("sum of forces",
         fmt::format("{:.2g} nN, of {:.4g}", balance.force_sum_nN.norm(), balance.force_scale_nN));
    line("sum of moments", fmt::format("{:.2g} nN um, of {:.4g}", balance.moment_sum_nN_um.norm(),
                                       balance.moment_scale_nN_um));
    line("law",
         fmt::format("{}, P = {:.5g} kPa/um * overlap - {:.5g} kPa; largest deviation of a "
                     "pair {:.2g} kPa",
                     report.law, report.k_kPa_per_um, report.P0_kPa, report.largest_deviation_kPa));
    text +=
        fmt::format("\nsection along u = {} through the centre, {} of {}:\n", vector_text(report.u),
                    report.section.size(), counted(report.map.size(), "polygon"));
    return text + section_table(report).aligned_text();
}

std::string node_text(const inspect::NodeForces& forces) {
    return fmt::format("\nforces on node {} of cell {} at {} um, v = {} um/s:\n", forces.node,
                       forces.cell, vector_text(forces.x_um), vector_text(forces.v_um_per_s)) +
           node_table(forces).aligned_text();
}

}  // namespace spheroscope::cli
