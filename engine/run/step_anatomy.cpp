#include "engine/run/step_anatomy.hpp"

#include "engine/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace spheroscope {
namespace {

double rms(std::span<const Vec3> vectors) {
    double sum2 = 0.0;
    for (const Vec3& v : vectors) sum2 += v.squaredNorm();
    return std::sqrt(sum2 / static_cast<double>(vectors.size()));
}

struct Largest {
    double length = 0.0;
    NodeOfCell at;
};

Largest largest_of(std::span<const Vec3> vectors, int n_nodes) {
    const auto longest =
        std::max_element(vectors.begin(), vectors.end(), [](const Vec3& a, const Vec3& b) {
            return a.squaredNorm() < b.squaredNorm();
        });
    const int i = static_cast<int>(longest - vectors.begin());
    return {longest->norm(), {i / n_nodes, i % n_nodes}};
}

/// Writes down what it sees.
class Recorder final : public StepWitness {
  public:
    Recorder(StepAnatomy& anatomy, const State& start, std::optional<std::size_t> node)
        : anatomy_(anatomy), start_(start), node_(node) {}

    void evaluated(System& system) override {
        const Configuration at = system.configuration();
        StepAnatomy::Evaluation evaluation;
        for (std::size_t i = 0; i < at.x_um.size(); ++i)
            evaluation.moved_um =
                std::max(evaluation.moved_um, (at.x_um[i] - start_.x_um[i]).norm());
        evaluation.contact_pairs = static_cast<std::int64_t>(at.contacts.n_pairs());
        std::vector<Vec3> sum(at.x_um.size(), Vec3::Zero());
        for (const auto& term : system.parts().terms) {
            if (!system.acts(*term)) continue;
            const std::vector<Vec3> F = system.force_of_term(*term);
            StepAnatomy::Term row;
            row.name = std::string(term->name());
            row.rms_nN = rms(F);
            row.before_nN = rms(sum);
            const Largest largest = largest_of(F, at.model.n_nodes());
            row.largest_nN = largest.length;
            row.at = largest.at;
            if (node_) {
                row.on_node_nN = F[*node_];
                row.on_node_before_nN = sum[*node_];
            }
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += F[i];
            row.after_nN = rms(sum);
            evaluation.terms.push_back(std::move(row));
        }
        anatomy_.phases.emplace_back(std::move(evaluation));
    }

    void solved(const SolveHistory& history) override { anatomy_.phases.emplace_back(history); }

  private:
    StepAnatomy& anatomy_;
    const State& start_;
    std::optional<std::size_t> node_;
};

/// The system has a witness while this lives.
class Watch {
  public:
    Watch(System& system, StepWitness& witness) : system_(system) { system.set_witness(&witness); }
    ~Watch() { system_.set_witness(nullptr); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

  private:
    System& system_;
};

}  // namespace

std::string NodeOfCell::text() const { return std::to_string(cell) + ":" + std::to_string(node); }

StepAnatomy take_apart(System& system, Method& method, const State& state, double limit_s,
                       bool freeze_volume_integral, std::optional<NodeOfCell> node) {
    const Model& model = system.model();
    if (node && (node->cell < 0 || node->cell >= model.n_cells() || node->node < 0 ||
                 node->node >= model.n_nodes()))
        throw Error("there is no node " + std::to_string(node->cell) + ":" +
                        std::to_string(node->node),
                    "cells are 0 to " + std::to_string(model.n_cells() - 1) +
                        ", each with nodes 0 "
                        "to " +
                        std::to_string(model.n_nodes() - 1));
    std::optional<std::size_t> index;
    if (node)
        index = static_cast<std::size_t>(node->cell) * static_cast<std::size_t>(model.n_nodes()) +
                static_cast<std::size_t>(node->node);
    StepAnatomy anatomy;
    anatomy.time_s = state.time_s;
    anatomy.node = node;
    State moved = state;
    Recorder recorder(anatomy, state, index);
    const Watch watch(system, recorder);
    anatomy.outcome = method.advance(system, moved, limit_s, freeze_volume_integral);
    std::vector<Vec3> way(moved.x_um.size());
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = moved.x_um[i] - state.x_um[i];
    const Largest largest = largest_of(way, model.n_nodes());
    anatomy.largest_moved_um = largest.length;
    anatomy.largest_moved = largest.at;
    if (index) anatomy.node_moved_um = way[*index];
    return anatomy;
}

}  // namespace spheroscope
