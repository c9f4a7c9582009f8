// Several frames of a run beside each other: `render --frames`, and Fig. 1.
#include "render/verb_strip.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/index.hpp"
#include "engine/base/make_folder.hpp"
#include "engine/cli/version.hpp"
#include "render/movie_painter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace spheroscope {
namespace {

using render::MoviePainter;

/// The frame of a number, from the end if it is negative, or the last one of a stage. Throws Error
/// with what there is.
int frame_of(const std::string& text, const std::vector<std::string>& stage_names) {
    const auto n = static_cast<int>(stage_names.size());
    for (int i = n; i-- > 0;)
        if (stage_names[static_cast<std::size_t>(i)] == text) return i;
    int frame = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), frame);
    if (failed == std::errc() && end == text.data() + text.size() && frame >= -n && frame < n)
        return frame < 0 ? n + frame : frame;
    std::vector<std::string> names;  // in the order of the run
    std::unique_copy(stage_names.begin(), stage_names.end(), std::back_inserter(names));
    throw Error(fmt::format("--frames wants frames or stages, got '{}'", text),
                fmt::format("frames are 0 to {} or from the end, stages {}", n - 1,
                            fmt::join(names, ", ")));
}

std::vector<std::string> parts_of(const std::string& list) {
    std::vector<std::string> parts(1);
    for (const char c : list)
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// Wider pictures are not opened by many programs.
constexpr int k_widest_strip_px = 16384;

/// What a reader calls the kind of a stage.
std::string stage_in_words(const std::string& kind) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> words{
        {{"anneal", "seeding"},
         {"compact", "compaction"},
         {"hold", "held by the wall"},
         {"release", "release"},
         {"relax", "relaxation"},
         {"indent", "under a bead"}}};
    for (const auto& [name, text] : words)
        if (name == kind) return std::string(text);
    return kind;
}

/// The range of the frames with mechanics in which no wall presses on the cells; nothing where
/// there is none, or no field.
std::optional<render::Range> range_without_wall(const RunFileReader& reader,
                                                const scene::Picture& picture,
                                                const std::vector<int>& frames) {
    std::optional<render::RangeFinder> finder;
    for (const int number : frames) {
        const SnapshotPtr frame = reader.frame(number);
        const int field = render::find_picture_field(*frame->header, picture);
        if (field < 0) return {};
        if (!render::shows_field(*frame) || frame->diagnostics.wall_radius_um > 0.0) continue;
        if (!finder) finder.emplace(*frame->header->fields[idx(field)]);
        finder->add(frame->fields[idx(field)]);
    }
    if (!finder) return {};
    return finder->range();
}

/// "Colours: one range in all pictures, ..."; "" where there are none.
std::string range_in_words(const RunHeader& header, const scene::Picture& picture, StripRange kind,
                           std::size_t n_pictures) {
    const int field = render::find_picture_field(header, picture);
    if (field < 0) return "";
    const std::string text = fmt::format("Colours: {}; ", picture.field);
    if (n_pictures == 1) return text + "what is outside has the colours of the bar's tips.";
    if (kind == StripRange::without_wall && picture.range != "given")
        return text + "one range in all pictures, that of those without a wall; what is outside "
                      "has the colours of the bar's tips.";
    if (picture.range == "frame") return text + "each picture has a range of its own.";
    return text + "one range in all pictures; what is outside has the colours of the bar's tips.";
}

}  // namespace

render::PngTexts with_command(render::PngTexts texts, const cli::Invocation& invocation) {
    texts["Run command"] = std::exchange(texts["Command"], invocation.command_line);
    return texts;
}

void draw_strip(const RunFileReader& reader, scene::Picture picture, const std::string& list,
                StripRange range, const std::string& title, const std::filesystem::path& path,
                const cli::Invocation& invocation) {
    picture.plot.clear();  // a plot has one mark for each run, and this is one
    StoredFrames run(reader);
    const render::Survey survey = render::survey_frames(run, picture);
    const double widest_um =
        *std::max_element(survey.fit_radius_um.begin(), survey.fit_radius_um.end());
    const std::vector<std::string> parts = parts_of(list);
    const std::size_t n_most = idx(k_widest_strip_px / picture.size_px[0]);
    if (parts.size() > n_most)
        throw Error(fmt::format("--frames: {} pictures of {} px are wider than {} px", parts.size(),
                                picture.size_px[0], k_widest_strip_px),
                    fmt::format("{} have room at this size; --set 'picture[0].size=[WIDTH, "
                                "HEIGHT]' makes them smaller",
                                n_most));
    std::vector<int> frames;
    for (const std::string& part : parts) frames.push_back(frame_of(part, survey.stage_names));
    std::optional<render::Range> common;
    if (picture.range != "frame" || range == StripRange::without_wall) common = survey.range;
    if (range == StripRange::without_wall && picture.range != "given")
        if (const auto found = range_without_wall(reader, picture, frames)) common = found;

    std::vector<MoviePainter::Shown> shown;
    for (const int frame : frames) {
        MoviePainter::Shown one;
        one.frame = frame;
        one.view.fit_radius_um = widest_um;
        one.view.range = common;
        one.view.time_decimals = survey.time_decimals;
        one.view.heading = stage_in_words(survey.stage_names[idx(frame)]);
        if (frames.size() > 1)
            one.view.heading =
                fmt::format("{}  {}", static_cast<char>('a' + shown.size() % 26), one.view.heading);
        shown.push_back(one);
    }
    const std::vector<render::FrameSource*> runs(shown.size(), &run);
    MoviePainter painter(runs, std::vector<render::Survey>(shown.size(), survey), picture,
                         cli::version_text());
    const RunHeader& header = *reader.header();
    std::vector<std::string> caption;
    if (!title.empty()) caption.push_back(title);
    caption.push_back(fmt::format(
        "{} ({}, seed {}): {} {} of {}.", header.title.empty() ? header.scene_name : header.title,
        header.scene_name, header.seed, frames.size() == 1 ? "frame" : "frames",
        fmt::join(frames, ", "), reader.n_frames()));
    if (const std::string words = range_in_words(header, picture, range, frames.size());
        !words.empty())
        caption.push_back(words);
    caption.push_back(fmt::format("Made by: {} ({})", invocation.command_line, invocation.version));
    painter.set_caption(caption);
    const render::Image image = painter.paint(shown);
    render::PngTexts texts = with_command(painter.texts(shown), invocation);
    texts[render::k_drawn_with_key] = painter.drawn_with();
    make_folder(path.parent_path());
    render::write_png(path, image, texts);
}

}  // namespace spheroscope
