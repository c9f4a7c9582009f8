// Why a part is in a run or not, told from the scene alone: the same conditions as in build_parts()
// and System, in words. tests/stages/explain_test.cpp holds the two together.

#include "engine/forces/terms.hpp"
#include "engine/stages/build.hpp"
#include "engine/stages/choices.hpp"
#include "engine/stages/stage.hpp"

#include <algorithm>

namespace spheroscope {
namespace {

/// The scene line, or that nobody wrote one.
std::string place(const Loc& loc) { return loc.line > 0 ? loc.text() : "by default"; }

template <class Part> PlanRow table_row(std::string_view part, std::string_view equation,
                                        const std::optional<Part>& table,
                                        const std::string& table_name) {
    return {std::string(part), std::string(equation), table.has_value(),
            table ? place(table->loc) : "no [" + table_name + "]"};
}

/// A term that belongs to the stages of one kind.
PlanRow stage_row(const scene::Scene& scene, const ForceTermRow& term, scene::StageKind kind) {
    const auto stage =
        std::find_if(scene.stages.begin(), scene.stages.end(),
                     [&](const scene::Stage& candidate) { return candidate.kind == kind; });
    const bool is_in = stage != scene.stages.end();
    return {std::string(term.name), std::string(term.equation), is_in,
            is_in ? place(stage->loc)
                  : "no [[stage]] with kind = \"" + std::string(name_of(kind)) + "\""};
}

PlanRow regularisation_row(const scene::Scene& scene, const ForceTermRow& term) {
    const auto& table = scene.cortex.regularisation;
    PlanRow row = table_row(term.name, term.equation, table, "cortex.regularisation");
    if (table && table->kappa_nN_per_um <= 0.0) {
        row.is_in = false;
        row.because = "kappa is 0: the cortex is stiff enough (" + place(table->loc) + ")";
    }
    return row;
}

PlanRow contact_row(const scene::Scene& scene, std::string_view part, scene::ContactLaw law) {
    PlanRow row = table_row(part, "(5), (6), (7)", scene.contact, "contact");
    if (scene.contact && scene.contact->law != law) {
        row.is_in = false;
        row.because = "contact.law is the other one (" + place(scene.contact->loc) + ")";
    }
    return row;
}

PlanRow term_row(const scene::Scene& scene, const ForceTermRow& term) {
    const scene::Cortex& cortex = scene.cortex;
    const std::string name(term.name);
    if (name == "cortex.elastic") return table_row(name, term.equation, cortex.elastic, name);
    if (name == "cortex.bending") return table_row(name, term.equation, cortex.bending, name);
    if (name == "cortex.tension") return table_row(name, term.equation, cortex.tension, name);
    if (name == "cytosol") return table_row(name, term.equation, scene.cytosol, name);
    if (name == "body_force")
        return table_row(name, term.equation, scene.body_force, "load.body_force");
    if (name == "load.held") return table_row(name, term.equation, scene.held, name);
    if (name == "stage.compact") return stage_row(scene, term, scene::StageKind::compact);
    if (name.starts_with("stage.indent")) return stage_row(scene, term, scene::StageKind::indent);
    SPHEROSCOPE_ASSERT(name.starts_with("cortex.regularisation."), name);
    return regularisation_row(scene, term);
}

void add_forces(const scene::Scene& scene, std::vector<PlanRow>& rows) {
    for (const ForceTermRow& term : force_terms()) rows.push_back(term_row(scene, term));
    rows.push_back(contact_row(scene, "contact, law traction", scene::ContactLaw::traction));
    rows.push_back(contact_row(scene, "contact, law variational", scene::ContactLaw::variational));
    rows.push_back(table_row("contact search", "", scene.contact, "contact"));
}

PlanRow contact_friction_row(const scene::Scene& scene) {
    const bool is_in = scene.contact && scene.contact->friction_normal_kPa_s_per_um;
    return {"contact.friction", "(17), (18)", is_in,
            is_in ? place(scene.contact->friction_loc) : "no [contact.friction]"};
}

PlanRow volume_friction_row(const scene::Scene& scene) {
    PlanRow row = table_row("cytosol, derivative part", "(13)", scene.cytosol, "cytosol");
    if (scene.cytosol && scene.cytosol->controller != scene::VolumeController::pid) {
        row.is_in = false;
        row.because = (scene.cytosol->controller == scene::VolumeController::exact
                           ? "the controller is exact ("
                           : "the controller is proportional (") +
                      place(scene.cytosol->loc) + ")";
    }
    return row;
}

void add_frictions(const scene::Scene& scene, std::vector<PlanRow>& rows) {
    rows.push_back(table_row("medium", "(14)", scene.medium, "medium"));
    rows.push_back(
        table_row("cortex.viscosity", "(15), (16)", scene.cortex.viscosity, "cortex.viscosity"));
    rows.push_back(contact_friction_row(scene));
    rows.push_back(volume_friction_row(scene));
}

/// The shape of the friction matrix, the solvers that follow from it, and the method.
void add_solution(const scene::Scene& scene, std::vector<PlanRow>& rows) {
    const FrictionShape shape = shape_of(build_parts(scene).frictions);
    const MethodRow& method = chosen_method(scene);
    std::string shape_text;
    switch (shape) {
    case FrictionShape::diagonal:
        shape_text = "diagonal: no [cortex.viscosity], no [contact.friction]";
        break;
    case FrictionShape::fixed:
        shape_text = "the same in all steps: [cortex.viscosity] (" +
                     place(scene.cortex.viscosity->loc) + ") without [contact.friction]";
        break;
    case FrictionShape::changing:
        shape_text =
            "new in each step: [contact.friction] (" + place(scene.contact->friction_loc) + ")";
        break;
    }
    rows.push_back({"friction matrix", "", true, shape_text});

    PlanRow direct{"solver, one factorisation", "", false, ""};
    PlanRow iterative{"solver, conjugate gradients", "", false, ""};
    if (method.needs_stiffness) {
        iterative.is_in = true;
        iterative.because = "the method solves with the stiffness of all terms";
        direct.because = "the stiffness is new in each step, and factoring it takes longer than to "
                         "iterate, for one cell as well";
    } else {
        direct.is_in = shape == FrictionShape::fixed;
        iterative.is_in = shape == FrictionShape::changing;
        direct.because = direct.is_in      ? "the friction matrix is the same in all steps"
                         : iterative.is_in ? "the friction matrix is new in each step"
                                           : "a diagonal matrix needs a division only";
        iterative.because = iterative.is_in ? "the friction matrix is new in each step"
                            : direct.is_in  ? "the factorisation is exact"
                                            : "a diagonal matrix needs a division only";
    }
    rows.push_back(direct);
    rows.push_back(iterative);
    for (const MethodRow& row : all_methods())
        rows.push_back({"method " + std::string(row.name), "", &row == &method,
                        &row == &method ? place(scene.method.loc) : "another one is chosen"});
}

std::string reason_for_field(const scene::Scene& scene, const std::string& name) {
    for (const scene::Picture& picture : scene.pictures)
        if (picture.field == name)
            return "shown by picture '" + picture.name + "' (" + place(picture.loc) + ")";
    return "measures.fields (" + place(scene.measures.loc) + ")";
}

void add_fields(const scene::Scene& scene, std::vector<PlanRow>& rows) {
    const std::vector<const Field*> wanted = chosen_fields(scene);
    for (const Field& field : all_fields()) {
        const bool is_in = std::find(wanted.begin(), wanted.end(), &field) != wanted.end();
        std::string because = "not in measures.fields, and no picture shows it";
        if (is_in)
            because = reason_for_field(scene, std::string(field.name));
        else if (!has_part_of(scene, field))
            because = "no " + std::string(part_of(field));
        rows.push_back({"field " + std::string(field.name), "", is_in, because});
    }
}

/// While a wall acts the integral of the volume controller does not advance.
std::string note_on_wall(const scene::Scene& scene, const scene::Stage& stage) {
    using enum scene::StageKind;
    const bool has_wall = stage.kind == compact || stage.kind == hold || stage.kind == release;
    const bool has_integral =
        scene.cytosol && scene.cytosol->controller == scene::VolumeController::pid;
    return has_wall && has_integral ? "; the integral of the volume controller is frozen" : "";
}

}  // namespace

std::vector<PlanRow> explain(const scene::Scene& scene) {
    std::vector<PlanRow> rows;
    add_forces(scene, rows);
    add_frictions(scene, rows);
    add_solution(scene, rows);
    add_fields(scene, rows);
    for (std::size_t i = 0; i < scene.stages.size(); ++i)
        rows.push_back(
            {"stage " + std::to_string(i) + ", " + std::string(name_of(scene.stages[i].kind)), "",
             true, place(scene.stages[i].loc) + note_on_wall(scene, scene.stages[i])});
    for (const scene::Picture& picture : scene.pictures)
        rows.push_back({"picture " + picture.name, "", true, place(picture.loc)});
    if (scene.pictures.empty()) rows.push_back({"pictures", "", false, "no [[picture]]"});
    return rows;
}

}  // namespace spheroscope
