#include "engine/stages/choices.hpp"

#include "engine/measures/totals.hpp"

#include <algorithm>
#include <string>

namespace spheroscope {
namespace {

template <class Row> std::string names_of(std::span<const Row> rows) {
    std::string names;
    for (const Row& row : rows) names += " " + std::string(row.name);
    return names;
}

}  // namespace

const MethodRow& chosen_method(const scene::Scene& scene) {
    const MethodRow* const method = find_method(scene.method.name);
    if (method == nullptr)
        throw Error(scene.method.loc, "there is no method '" + scene.method.name + "'",
                    "methods are:" + names_of(all_methods()));
    for (const scene::Stage& stage : scene.stages)
        if (stage.kind == scene::StageKind::indent && !method->moves_probe) {
            std::string names;
            for (const MethodRow& row : all_methods())
                if (row.moves_probe) names += " " + std::string(row.name);
            throw Error(stage.loc,
                        "the method " + scene.method.name +
                            " cannot move the probe of a stage of kind \"indent\"",
                        "methods that can:" + names);
        }
    if (!scene.cytosol) return *method;
    using enum scene::VolumeController;
    if (scene.cytosol->controller == exact && !method->holds_exact_volume) {
        std::string names;
        for (const MethodRow& row : all_methods())
            if (row.holds_exact_volume) names += " " + std::string(row.name);
        throw Error(scene.cytosol->loc,
                    "the method " + scene.method.name + " cannot hold controller = \"exact\"",
                    "methods that can:" + names);
    }
    if (scene.cytosol->controller == pid && method->order == 0)
        throw Error(scene.cytosol->loc,
                    "the method " + scene.method.name +
                        " has no motion in time, so controller = \"pid\" means nothing to it",
                    "\"exact\" ends at the same volume");
    return *method;
}

bool has_part_of(const scene::Scene& scene, const Field& field) {
    switch (field.requires_part) {
    case Requires::nothing: return true;
    case Requires::elastic: return scene.cortex.elastic.has_value();
    case Requires::contact: return scene.contact.has_value();
    case Requires::cytosol: return scene.cytosol.has_value();
    }
    return false;
}

std::string_view part_of(const Field& field) {
    switch (field.requires_part) {
    case Requires::nothing: return "";
    case Requires::elastic: return "[cortex.elastic]";
    case Requires::contact: return "[contact]";
    case Requires::cytosol: return "[cytosol]";
    }
    return "";
}

bool has_fixed_steps(const scene::Scene& scene) {
    return scene.method.tolerance_um == 0.0 || !chosen_method(scene).adaptive();
}

std::vector<const Field*> chosen_fields(const scene::Scene& scene) {
    std::vector<const Field*> fields;
    for (const std::string& name : scene.measures.fields) {
        // The scene's reader adds the fields of pictures to the list: a mistake is where it was
        // made.
        const auto picture = std::find_if(scene.pictures.begin(), scene.pictures.end(),
                                          [&](const scene::Picture& p) { return p.field == name; });
        const bool is_of_picture = picture != scene.pictures.end();
        const Loc& loc = is_of_picture ? picture->loc : scene.measures.loc;
        const std::string key = is_of_picture ? "picture.field: " : "measures.fields: ";
        const Field* const field = find_field(name);
        if (field == nullptr)
            throw Error(loc, key + "there is no field '" + name + "'",
                        "fields are:" + names_of(all_fields()));
        if (!has_part_of(scene, *field))
            throw Error(loc,
                        key + "'" + name + "' means nothing here: the scene has no " +
                            std::string(part_of(*field)),
                        "it is " + std::string(field->description));
        fields.push_back(field);
    }
    for (const scene::Picture& picture : scene.pictures)
        if (!picture.plot.empty() && find_total(picture.plot) == nullptr)
            throw Error(picture.loc, "picture.plot: there is no measure '" + picture.plot + "'",
                        "measures are:" + names_of(all_totals()));
    return fields;
}

}  // namespace spheroscope
