#include "engine/cli/step_output.hpp"

#include "engine/base/counted.hpp"
#include "engine/cli/report_output.hpp"
#include "engine/reports/report_table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spheroscope::cli {
namespace {

using reports::ReportTable;

std::string text_of(const StepAnatomy& anatomy, const StepAnatomy::Evaluation& evaluation) {
    ReportTable table{
        {{"term"}, {"before_nN"}, {"term_nN"}, {"after_nN"}, {"largest_nN"}, {"on_node"}}, {}};
    for (const StepAnatomy::Term& term : evaluation.terms)
        table.rows.push_back({term.name, term.before_nN, term.rms_nN, term.after_nN,
                              term.largest_nN, term.at.text()});
    std::string text = fmt::format(
        "\nforces (RMS over nodes: sum before each term, the term, sum after it), {} of "
        "triangles in contact, nodes moved by up to {:.3g} um:\n{}",
        counted(evaluation.contact_pairs, "pair"), evaluation.moved_um, table.aligned_text());
    if (!anatomy.node) return text;
    ReportTable of_node{{{"term"}, {"x_nN"}, {"y_nN"}, {"z_nN"}, {"sum_after_nN"}}, {}};
    for (const StepAnatomy::Term& term : evaluation.terms)
        of_node.rows.push_back({term.name, term.on_node_nN.x(), term.on_node_nN.y(),
                                term.on_node_nN.z(),
                                (term.on_node_before_nN + term.on_node_nN).norm()});
    return text + fmt::format("on node {}:\n{}", anatomy.node->text(), of_node.aligned_text());
}

std::string text_of(const SolveHistory& solve) {
    if (solve.residual.empty()) return "\nfriction inverted directly\n";
    std::string text = fmt::format(
        "\n{} solved in {}{}; |F - A v| / |F|:\n",
        solve.dt_s > 0.0 ? fmt::format("(Gamma + dt K) v = F with dt = {:.4g} s", solve.dt_s)
                         : "Gamma v = F",
        counted(solve.residual.size() - 1, "iteration"), solve.converged ? "" : ", NOT converged");
    for (std::size_t k = 0; k < solve.residual.size(); ++k)
        text += fmt::format("{}{:.2e}", k % 8 == 0 ? (k == 0 ? "  " : "\n  ") : "  ",
                            solve.residual[k]);
    return text + "\n";
}

}  // namespace

std::string step_text(const StepAnatomy& anatomy) {
    std::string text;
    for (const StepAnatomy::Phase& phase : anatomy.phases)
        if (const auto* solve = std::get_if<SolveHistory>(&phase))
            text += text_of(*solve);
        else
            text += text_of(anatomy, std::get<StepAnatomy::Evaluation>(phase));
    const StepOutcome& outcome = anatomy.outcome;
    // 0: the method compares with the velocity of the step before, which a file does not have.
    const std::string error = outcome.error_um > 0.0 ? fmt::format("{:.3g} um", outcome.error_um)
                                                     : std::string("not known");
    text += fmt::format("\n{}: dt = {:.4g} s after {}, estimated error {}, "
                        "largest motion {:.4g} um (node {})\n",
                        outcome.accepted ? "the step is good" : "the step fails", outcome.dt_s,
                        counted(outcome.rejected, "longer attempt"), error,
                        anatomy.largest_moved_um, anatomy.largest_moved.text());
    if (anatomy.node)
        text += fmt::format("node {} moves by {} um\n", anatomy.node->text(),
                            vector_text(anatomy.node_moved_um));
    if (outcome.trouble) text += outcome.trouble->text() + "\n";
    return text;
}

nlohmann::json step_json(const StepAnatomy& anatomy) {
    nlohmann::json phases = nlohmann::json::array();
    for (const StepAnatomy::Phase& phase : anatomy.phases) {
        if (const auto* solve = std::get_if<SolveHistory>(&phase)) {
            phases.push_back({{"phase", "solve"},
                              {"dt_s", solve->dt_s},
                              {"converged", solve->converged},
                              {"relative_residual", solve->residual}});
            continue;
        }
        const auto& evaluation = std::get<StepAnatomy::Evaluation>(phase);
        nlohmann::json terms = nlohmann::json::array();
        for (const StepAnatomy::Term& term : evaluation.terms) {
            nlohmann::json row{{"term", term.name},
                               {"before_nN", term.before_nN},
                               {"term_nN", term.rms_nN},
                               {"after_nN", term.after_nN},
                               {"largest_nN", term.largest_nN},
                               {"largest_on", term.at.text()}};
            if (anatomy.node) {
                row["on_node_nN"] = vector_json(term.on_node_nN);
                row["on_node_before_nN"] = vector_json(term.on_node_before_nN);
            }
            terms.push_back(std::move(row));
        }
        phases.push_back({{"phase", "forces"},
                          {"moved_um", evaluation.moved_um},
                          {"contact_pairs", evaluation.contact_pairs},
                          {"terms", std::move(terms)}});
    }
    const StepOutcome& outcome = anatomy.outcome;
    nlohmann::json document{
        {"phases", std::move(phases)},
        {"accepted", outcome.accepted},
        {"dt_s", outcome.dt_s},
        {"rejected", outcome.rejected},
        {"error_um", outcome.error_um > 0.0 ? number_or_null(outcome.error_um) : nlohmann::json()},
        {"largest_motion_um", anatomy.largest_moved_um},
        {"largest_motion_of", anatomy.largest_moved.text()}};
    if (anatomy.node) {
        document["node"] = anatomy.node->text();
        document["node_moved_um"] = vector_json(anatomy.node_moved_um);
    }
    if (outcome.trouble) document["trouble"] = outcome.trouble->text();
    return document;
}

}  // namespace spheroscope::cli
