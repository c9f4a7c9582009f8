#pragma once

#include "engine/forces/force_term.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace spheroscope::test {

/// Two cells of different size, so that a mistake in an offset or a radius shows; the second one,
/// of radius 9 um, is the one under test.
class TestCell {
  public:
    static constexpr int cell = 1;

    explicit TestCell(int n_nodes, double R_um = 9.0);

    /// The rest shape with normal noise on every coordinate, in units of the mean edge.
    void shake(std::uint64_t seed, double noise);
    /// Brings the geometry up to date with `x`.
    void update();
    [[nodiscard]] std::span<Vec3> x();
    [[nodiscard]] Configuration at() const;
    [[nodiscard]] std::size_t n_nodes() const { return static_cast<std::size_t>(model.n_nodes()); }

    /// Force of the term on this cell's nodes.
    [[nodiscard]] std::vector<Vec3> force_nN(const ForceTerm& term) const;
    /// Precondition: the term has an energy.
    [[nodiscard]] double energy_fJ(const ForceTerm& term) const;

    Model model;
    std::vector<Vec3> x_um;
    std::vector<double> volume_integral_s{0.3, 0.02};
    Geometry geometry;
    Contacts contacts;
    double wall_radius_um = 9.1;
    Load load = made_up_load();  ///< overlaps the rest shape of the second cell

    [[nodiscard]] static Load made_up_load();
};

/// One of every row of force_terms(), in that order, with the paper's case A values; the silent
/// ranges of the regularisation are small enough for shaken cells to leave them.
[[nodiscard]] std::vector<std::unique_ptr<ForceTerm>> make_all_terms();
[[nodiscard]] std::unique_ptr<ForceTerm> make_term(std::size_t row);

/// Names a test after the row of force_terms() that it runs on.
[[nodiscard]] std::string name_of_row(const testing::TestParamInfo<std::size_t>& tested);

[[nodiscard]] double norm(const std::vector<Vec3>& values);
[[nodiscard]] double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace spheroscope::test
