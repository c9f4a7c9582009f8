#include "engine/reports/error_measures.hpp"

#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace spheroscope::reports {
namespace {

constexpr double k_undefined = std::numeric_limits<double>::quiet_NaN();
/// A field that is smaller than this part of its scale is zero up to round-off: it has no relative
/// error.
constexpr double k_nothing = 1e-5;
/// Half a unit in the last place of single precision.
constexpr double k_single = 6e-8;
constexpr double k_double = 1e-14;

/// RMS of a - b over RMS of b; NaN if there is nothing, or if b is zero on the given scale.
double relative_rms(std::span<const float> a, std::span<const float> b, double scale) {
    if (a.empty() || a.size() != b.size()) return k_undefined;
    double difference2 = 0.0, size2 = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = double{a[i]} - double{b[i]};
        difference2 += d * d;
        size2 += double{b[i]} * double{b[i]};
    }
    if (std::sqrt(size2 / static_cast<double>(b.size())) <= k_nothing * scale) return k_undefined;
    return std::sqrt(difference2 / size2);
}

double positions(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales& scales) {
    if (run.samples.empty() || run.samples.size() != reference.samples.size()) return k_undefined;
    double sum2 = 0.0, n = 0.0;
    for (std::size_t s = 0; s < run.samples.size(); ++s) {
        const std::vector<Vec3>& a = run.samples[s].x_um;
        const std::vector<Vec3>& b = reference.samples[s].x_um;
        for (std::size_t i = 0; i < a.size(); ++i) sum2 += (a[i] - b[i]).squaredNorm();
        n += static_cast<double>(a.size());
    }
    return std::sqrt(sum2 / n) / scales.length_um;
}

double shape(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales& scales) {
    if (run.samples.empty() || reference.samples.empty()) return k_undefined;
    return rms_distance_of_shapes_um(run.samples.back().x_um, reference.samples.back().x_um) /
           scales.length_um;
}

double volume(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales&) {
    const std::vector<double>& a = run.end.volume_um3;
    const std::vector<double>& b = reference.end.volume_um3;
    if (a.empty() || a.size() != b.size()) return k_undefined;
    double sum2 = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum2 += std::pow(a[i] / b[i] - 1.0, 2.0);
    return std::sqrt(sum2 / static_cast<double>(a.size()));
}

double gamma_eff(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales& scales) {
    return relative_rms(run.end.gamma_eff_nN_per_um, reference.end.gamma_eff_nN_per_um,
                        scales.tension_nN_per_um);
}

double sigma_h(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales& scales) {
    return relative_rms(run.end.sigma_h_kPa, reference.end.sigma_h_kPa, scales.pressure_kPa);
}

double contact_area(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales&) {
    const double a = run.end.totals.contact_area_um2, b = reference.end.totals.contact_area_um2;
    return b > 0.0 ? std::abs(a / b - 1.0) : k_undefined;
}

/// RMS over all pairs that touch in either run; a pair that touches in one only has no force in the
/// other.
double pair_force(const MeasuredRun& run, const MeasuredRun& reference, const ErrorScales&) {
    std::map<std::pair<int, int>, std::pair<double, double>> forces;
    for (const ContactLink& link : run.end.links)
        forces[{link.cell_a, link.cell_b}].first = double{link.force_nN};
    for (const ContactLink& link : reference.end.links)
        forces[{link.cell_a, link.cell_b}].second = double{link.force_nN};
    double difference2 = 0.0, size2 = 0.0;
    for (const auto& [cells, force] : forces) {
        difference2 += std::pow(force.first - force.second, 2.0);
        size2 += force.second * force.second;
    }
    return size2 > 0.0 ? std::sqrt(difference2 / size2) : k_undefined;
}

}  // namespace

ErrorScales error_scales(const scene::Scene& scene, const MeasuredRun& reference) {
    ErrorScales scales;
    scales.length_um = scene.contact ? scene.contact->h0_um : edge_um(scene);
    const double pressure_kPa = reference.end.totals.mean_pressure_kPa;
    if (std::isfinite(pressure_kPa)) scales.pressure_kPa = std::abs(pressure_kPa);
    scales.tension_nN_per_um = scales.pressure_kPa * edge_um(scene);
    return scales;
}

std::span<const ErrorMeasure> all_error_measures() {
    static constexpr std::array<ErrorMeasure, 7> rows{{
        {"positions", "Positions", "units of h₀",
         "RMS over nodes and output times of |x - x_ref|, over h0", positions, k_double},
        {"shape", "", "units of h₀", "the same at the end, after the best rigid motion", shape,
         k_double},
        {"volume", "Volume V", "relative", "RMS over cells of V / V_ref - 1", volume, k_double},
        {"gamma_eff", "Surface tension γ_eff", "relative",
         "RMS over nodes of the difference, over RMS of the reference", gamma_eff, k_single},
        {"sigma_h", "Stress of the cells σ_h", "relative",
         "RMS over cells of the difference, over RMS of the reference", sigma_h, k_single},
        {"contact_area", "Contact area", "relative", "|A / A_ref - 1|", contact_area, k_double},
        {"pair_force", "Force between cells", "relative",
         "RMS over touching pairs of the difference, over RMS of the reference", pair_force,
         k_single},
    }};
    return rows;
}

std::vector<double> compute_errors(const MeasuredRun& run, const MeasuredRun& reference,
                                   const ErrorScales& scales) {
    std::vector<double> errors;
    for (const ErrorMeasure& measure : all_error_measures())
        errors.push_back(measure.compute(run, reference, scales));
    return errors;
}

double rms_distance_of_shapes_um(std::span<const Vec3> a, std::span<const Vec3> b) {
    SPHEROSCOPE_ASSERT(a.size() == b.size() && !a.empty(), "two states of the same nodes");
    const auto n = static_cast<double>(a.size());
    Vec3 centre_a = Vec3::Zero(), centre_b = Vec3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i) {
        centre_a += a[i] / n;
        centre_b += b[i] / n;
    }
    Mat3 covariance = Mat3::Zero();
    for (std::size_t i = 0; i < a.size(); ++i)
        covariance += (b[i] - centre_b) * (a[i] - centre_a).transpose();
    const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 signs = Vec3::Ones();
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
    const Mat3 turn = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    double sum2 = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum2 += (turn * (a[i] - centre_a) - (b[i] - centre_b)).squaredNorm();
    return std::sqrt(sum2 / n);
}

}  // namespace spheroscope::reports
