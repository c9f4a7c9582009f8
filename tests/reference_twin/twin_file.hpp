#pragma once

#include "engine/store/hdf5_file.hpp"
#include "tests/reference/made_up_cells.hpp"

#include <string>
#include <string_view>
#include <vector>

// What the independent program in tests/reference/python says about a problem.
namespace spheroscope::test {

/// Two cells that touch, in the order of the file.
struct TwinContact {
    int cell_a, cell_b;
    double area_um2;
};

/// What both programs measure on one configuration.
struct TwinMeasures {
    std::vector<double> volume_um3;   ///< [cells]
    std::vector<double> sigma_h_kPa;  ///< [cells]
    std::vector<TwinContact> contacts;
};

/// One problem of tests/reference/twin.h5 (law `traction`) or twin_variational.h5, "doublet" or
/// "thirteen". The mesh is the twin's own, so that node i is the same node in both programs.
class TwinProblem {
  public:
    /// Throws Error if the file is missing or lacks what is asked of it; so do all functions.
    explicit TwinProblem(const std::string& name, ContactForm form = ContactForm::traction);

    [[nodiscard]] const Model& model() const { return model_; }
    /// The twin's parameters.
    [[nodiscard]] const PartValues& values() const { return values_; }
    [[nodiscard]] std::vector<Vec3> vectors(const std::string& path) const;  ///< [all nodes]
    [[nodiscard]] std::vector<double> numbers(const std::string& path) const;
    [[nodiscard]] double attribute(const std::string& path, const std::string& key) const;
    /// `where`: "configuration", "end", or what else has the measures.
    [[nodiscard]] TwinMeasures measures(const std::string& where) const;

  private:
    [[nodiscard]] std::string object(const std::string& path) const;

    std::string group_;
    hdf5::File file_;
    Model model_;
    PartValues values_;
};

/// The same measures of the engine's last evaluation; contacts ascend like the twin's.
[[nodiscard]] TwinMeasures measures_of(const System& system);

/// Largest |a - b| of two fields on the nodes over the largest |b|.
[[nodiscard]] double relative_difference(std::span<const Vec3> a, std::span<const Vec3> b);

/// Checks that both name the same pairs of cells, and volumes (each), areas (each, over the mean
/// area) and sigma_h (over the mean |sigma_h|) to `tolerance`.
void expect_same_measures(const TwinMeasures& engine, const TwinMeasures& twin, double tolerance);

}  // namespace spheroscope::test
