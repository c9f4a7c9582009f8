#pragma once

#include "engine/base/error.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The paper's claims as a file: which runs are needed, what is measured in them, what the paper
// says, and how far from it still counts as the same. Written before the runs, or marked as written
// after them; the verdicts follow.
namespace spheroscope::claims {

/// Runs of one scene that differ in their seed alone; or beads without cells.
struct ClaimedSetup {
    Loc loc;
    std::string name;                        ///< folder of its runs: "case_a"
    std::string scene;                       ///< path, relative to the file of claims
    int beads = 0;                           ///< > 0: so many are jammed, and there is no scene
    std::vector<std::string> settings;       ///< "key=value", as --set takes them
    std::vector<std::uint64_t> seeds;        ///< that --full runs
    std::vector<std::uint64_t> quick_seeds;  ///< that --quick runs; empty: left out there
};

/// A number of a setup (statistics::numbers_of).
struct Quantity {
    Loc loc;
    std::string setup, number;
};

/// What the paper says of a number: it lies in [min, max].
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    [[nodiscard]] bool is_one_sided() const;
    /// 0 inside; else how far outside.
    [[nodiscard]] double distance(double value) const;
    /// "> 0", "18", "1500 ... 3600"
    [[nodiscard]] std::string text() const;
};

/// When a claim and its bounds were written: before its runs, or when their numbers were known.
enum class Written { before, after };
[[nodiscard]] std::string_view name_of(Written written);  ///< "before"

/// One row: measured * factor, minus or over another quantity, lies in the paper's range.
struct Claim {
    Loc loc;
    std::string id;      ///< "compressed_core/case_a"
    std::string source;  ///< where the paper says it: "Fig. 2 b"
    std::string says;    ///< in our words
    Written written = Written::before;
    std::string unit;  ///< of the compared number; "": none
    Quantity measured;
    std::optional<Quantity> minus, over;
    double factor = 1.0;
    Range paper;
    double tolerance = 0.0;         ///< how far outside of it still agrees
    double tolerance_factor = 1.0;  ///< >= 1; how many times larger or smaller still agrees
    std::string undecidable;        ///< why no number of ours can decide it; empty: it can
    std::string remark;             ///< what a reader of the verdict has to know; "": nothing

    /// The paper's range with the tolerance on both sides.
    [[nodiscard]] Range accepted() const;
    /// "0.15", "factor 2"; "": none
    [[nodiscard]] std::string tolerance_text() const;
    /// Setups that it needs: one, or two that are compared.
    [[nodiscard]] std::vector<std::string> setups() const;
};

/// At most so many claims may be marked undecidable.
inline constexpr int k_most_undecidable = 3;

struct ClaimTable {
    std::string file;
    std::vector<ClaimedSetup> setups;
    std::vector<Claim> claims;

    /// nullptr if there is none of this name.
    [[nodiscard]] const ClaimedSetup* find_setup(const std::string& name) const;
    /// The path of a setup's scene, from where the program runs.
    [[nodiscard]] std::string scene_path(const ClaimedSetup& setup) const;
};

/// Reads a file of claims. A claim with several setups becomes one row for each. Throws Error with
/// file:line:column.
[[nodiscard]] ClaimTable load_claims(const std::string& path);
[[nodiscard]] ClaimTable parse_claims(const std::string& text, const std::string& name);

}  // namespace spheroscope::claims
