#pragma once

#include "engine/base/error.hpp"
#include "engine/base/vec3.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/model/geometry.hpp"
#include "engine/model/load.hpp"
#include "engine/model/model.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace spheroscope {

class CellStiffness;

/// One configuration of all cells, as terms see it. Geometry and contacts belong to exactly these
/// x.
struct Configuration {
    const Model& model;
    std::span<const Vec3> x_um;                 ///< [all nodes]
    std::span<const double> volume_integral_s;  ///< [cells] I of (13), I' = eps
    const Geometry& geometry;
    const Contacts& contacts;
    double wall_radius_um = 0.0;  ///< of the compaction sphere about the origin
    Load load{};                  ///< hull and probe of an indentation
};

/// A force of the model: adds forces, energy and stiffness, cell by cell; holds no history, so
/// cells can be done in any order by any thread. What a cell's part adds goes to that cell's own
/// nodes only.
class ForceTerm {
  public:
    explicit ForceTerm(Loc loc) : loc_(std::move(loc)) {}
    virtual ~ForceTerm() = default;

    /// The name of its table in the scene, e.g. "cortex.bending".
    [[nodiscard]] virtual std::string_view name() const = 0;
    [[nodiscard]] virtual Need needs() const = 0;
    /// Adds to F_nN [n_nodes of this cell].
    virtual void add_force(const Configuration& at, int cell, std::span<Vec3> F_nN) const = 0;
    /// This cell's share of the stored energy, fJ; empty: the term has none.
    [[nodiscard]] virtual std::optional<double> energy_fJ(const Configuration& at, int cell) const {
        static_cast<void>(at), static_cast<void>(cell);
        return {};
    }
    /// Adds a positive semi-definite approximation of -dF/dx of this cell. Only the speed of
    /// implicit methods depends on it, never their end states.
    virtual void add_stiffness(const Configuration& at, int cell, CellStiffness& K) const {
        static_cast<void>(at), static_cast<void>(cell), static_cast<void>(K);
    }
    /// Where the scene asks for it.
    [[nodiscard]] const Loc& loc() const { return loc_; }

  private:
    Loc loc_;
};

}  // namespace spheroscope
