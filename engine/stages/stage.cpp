#include "engine/stages/stage.hpp"

#include "engine/stages/compaction.hpp"
#include "engine/stages/indentation.hpp"
#include "engine/stages/relaxation.hpp"

namespace spheroscope {

std::string_view name_of(StageEnd end) {
    switch (end) {
    case StageEnd::none: return "running";
    case StageEnd::done: return "done";
    case StageEnd::rest: return "rest";
    case StageEnd::stationary: return "stationary";
    case StageEnd::cap: return "cap";
    }
    return "";
}

std::string_view name_of(scene::StageKind kind) {
    switch (kind) {
    case scene::StageKind::anneal: return "anneal";
    case scene::StageKind::compact: return "compact";
    case scene::StageKind::hold: return "hold";
    case scene::StageKind::release: return "release";
    case scene::StageKind::relax: return "relax";
    case scene::StageKind::indent: return "indent";
    }
    return "";
}

StageEnd Stage::after_step(StageContext& context) const {
    return context.state.time_s >= latest_end_s(context) ? StageEnd::done : StageEnd::none;
}

double Stage::progress(const StageContext& context) const {
    return (context.state.time_s - context.memory.start_s) / parameters_.duration_s;
}

std::unique_ptr<Stage> make_stage(const scene::Stage& parameters) {
    switch (parameters.kind) {
    case scene::StageKind::anneal: break;
    case scene::StageKind::compact: return std::make_unique<Compaction>(parameters);
    case scene::StageKind::hold: return std::make_unique<Hold>(parameters);
    case scene::StageKind::release: return std::make_unique<Release>(parameters);
    case scene::StageKind::relax: return std::make_unique<Relaxation>(parameters);
    case scene::StageKind::indent: return std::make_unique<Indentation>(parameters);
    }
    SPHEROSCOPE_ASSERT(false, "beads are annealed by BeadPacking");
    return nullptr;
}

}  // namespace spheroscope
