#include "render/provenance.hpp"

#include "engine/base/error.hpp"
#include "engine/run/changes.hpp"
#include "engine/scene/picture_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <span>

namespace spheroscope::render {

namespace {

/// Check sum of bytes, eight at a time: multiply and fold.
class CheckSum {
  public:
    void add_bytes(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        add_word(size);
        for (; size >= 8; bytes += 8, size -= 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes, 8);
            add_word(word);
        }
        std::uint64_t rest = 0;
        if (size > 0) std::memcpy(&rest, bytes, size);
        add_word(rest);
    }
    void add(const std::string& text) { add_bytes(text.data(), text.size()); }
    template <class T> void add(const std::vector<T>& values) {
        add_bytes(values.data(), sizeof(T) * values.size());
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:016x}", state_); }

  private:
    void add_word(std::uint64_t word) {
        state_ = (state_ ^ word) * 0x9E3779B97F4A7C15ULL;  // 2^64 / golden ratio: spreads every bit
        state_ ^= state_ >> 29U;
    }
    std::uint64_t state_ = 0xCBF29CE484222325ULL;
};

std::string range_text(const scene::Picture& picture, const View& view) {
    if (view.range) return fmt::format("{:.17g} to {:.17g}", view.range->low, view.range->high);
    if (picture.range == "given")
        return fmt::format("{:.17g} to {:.17g}", picture.given_range[0], picture.given_range[1]);
    return "of this frame";
}

}  // namespace

std::string changes_until(const Snapshot& snapshot) {
    return snapshot.changes ? changes_text(changes_of_motion(*snapshot.changes)) : "";
}

std::string description_text(const scene::Picture& p, const View& view) {
    nlohmann::json json{{"name", p.name},
                        {"progress", view.progress},
                        {"turned", view.turned_deg},
                        {"time_decimals", view.time_decimals}};
    scene::visit_shown(p, [&](const char* key, const auto& value) { json[key] = value; });
    if (view.fit_radius_um) json["fit_radius"] = *view.fit_radius_um;
    if (view.range) json["shown_range"] = std::array{view.range->low, view.range->high};
    if (view.cutaway) json["shown_cutaway"] = *view.cutaway;
    if (!view.heading.empty()) json["heading"] = view.heading;
    return json.dump();
}

Description parse_description(const std::string& text) {
    Description result;
    scene::Picture& p = result.picture;
    View& view = result.view;
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        json.at("name").get_to(p.name);
        scene::visit_shown(p, [&](const char* key, auto& value) { json.at(key).get_to(value); });
        json.at("progress").get_to(view.progress);
        json.at("turned").get_to(view.turned_deg);
        json.at("time_decimals").get_to(view.time_decimals);
        if (json.contains("fit_radius")) view.fit_radius_um = json["fit_radius"].get<double>();
        if (json.contains("shown_range"))
            view.range = Range{json["shown_range"].at(0).get<double>(),
                               json["shown_range"].at(1).get<double>()};
        if (json.contains("shown_cutaway")) view.cutaway = json["shown_cutaway"].get<bool>();
        if (json.contains("heading")) view.heading = json["heading"].get<std::string>();
    } catch (const nlohmann::json::exception& error) {
        throw Error(std::string("the picture's description cannot be read: ") + error.what());
    }
    return result;
}

std::string join_fingerprints(const std::vector<std::string>& parts) {
    if (parts.size() == 1) return parts.front();
    CheckSum sum;
    for (const std::string& part : parts) sum.add(part);
    return sum.text();
}

std::string make_fingerprint(const Snapshot& snapshot, const scene::Picture& picture,
                             const View& view, const std::string& drawn_by) {
    CheckSum sum;
    const RunHeader& header = *snapshot.header;
    sum.add(drawn_by);
    sum.add(description_text(picture, view));
    sum.add(header.title);
    sum.add(header.scene_name);
    sum.add(header.resolved_scene);
    sum.add(header.version);
    sum.add(header.radius_um);
    sum.add(fmt::format("{} {} {} {:.17g} {} {} {:.17g} {:.17g} {:.17g}", header.seed,
                        header.n_cells, snapshot.frame, snapshot.time_s, snapshot.stage,
                        snapshot.stage_name, snapshot.stage_progress,
                        snapshot.totals.coordination_Z, snapshot.totals.contact_fraction));
    if (const std::string changes = changes_until(snapshot); !changes.empty()) sum.add(changes);
    sum.add(snapshot.x_um);
    sum.add(snapshot.normal);
    sum.add(snapshot.centre_um);
    sum.add(snapshot.volume_um3);
    sum.add(snapshot.links);
    const Probe& probe = snapshot.load.probe;
    if (probe.acts()) {
        const Vec3 centre_um = probe.centre_um();
        sum.add(std::vector<double>{centre_um.x(), centre_um.y(), centre_um.z(), probe.radius_um,
                                    snapshot.totals.probe_force_nN, snapshot.totals.probe_way_um});
        std::vector<float> vertices;  // as files hold them
        for (const Vec3& x : snapshot.load.hull->vertex_um)
            for (const double component : {x.x(), x.y(), x.z()})
                vertices.push_back(static_cast<float>(component));
        sum.add(vertices);
        for (const auto& corners : snapshot.load.hull->triangle)
            sum.add_bytes(corners.data(), sizeof(corners));
    }
    const int field = find_picture_field(header, picture);
    if (field >= 0) sum.add(snapshot.fields[static_cast<std::size_t>(field)]);
    return sum.text();
}

PngTexts make_provenance(const Snapshot& snapshot, const scene::Picture& picture, const View& view,
                         const std::string& drawn_by) {
    const RunHeader& header = *snapshot.header;
    PngTexts texts;
    texts["Title"] = header.title.empty() ? header.scene_name : header.title;
    texts["Software"] = "spheroscope " + drawn_by;
    texts["Run by"] = "spheroscope " + header.version;
    texts["Command"] = header.command_line;
    texts["Scene"] = header.resolved_scene;
    texts["Scene name"] = header.scene_name;
    texts["Seed"] = fmt::format("{}", header.seed);
    if (std::string changes = changes_until(snapshot); !changes.empty())
        texts[k_changes_key] = std::move(changes);
    texts["Frame"] = fmt::format("{}", snapshot.frame);
    texts["Time"] = fmt::format("{:.17g} s", snapshot.time_s);
    texts["Stage"] = snapshot.stage_name;
    texts["Picture"] = picture.name;
    texts[k_view_key] = description_text(picture, view);
    const int field = find_picture_field(header, picture);
    if (field >= 0)
        texts["Range"] = fmt::format("{} {} {}", picture.field, range_text(picture, view),
                                     header.fields[static_cast<std::size_t>(field)]->shown_unit);
    texts[k_fingerprint_key] = make_fingerprint(snapshot, picture, view, drawn_by);
    return texts;
}

}  // namespace spheroscope::render
