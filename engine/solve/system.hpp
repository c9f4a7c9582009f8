#pragma once

#include "engine/contact/contact_search.hpp"
#include "engine/contact/variational_search.hpp"
#include "engine/forces/confining_hull.hpp"
#include "engine/forces/cytosol_pressure.hpp"
#include "engine/forces/force_term.hpp"
#include "engine/forces/indenting_probe.hpp"
#include "engine/model/state.hpp"
#include "engine/solve/conjugate_gradients.hpp"
#include "engine/solve/friction_matrix.hpp"
#include "engine/solve/step_witness.hpp"
#include "engine/solve/work.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace spheroscope {

/// The parts that a scene names; what is absent is not built.
struct SystemParts {
    std::vector<std::unique_ptr<ForceTerm>> terms;
    const ForceTerm* wall = nullptr;           ///< one of `terms`; acts only while State::wall does
    const ConfiningHull* hull = nullptr;       ///< one of `terms`; likewise with State::load
    const IndentingProbe* probe = nullptr;     ///< likewise
    const ForceTerm* body_force = nullptr;     ///< one of `terms`
    const CytosolPressure* cytosol = nullptr;  ///< one of `terms`
    Frictions frictions;
    std::optional<ContactLaw> contact;
    ContactPrecision contact_precision = ContactPrecision::double_precision;

    /// Whether the term pushes cells from outside: the tables of the scene that it comes from load
    /// all cells, and say nothing of the cells themselves.
    [[nodiscard]] bool is_load(const ForceTerm& term) const {
        return &term == wall || &term == hull || &term == probe || &term == body_force;
    }
};

/// Something went wrong in the numbers; says where, for a message that names term, cell and scene
/// line.
struct Trouble {
    std::string what;
    std::string term;  ///< "" if no single one is to blame
    int cell = -1;
    int node = -1;
    Loc loc;
    int neighbour = -1;  ///< the other node, if it is an edge
    [[nodiscard]] std::string text() const;
};

/// The right-hand side and the matrices of the equation of motion Gamma v = F, of one configuration
/// at a time (a second one can be put aside). Knows no method; methods know no term.
class System {
  public:
    /// `also`: geometry that somebody else than the terms will read (measures).
    System(Model model, SystemParts parts, int n_threads, Need also = Need::none);

    /// Computes geometry, contacts and F at these unknowns, with the wall at wall_radius_um (0:
    /// none) and this load. Returns what is not finite, if anything. Does nothing if the last
    /// evaluation was of the same bits.
    [[nodiscard]] std::optional<Trouble> evaluate(std::span<const Vec3> x_um,
                                                  std::span<const double> volume_integral_s,
                                                  double wall_radius_um, const Load& load = {});

    /// Puts the last evaluation aside and takes up the one that lay there, by exchanging memory:
    /// between two calls a method of several stages looks at another configuration, and then has
    /// the one of its start again. What is put aside is not lost by an evaluation that fails.
    void exchange_evaluations() { std::swap(now_, aside_); }

    // Results of the last evaluation.
    [[nodiscard]] std::span<const Vec3> force_nN() const { return now_.force_nN; }
    [[nodiscard]] const Geometry& geometry() const { return now_.geometry; }
    [[nodiscard]] const Contacts& contacts() const { return now_.contacts; }
    /// Geometry, contacts and unknowns of the last evaluation, as terms and measures read them.
    [[nodiscard]] Configuration configuration() const;
    /// Stored energy of all terms that have one, fJ.
    [[nodiscard]] double energy_fJ();
    /// Whether the term has an effect at present: walls, hulls and probes come and go.
    [[nodiscard]] bool acts(const ForceTerm& term) const {
        if (&term == parts_.wall) return now_.wall_radius_um > 0.0;
        if (&term == parts_.hull) return now_.load.hull != nullptr;
        if (&term == parts_.probe) return now_.load.probe.acts();
        return true;
    }
    /// Force of one term alone at the last evaluation [all nodes].
    [[nodiscard]] std::vector<Vec3> force_of_term(const ForceTerm& term);

