#pragma once

#include "engine/base/workers.hpp"

#include <algorithm>

namespace spheroscope {

/// Which cells have their matrices side by side (CellMatrices): cells in fours, as they have the
/// same mesh and one instruction then does the same for four of them. What four do not divide is
/// left as teams of one, and so are few cells, so that there is something for every thread.
/// The teams decide who computes a cell, and not how: the bits do not depend on them.
class CellTeams {
  public:
    static constexpr int k_members = 4;
    /// Fewer cells than this are teams of one.
    static constexpr int k_fewest_cells = 8;

    using Range = Workers::Member::Range;

    CellTeams() = default;
    explicit CellTeams(int n_cells)
        : n_cells_(n_cells), n_fours_(n_cells < k_fewest_cells ? 0 : n_cells / k_members) {}

    [[nodiscard]] int n_teams() const { return n_cells_ - (k_members - 1) * n_fours_; }
    [[nodiscard]] Range cells_of(int team) const {
        if (team < n_fours_) return {k_members * team, k_members * (team + 1)};
        const int cell = team + (k_members - 1) * n_fours_;
        return {cell, cell + 1};
    }
    [[nodiscard]] int team_of(int cell) const {
        return cell < in_fours() ? cell / k_members : cell - (k_members - 1) * n_fours_;
    }
    /// A member's share of the teams, with nearly as many cells as those of others have.
    [[nodiscard]] Range share(const Workers::Member& member) const {
        const Range cells = member.share(n_cells_);
        return {first_team_from(cells.begin), first_team_from(cells.end)};
    }

  private:
    [[nodiscard]] int in_fours() const { return k_members * n_fours_; }
    /// The team that begins nearest to this cell; n_teams() if that is the end.
    [[nodiscard]] int first_team_from(int cell) const {
        if (cell >= in_fours()) return team_of(cell);
        return (cell + k_members / 2) / k_members;
    }

    int n_cells_ = 0;
    int n_fours_ = 0;
};

}  // namespace spheroscope
