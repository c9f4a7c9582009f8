#include "render/movie_painter.hpp"

#include "engine/base/error.hpp"
#include "engine/measures/totals.hpp"
#include "render/layers/caption.hpp"
#include "render/layers/plot_strip.hpp"
#include "render/provenance.hpp"
#include "render/run_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace spheroscope::render {

namespace {

/// The measure that a picture plots. Throws Error for a name that a newer program may know.
const TotalsRow& plotted_row(const scene::Picture& picture) {
    const TotalsRow* row = find_total(picture.plot);
    if (row == nullptr)
        throw Error(picture.loc, "picture.plot: there is no measure '" + picture.plot + "'");
    return *row;
}

std::string title_of(const RunHeader& header) {
    return header.title.empty() ? header.scene_name : header.title;
}

/// Of each run; nothing for frames of one run beside each other.
std::vector<std::string> differences_of(std::span<FrameSource* const> runs) {
    std::vector<SnapshotPtr> last;
    for (FrameSource* run : runs) {
        if (run == runs.front() && !last.empty()) return std::vector<std::string>(runs.size());
        last.push_back(run->frame(run->n_frames() - 1));
    }
    return what_differs(last);
}

void paste(Image& image, const Image& part, int x0, int y0) {
    for (int y = 0; y < part.height; ++y)
        std::copy_n(part.rgb.begin() + static_cast<std::ptrdiff_t>(part.offset(0, y)),
                    3 * static_cast<std::size_t>(part.width),
                    image.rgb.begin() + static_cast<std::ptrdiff_t>(image.offset(x0, y0 + y)));
}

}  // namespace

struct MoviePainter::Hidden {
    std::vector<FrameSource*> runs;
    std::vector<SnapshotPtr> current;  // of each run: what it was asked for last
    scene::Picture picture;
    std::string drawn_by;
    std::vector<std::string> differences;  // of each run
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::optional<PlotStrip> strip;
    std::string strip_text;  // all numbers of the strip, for the fingerprint
    std::unique_ptr<PlotStripPainter> strip_painter;
    std::string caption_text;
    std::optional<Image> caption;

    const Snapshot& snapshot(std::size_t run, int frame) {
        if (!current[run] || current[run]->frame != frame) current[run] = runs[run]->frame(frame);
        return *current[run];
    }
    [[nodiscard]] int width_px() const {
        return static_cast<int>(runs.size()) * picture.size_px[0];
    }
};

MoviePainter::MoviePainter(std::span<FrameSource* const> runs, std::span<const Survey> surveys,
                           const scene::Picture& picture, std::string drawn_by)
    : hidden_(std::make_unique<Hidden>()) {
    Hidden& h = *hidden_;
    h.runs.assign(runs.begin(), runs.end());
    h.current.resize(runs.size());
    h.picture = picture;
    h.drawn_by = std::move(drawn_by);
    h.differences = differences_of(runs);
    if (picture.plot.empty()) return;
    const TotalsRow& row = plotted_row(picture);
    PlotStrip strip;
    strip.heading = std::string(row.name);
    const ShownUnit unit = shown_unit(row.unit);
    if (!unit.text.empty()) strip.heading += fmt::format(" ({})", unit.text);
    std::set<std::string> titles;
    for (std::size_t k = 0; k < runs.size(); ++k) titles.insert(title_of(*h.snapshot(k, 0).header));
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const Survey& survey = surveys[k];
        const bool has_own_title = titles.size() == runs.size() || h.differences[k].empty();
        strip.curves.push_back(
            {has_own_title ? title_of(*h.snapshot(k, 0).header) : h.differences[k], survey.time_s,
             survey.plotted});
        for (double& value : strip.curves.back().value) value *= unit.per_stored;
        for (std::size_t i = 0; i < survey.time_s.size(); ++i)
            h.strip_text += fmt::format("{:.17g} {:.17g} ", survey.time_s[i], survey.plotted[i]);
        h.strip_text += '\n';
    }
    for (std::size_t i = 1; i < surveys[0].stage_names.size(); ++i)
        if (surveys[0].stage_names[i] != surveys[0].stage_names[i - 1])
            strip.stage_begin_s.push_back(surveys[0].time_s[i - 1]);
    h.strip = std::move(strip);
}

MoviePainter::~MoviePainter() = default;

std::array<int, 2> MoviePainter::size_px() const {
    const Hidden& h = *hidden_;
    const int height = h.picture.size_px[1];
    return {h.width_px(), height + (h.strip ? PlotStripPainter::height_px(height) : 0) +
                              (h.caption ? h.caption->height : 0)};
}

void MoviePainter::set_caption(const std::vector<std::string>& lines) {
    Hidden& h = *hidden_;
    h.caption_text.clear();
    for (const std::string& line : lines)
        h.caption_text += (h.caption_text.empty() ? "" : "\n") + line;
    h.caption.reset();
    if (!lines.empty()) h.caption = draw_caption(lines, h.width_px(), h.picture.size_px[1]);
}

std::string MoviePainter::drawn_with() { return hidden_->renderers.at(0)->drawn_with(); }

PngTexts MoviePainter::texts(std::span<const Shown> shown) {
    Hidden& h = *hidden_;
    PngTexts all;
    std::vector<std::string> fingerprints;
    std::string beside;
    for (std::size_t k = 0; k < shown.size(); ++k) {
        PngTexts texts =
            make_provenance(h.snapshot(k, shown[k].frame), h.picture, shown[k].view, h.drawn_by);
        fingerprints.push_back(texts[k_fingerprint_key]);
        for (auto& [key, text] : texts) all[beside + key] = std::move(text);
        all.erase(beside + k_fingerprint_key);
        beside += k_beside;
    }
    if (shown.size() > 1)
        fingerprints.insert(fingerprints.end(), h.differences.begin(), h.differences.end());
    if (h.strip) fingerprints.push_back(h.strip_text);
    if (h.caption) {
        all[k_caption] = h.caption_text;
        fingerprints.push_back(h.caption_text);
    }
    all[k_fingerprint_key] = join_fingerprints(fingerprints);
    return all;
}

Image MoviePainter::paint(std::span<const Shown> shown) {
    Hidden& h = *hidden_;
    std::vector<Image> parts;
    std::vector<double> time_s;
    for (std::size_t k = 0; k < shown.size(); ++k) {
        const Snapshot& snapshot = h.snapshot(k, shown[k].frame);
        if (k == h.renderers.size())
            h.renderers.push_back(
                std::make_unique<Renderer>(snapshot.header, h.picture, h.differences[k]));
        parts.push_back(h.renderers[k]->render(snapshot, shown[k].view));
        time_s.push_back(snapshot.time_s);
    }
    if (parts.size() == 1 && !h.strip && !h.caption) return std::move(parts.front());
    const auto [width, height] = size_px();
    Image image(width, height);
    for (std::size_t k = 0; k < parts.size(); ++k)
        paste(image, parts[k], static_cast<int>(k) * h.picture.size_px[0], 0);
    if (h.strip) {
        if (!h.strip_painter)
            h.strip_painter =
                std::make_unique<PlotStripPainter>(*h.strip, width, h.picture.size_px[1]);
        paste(image, h.strip_painter->draw(time_s), 0, h.picture.size_px[1]);
    }
    if (h.caption) paste(image, *h.caption, 0, height - h.caption->height);
    return image;
}

}  // namespace spheroscope::render
