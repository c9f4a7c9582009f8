#include "engine/reports/pull_off_work.hpp"

#include "engine/stages/build.hpp"

#include <cmath>
#include <limits>

namespace spheroscope::reports {
namespace {

/// Of the trapezoidal rule, over h0. The force is piecewise smooth; steps this long make 1e-3.
constexpr double k_step_h0 = 0.02;
/// Facets at the rim are tilted and touch farther along the line of centres than 2 h0.
constexpr double k_farthest_h0 = 20.0;

class Puller {
  public:
    Puller(const scene::Scene& scene, std::span<const Vec3> x_um, int threads)
        : system_(model_of(scene), build_parts(scene), threads), x_um_(x_um.begin(), x_um.end()) {
        for (const auto& term : system_.parts().terms)
            if (term->name() == "contact") contact_ = term.get();
        SPHEROSCOPE_ASSERT(contact_ != nullptr && x_um_.size() == system_.model().n_all_nodes(),
                           "a scene with contacts, and the positions of its cells");
        integral_s_.assign(system_.model().radius_um.size(), 0.0);
        axis_ = (centre(1) - centre(0)).normalized();
    }

    /// Force that must pull cell 1 away, nN.
    double force_nN() {
        evaluate();
        double force_nN = 0.0;
        for (const Vec3& f : system_.model().cell_nodes(
                 std::span<const Vec3>(forces_nN_ = system_.force_of_term(*contact_)), 1))
            force_nN -= f.dot(axis_);
        return force_nN;
    }
    double contact_energy_fJ() {
        evaluate();
        const Configuration at = system_.configuration();
        return contact_->energy_fJ(at, 0).value_or(0.0) + contact_->energy_fJ(at, 1).value_or(0.0);
    }
    [[nodiscard]] bool touches() const { return system_.contacts().n_pairs() > 0; }
    void move(double distance_um) {
        for (Vec3& x : system_.model().cell_nodes(std::span<Vec3>(x_um_), 1))
            x += distance_um * axis_;
    }

  private:
    static Model model_of(const scene::Scene& scene) {
        return make_model(make_icosphere(scene.cells.nodes), cell_radii(scene, {}),
                          scene.cytosol ? scene.cytosol->target_strain : 0.0);
    }
    [[nodiscard]] Vec3 centre(int cell) const {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& x : system_.model().cell_nodes(std::span<const Vec3>(x_um_), cell))
            sum += x;
        return sum / static_cast<double>(system_.model().n_nodes());
    }
    void evaluate() {
        const auto trouble = system_.evaluate(x_um_, integral_s_, 0.0);
        if (trouble) throw Error(trouble->loc, trouble->text(), "", ExitCode::not_converged);
    }

    System system_;
    std::vector<Vec3> x_um_, forces_nN_;
    std::vector<double> integral_s_;
    const ForceTerm* contact_ = nullptr;
    Vec3 axis_;
};

}  // namespace

double pull_off_work_over_W(const scene::Scene& scene, std::span<const Vec3> x_um, int threads) {
    if (!scene.contact || !scene.contact->adhesive || scene.cells.count != 2)
        throw Error(scene.cells.loc, "stability.pull_off wants two cells that adhere",
                    "add [contact.adhesion], or leave it out");
    Puller pull(scene, x_um, threads);
    const double energy_fJ = pull.contact_energy_fJ();
    if (!(energy_fJ < 0.0)) return std::numeric_limits<double>::quiet_NaN();
    const double step_um = k_step_h0 * scene.contact->h0_um;
    double work_fJ = 0.0, force_nN = pull.force_nN();
    for (double moved_um = 0.0; pull.touches() && moved_um < k_farthest_h0 * scene.contact->h0_um;
         moved_um += step_um) {
        pull.move(step_um);
        const double next_nN = pull.force_nN();
        work_fJ += 0.5 * step_um * (force_nN + next_nN);
        force_nN = next_nN;
    }
    return work_fJ / -energy_fJ;
}

}  // namespace spheroscope::reports