    /// (Gamma + dt K) of the last evaluation, assembled when another dt is asked for than last
    /// time; dt = 0: Gamma alone. volume_kPa_s_per_um3 [cells] or empty. Valid until the next call.
    [[nodiscard]] VelocitySystem velocity_system(double dt_s,
                                                 std::span<const double> volume_kPa_s_per_um3);
    /// Coefficient of S S^T in Gamma: K T_d / V*. [cells], or empty if there is no such part.
    [[nodiscard]] std::span<const double> volume_friction() const { return volume_friction_; }

    /// out = Gamma u, with the derivative part of the volume controller. Both [all nodes].
    void friction_product(std::span<const Vec3> u, std::span<Vec3> out);
    /// Solves Gamma v = b in the cheapest way that the scene's frictions allow.
    [[nodiscard]] SolveOutcome solve_friction(std::span<const Vec3> b, std::span<Vec3> v,
                                              double tolerance);
    /// Solves (Gamma + dt K) v = b.
    [[nodiscard]] SolveOutcome solve_implicit(double dt_s,
                                              std::span<const double> volume_kPa_s_per_um3,
                                              std::span<const Vec3> b, std::span<Vec3> v,
                                              double tolerance);

    /// Somebody who is told of every evaluation and every solve; nullptr: nobody.
    void set_witness(StepWitness* witness) { witness_ = witness; }

    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] const SystemParts& parts() const { return parts_; }
    [[nodiscard]] Workers& workers() { return workers_; }
    [[nodiscard]] FrictionShape friction_shape() const { return shape_of(parts_.frictions); }
    [[nodiscard]] Need needs() const { return needs_; }
    [[nodiscard]] Work work() const;
    [[nodiscard]] Work& counters() { return work_; }

  private:
    /// Everything that belongs to one configuration.
    struct Evaluation {
        bool is_valid = false;
        std::vector<Vec3> x_um;
        std::vector<double> volume_integral_s;
        double wall_radius_um = 0.0;
        Load load;
        Geometry geometry;
        Contacts contacts;
        std::vector<Vec3> force_nN;
        ContactOperator pairs;
        CellMatrices cells;
        std::vector<Lanes> volume_gradient_in_single;  // [all nodes], or empty: not needed
        double assembled_dt_s = 0.0;  // of `cells` and the stiffness in `pairs`; 0: not there
        bool has_pairs = false;       // the friction in `pairs` is there
    };

    void allocate(Evaluation& evaluation) const;
    [[nodiscard]] std::optional<Trouble> find_trouble();
    void assemble(double dt_s);
    void assemble_cell(int cell, double dt_s, CellMatrix& matrix) const;
    void assemble_friction();
    /// Conjugate gradients, with a report to the witness.
    [[nodiscard]] SolveOutcome iterate(const VelocitySystem& system,
                                       const Preconditioner& preconditioner, double dt_s,
                                       std::span<const Vec3> b, std::span<Vec3> v,
                                       double tolerance);

    Model model_;
    SystemParts parts_;
    Workers workers_;
    Need needs_ = Need::none;
    std::optional<ContactSearch> search_;                  // law `traction`
    std::optional<VariationalSearch> variational_search_;  // law `variational`
    std::vector<double> drag_;
    std::vector<double> volume_friction_;
    NodeCouplings couplings_;
    Evaluation now_;
    Evaluation aside_;
    std::vector<char> cell_is_finite_;
    // Solvers; made when first used, so a scene that needs none has none.
    std::unique_ptr<ConjugateGradients> conjugate_gradients_;
    std::unique_ptr<CellwiseInverse<Vec3>> friction_inverse_;
    std::unique_ptr<Preconditioner> friction_preconditioner_;
    std::unique_ptr<BlockJacobi> implicit_preconditioner_;
    Work work_;
    StepWitness* witness_ = nullptr;
};

}  // namespace spheroscope
