#include "viewer/model/step_moments.hpp"

#include <fmt/format.h>

namespace spheroscope::viewer {
namespace {

std::string number(double value) { return fmt::format("{:.4g}", value); }

std::string vector(const Vec3& v) {
    return fmt::format("({:.3g}, {:.3g}, {:.3g})", v.x(), v.y(), v.z());
}

StepMoment start_of(const StepAnatomy& anatomy, const StepAnatomy::Evaluation& evaluation,
                    bool is_first) {
    StepMoment moment;
    moment.what = is_first ? "the forces at the start" : "the forces once more";
    moment.rows = {{"t", number(anatomy.time_s), "s"},
                   {"nodes have moved by up to", number(evaluation.moved_um), "um"},
                   {"pairs of triangles in contact", std::to_string(evaluation.contact_pairs), ""}};
    return moment;
}

StepMoment after_term(const StepAnatomy& anatomy, const StepAnatomy::Term& term, std::size_t k,
                      std::size_t n_terms) {
    StepMoment moment;
    moment.what = fmt::format("after {} ({} of {})", term.name, k + 1, n_terms);
    moment.rows = {
        {"all nodes, RMS", "", ""},
        {"before", number(term.before_nN), "nN"},
        {"this term", number(term.rms_nN), "nN"},
        {"after", number(term.after_nN), "nN"},
        {"largest", fmt::format("{} on {}", number(term.largest_nN), term.at.text()), "nN"}};
    if (anatomy.node) {
        const Vec3 after = term.on_node_before_nN + term.on_node_nN;
        const std::vector<TableRow> of_node{{"node " + anatomy.node->text(), "", ""},
                                            {"before", vector(term.on_node_before_nN), "nN"},
                                            {"this term", vector(term.on_node_nN), "nN"},
                                            {"after", vector(after), "nN"},
                                            {"size after", number(after.norm()), "nN"}};
        moment.rows.insert(moment.rows.end(), of_node.begin(), of_node.end());
    }
    return moment;
}

StepMoment solve_of(const SolveHistory& history) {
    StepMoment moment;
    moment.solve = &history;
    if (history.residual.empty()) {
        moment.what = "friction inverted directly";
        return moment;
    }
    moment.what = history.dt_s > 0.0 ? "(Gamma + dt K) v = F solved" : "Gamma v = F solved";
    if (history.dt_s > 0.0) moment.rows.push_back({"dt", number(history.dt_s), "s"});
    const std::vector<TableRow> rows{
        {"iterations", std::to_string(history.residual.size() - 1), ""},
        {"residual at the start", number(history.residual.front()), "of |F|"},
        {"and at the end", number(history.residual.back()), "of |F|"},
        {"converged", history.converged ? "yes" : "no", ""}};
    moment.rows.insert(moment.rows.end(), rows.begin(), rows.end());
    return moment;
}

StepMoment end_of(const StepAnatomy& anatomy) {
    const StepOutcome& outcome = anatomy.outcome;
    StepMoment moment;
    moment.what = outcome.accepted ? "the step is good" : "the step fails";
    moment.rows = {{"dt", number(outcome.dt_s), "s"},
                   {"attempts before it", std::to_string(outcome.rejected), ""},
                   {"estimated error", number(outcome.error_um), "um"},
                   {"largest motion", number(anatomy.largest_moved_um), "um"},
                   {"of node", anatomy.largest_moved.text(), ""}};
    if (anatomy.node) {
        moment.rows.push_back({"motion of node " + anatomy.node->text(), "", ""});
        moment.rows.push_back({"", vector(anatomy.node_moved_um), "um"});
    }
    if (outcome.trouble) moment.rows.push_back({"reason", outcome.trouble->text(), ""});
    return moment;
}

}  // namespace

std::vector<StepMoment> moments_of(const StepAnatomy& anatomy) {
    std::vector<StepMoment> moments;
    for (const StepAnatomy::Phase& phase : anatomy.phases) {
        if (const auto* solve = std::get_if<SolveHistory>(&phase)) {
            moments.push_back(solve_of(*solve));
            continue;
        }
        const auto& evaluation = std::get<StepAnatomy::Evaluation>(phase);
        moments.push_back(start_of(anatomy, evaluation, moments.empty()));
        for (std::size_t k = 0; k < evaluation.terms.size(); ++k)
            moments.push_back(after_term(anatomy, evaluation.terms[k], k, evaluation.terms.size()));
    }
    moments.push_back(end_of(anatomy));
    return moments;
}

}  // namespace spheroscope::viewer
