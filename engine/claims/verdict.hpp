#pragma once

#include "engine/claims/claim_table.hpp"
#include "engine/reports/report_table.hpp"
#include "engine/statistics/setup_numbers.hpp"

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spheroscope::claims {

/// One run behind a setup.
struct MeasuredRun {
    std::uint64_t seed = 0;
    std::string outcome, version;
    double time_s = 0.0, wall_s = 0.0;
    std::optional<Totals> totals = {};  ///< of cells; beads have none
    std::string scene = {};             ///< scene_mark of its scene; "": not known, or beads
    /// Names of the counts that `totals` does not have, as the report of an older version did not.
    std::vector<std::string_view> missing_counts = {};
    double last_dt_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known, or beads

    /// Of `totals`, which must be there; NaN: not known.
    [[nodiscard]] double total(const TotalsRow& row) const;
};

/// What was measured of one setup, or why nothing was.
struct MeasuredSetup {
    std::vector<statistics::SetupNumber> numbers;
    std::vector<std::string> troubles;  ///< "seed 3: unstable: ...", one for each run that failed
    std::vector<std::string> remarks;   ///< "seed 2 ended at its cap"
    std::string law;                    ///< of contact
    int n_cells = 0, n_nodes = 0;       ///< of beads: their number, and 0
    std::vector<MeasuredRun> runs;
    bool is_kept = false;  ///< from an earlier report, which may not have all numbers of today
};
/// By the setup's name; one that is not there was left out.
using MeasuredSetups = std::map<std::string, MeasuredSetup>;

/// `agrees`: the mean is in the paper's range, or no further outside than the larger of two
/// standard errors and the claim's tolerance. A one-sided claim ("larger than") wants the mean on
/// its side, by no more grace than the tolerance: errors must not make an agreement.
enum class Verdict { agrees, differs, not_decidable, no_data };
[[nodiscard]] std::string_view name_of(Verdict verdict);  ///< "agrees"

struct JudgedClaim {
    const Claim* claim = nullptr;
    statistics::Estimate value;  ///< of the compared number, in the claim's unit
    Verdict verdict = Verdict::no_data;
    std::string reason;  ///< of `no_data` and `not_decidable`; what an agreement rests on
};

/// What makes the runs of a claim and judges it: "spheroscope reproduce --full --only case_a".
[[nodiscard]] std::string command_of(const Claim& claim);

/// Verdict on one number. `value.standard_error` NaN (one seed) counts as none.
[[nodiscard]] Verdict judge(const Claim& claim, const statistics::Estimate& value);

/// How the runs of a setup ended, "rest 3 of 5, flips 0, last dt 1 s"; "" of beads. At rest are
/// those that call it so and are as slow; flips are triangles of all runs together.
[[nodiscard]] std::string ends_text(const MeasuredSetup& setup);
/// The same of all setups of a claim, each with its name where there are several.
[[nodiscard]] std::string ends_text(const Claim& claim, const MeasuredSetups& measured);

/// "seed 1 (rest), 3 (cap): nodes still move with ...": the runs that move faster than at rest; ""
/// if none does.
[[nodiscard]] std::string remark_on_motion(const MeasuredSetup& setup);

/// All claims, in the table's order. `table` must outlive the result. Throws Error with the claim's
/// place when it asks for a number that there is not.
[[nodiscard]] std::vector<JudgedClaim> judge_claims(const ClaimTable& table,
                                                    const MeasuredSetups& measured);

/// What the paper says, what we measure, verdict: one row for each claim.
[[nodiscard]] reports::ReportTable claims_report(const std::vector<JudgedClaim>& judged,
                                                 const MeasuredSetups& measured);

/// One row for each run that was measured: outcome, times, all totals.
[[nodiscard]] reports::ReportTable runs_report(const MeasuredSetups& measured);

/// The claims as a table of Markdown.
[[nodiscard]] std::string claims_markdown(const std::vector<JudgedClaim>& judged,
                                          const MeasuredSetups& measured);

}  // namespace spheroscope::claims
