#include "render/provenance.hpp"

#include <fmt/format.h>

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

std::string view_text(const scene::Picture& p, const View& view) {
    return fmt::format("{} field={} {}x{} cutaway={} network={} azimuth={:.17g} elevation={:.17g} "
                       "orbit={:.17g} at {:.17g} fit={:.17g} decimals={} range={}",
                       p.name, p.field, p.size_px[0], p.size_px[1], p.cutaway, p.network,
                       p.azimuth_deg, p.elevation_deg, p.orbit_deg, view.progress,
                       view.fit_radius_um.value_or(0.0), view.time_decimals, range_text(p, view));
}

}  // namespace

std::string make_fingerprint(const Snapshot& snapshot, const scene::Picture& picture,
                             const View& view, const std::string& drawn_by) {
    CheckSum sum;
    const RunHeader& header = *snapshot.header;
    sum.add(drawn_by);
    sum.add(view_text(picture, view));
    sum.add(header.title);
    sum.add(header.scene_name);
    sum.add(header.resolved_scene);
    sum.add(header.version);
    sum.add(header.radius_um);
    sum.add(fmt::format("{} {} {} {:.17g} {} {} {:.17g} {:.17g} {:.17g}", header.seed,
                        header.n_cells, snapshot.frame, snapshot.time_s, snapshot.stage,
                        snapshot.stage_name, snapshot.stage_progress,
                        snapshot.totals.coordination_Z, snapshot.totals.contact_fraction));
    sum.add(snapshot.x_um);
    sum.add(snapshot.normal);
    sum.add(snapshot.centre_um);
    sum.add(snapshot.volume_um3);
    sum.add(snapshot.links);
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
    texts["Frame"] = fmt::format("{}", snapshot.frame);
    texts["Time"] = fmt::format("{:.17g} s", snapshot.time_s);
    texts["Stage"] = snapshot.stage_name;
    texts["Picture"] = view_text(picture, view);
    const int field = find_picture_field(header, picture);
    if (field >= 0)
        texts["Range"] = fmt::format("{} {} {}", picture.field, range_text(picture, view),
                                     header.fields[static_cast<std::size_t>(field)]->shown_unit);
    texts[k_fingerprint_key] = make_fingerprint(snapshot, picture, view, drawn_by);
    return texts;
}

}  // namespace spheroscope::render
