#include "tests/reference_twin/twin_file.hpp"

#include "engine/measures/measure_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spheroscope::test {
namespace {

std::string path_of(ContactForm form) {
    return std::string(SPHEROSCOPE_SOURCE_DIR) + "/tests/reference/" +
           (form == ContactForm::variational ? "twin_variational.h5" : "twin.h5");
}

std::vector<Vec3> as_vectors(const std::vector<double>& flat) {
    std::vector<Vec3> result;
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3)
        result.emplace_back(flat[i], flat[i + 1], flat[i + 2]);
    return result;
}

}  // namespace

TwinProblem::TwinProblem(const std::string& name, ContactForm form)
    : group_("/" + name), file_(path_of(form), hdf5::File::Mode::read) {
    std::vector<MeshTopology::Triangle> triangles;
    const auto corners = file_.read_array<std::int32_t>(object("mesh/triangles"));
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3)
        triangles.push_back({corners[t], corners[t + 1], corners[t + 2]});
    model_ = make_model(std::make_shared<const MeshTopology>(
                            make_closed_topology(std::move(triangles), vectors("mesh/unit_shape"))),
                        numbers("radius"));

    const auto value = [&](const char* key) { return attribute("", key); };
    EXPECT_EQ(value("thickness_um"), k_thickness_um);
    values_.E_kPa = value("E_kPa");
    values_.bending = true;
    values_.gamma_nN_per_um = value("gamma_nN_per_um");
    values_.K_kPa = value("K_kPa");
    values_.T_I_s = value("T_I_s");
    values_.T_d_s = value("T_d_s");
    values_.eta_kPa_s = value("eta_kPa_s");
    values_.eta_f_kPa_s = value("eta_f_kPa_s");
    // Reading `text`: W = omega, and the surfaces touch at rest.
    values_.contact =
        adhesive_law(value("omega_nN_per_um"), value("h0_um"), 2.0, value("reject_cos"));
    values_.contact->form = form;
    const ContactFriction friction{value("friction_normal_kPa_s_per_um"),
                                   value("friction_tangential_kPa_s_per_um")};
    if (friction.normal_kPa_s_per_um > 0.0) values_.contact_friction = friction;
}

std::string TwinProblem::object(const std::string& path) const {
    return path.empty() ? group_ : group_ + "/" + path;
}

std::vector<Vec3> TwinProblem::vectors(const std::string& path) const {
    return as_vectors(numbers(path));
}

std::vector<double> TwinProblem::numbers(const std::string& path) const {
    return file_.read_array<double>(object(path));
}

double TwinProblem::attribute(const std::string& path, const std::string& key) const {
    return file_.double_attribute(object(path), key);
}

TwinMeasures TwinProblem::measures(const std::string& where) const {
    TwinMeasures result{numbers(where + "/volume"), numbers(where + "/sigma_h"), {}};
    const auto cells = file_.read_array<std::int32_t>(object(where + "/contact_cells"));
    const std::vector<double> areas_um2 = numbers(where + "/contact_area");
    for (std::size_t pair = 0; pair < areas_um2.size(); ++pair)
        result.contacts.push_back({cells[2 * pair], cells[2 * pair + 1], areas_um2[pair]});
    return result;
}

TwinMeasures measures_of(const System& system) {
    TwinMeasures result{system.geometry().volume_um3, {}, {}};
    for (const Mat3& stress : cell_stress_tensors(system.configuration()))
        result.sigma_h_kPa.push_back(stress.trace() / 3.0);
    for (const Contacts::Group& group : system.contacts().groups) {
        double area_um2 = 0.0;
        for (const ContactPair& pair : Contacts::pairs_of(group)) area_um2 += pair.area_um2;
        result.contacts.push_back({group.cell_a, group.cell_b, area_um2});
    }
    return result;
}

double relative_difference(std::span<const Vec3> a, std::span<const Vec3> b) {
    EXPECT_EQ(a.size(), b.size());
    double most = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        most = std::max(most, (a[i] - b[i]).norm());
        largest = std::max(largest, b[i].norm());
    }
    EXPECT_GT(largest, 0.0);
    return most / largest;
}

void expect_same_measures(const TwinMeasures& engine, const TwinMeasures& twin, double tolerance) {
    ASSERT_EQ(engine.volume_um3.size(), twin.volume_um3.size());
    ASSERT_EQ(engine.sigma_h_kPa.size(), twin.sigma_h_kPa.size());
    double mean_stress_kPa = 0.0;
    for (const double sigma : twin.sigma_h_kPa)
        mean_stress_kPa += std::abs(sigma) / static_cast<double>(twin.sigma_h_kPa.size());
    for (std::size_t cell = 0; cell < twin.volume_um3.size(); ++cell) {
        SCOPED_TRACE("cell " + std::to_string(cell));
        EXPECT_NEAR(engine.volume_um3[cell] / twin.volume_um3[cell], 1.0, tolerance);
        EXPECT_NEAR((engine.sigma_h_kPa[cell] - twin.sigma_h_kPa[cell]) / mean_stress_kPa, 0.0,
                    tolerance);
    }
    ASSERT_EQ(engine.contacts.size(), twin.contacts.size());
    double mean_area_um2 = 0.0;
    for (const TwinContact& contact : twin.contacts)
        mean_area_um2 += contact.area_um2 / static_cast<double>(twin.contacts.size());
    for (std::size_t pair = 0; pair < twin.contacts.size(); ++pair) {
        const TwinContact &ours = engine.contacts[pair], &theirs = twin.contacts[pair];
        EXPECT_EQ(ours.cell_a, theirs.cell_a);
        EXPECT_EQ(ours.cell_b, theirs.cell_b);
        EXPECT_NEAR((ours.area_um2 - theirs.area_um2) / mean_area_um2, 0.0, tolerance)
            << "cells " << theirs.cell_a << " and " << theirs.cell_b;
    }
}

}  // namespace spheroscope::test
