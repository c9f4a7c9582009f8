#pragma once

#include "engine/solve/method.hpp"
#include "engine/solve/step_witness.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace spheroscope {

struct NodeOfCell {
    int cell = 0, node = 0;
    [[nodiscard]] std::string text() const;  ///< "17:203", as the command line takes it
    friend bool operator==(const NodeOfCell&, const NodeOfCell&) = default;
};

/// A step taken apart: what it looked at, term after term, and the solves between.
struct StepAnatomy {
    /// One term of the forces, in the order in which they are added up.
    struct Term {
        std::string name;
        double rms_nN = 0.0;      ///< over all nodes, of this term alone
        double before_nN = 0.0;   ///< RMS of the sum of the terms before it
        double after_nN = 0.0;    ///< and of the sum with it: in the last row the residual force
        double largest_nN = 0.0;  ///< of this term on one node,
        NodeOfCell at;            ///< and where
        Vec3 on_node_nN = Vec3::Zero();         ///< on the node that was asked for
        Vec3 on_node_before_nN = Vec3::Zero();  ///< the sum of the terms before, on that node
    };
    /// An evaluation of all forces. Methods of several stages, and steps that were tried again with
    /// a moving wall, have several.
    struct Evaluation {
        double moved_um = 0.0;  ///< largest displacement of a node from the start of the step
        std::int64_t contact_pairs = 0;
        std::vector<Term> terms;
    };
    using Phase = std::variant<Evaluation, SolveHistory>;

    double time_s = 0.0;                ///< at the start
    std::optional<NodeOfCell> node;     ///< that was asked for
    std::vector<Phase> phases;          ///< in their order
    StepOutcome outcome;                ///< what came of it
    Vec3 node_moved_um = Vec3::Zero();  ///< displacement of that node
    double largest_moved_um = 0.0;      ///< and the largest one of all nodes
    NodeOfCell largest_moved;
};

/// Takes the step that `method` would make from this state, which stays as it is, and says what
/// happened on the way. limit_s, freeze_volume_integral: as for Method::advance. Throws Error if
/// there is no such node.
[[nodiscard]] StepAnatomy take_apart(System& system, Method& method, const State& state,
                                     double limit_s, bool freeze_volume_integral,
                                     std::optional<NodeOfCell> node);

}  // namespace spheroscope
