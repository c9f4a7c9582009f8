#include "render/movie.hpp"

#include "engine/base/error.hpp"
#include "engine/base/folder_lock.hpp"
#include "engine/base/make_folder.hpp"
#include "engine/measures/totals.hpp"
#include "render/movie_frames.hpp"
#include "render/movie_writer.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "render/work_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <optional>

namespace spheroscope::render {

namespace {

namespace fs = std::filesystem;

fs::path picture_path(const fs::path& folder, int frame) {
    return folder / fmt::format("{:06d}.png", frame);
}

/// Removes pictures after the last frame (of an earlier, longer run) and unfinished ones; all else
/// stays.
void remove_left_overs(const fs::path& folder, int n_frames) {
    std::vector<fs::path> unwanted;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool ours = name.size() >= 10 && name.compare(6, 4, ".png") == 0 &&
                          std::all_of(name.begin(), name.begin() + 6,
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
        if (!ours) continue;
        const bool unfinished = name.substr(10) == ".partial";
        const bool beyond = name.size() == 10 && std::stoi(name.substr(0, 6)) >= n_frames;
        if (unfinished || beyond) unwanted.push_back(entry.path());
    }
    for (const fs::path& path : unwanted) fs::remove(path);
}

/// The picture of that name, if it is whole and has that fingerprint.
std::optional<Image> find_picture(const fs::path& path, const std::string& fingerprint) {
    if (!fs::exists(path)) return std::nullopt;
    try {
        const PngTexts texts = read_png_texts(path);
        const auto found = texts.find(k_fingerprint_key);
        if (found == texts.end() || found->second != fingerprint) return std::nullopt;
        return read_png(path).image;
    } catch (const Error&) {
        return std::nullopt;  // damaged by somebody else: it is drawn again
    }
}

/// Averages over 2 half + 1 frames, fewer at the ends.
std::vector<double> smooth(const std::vector<double>& values, int half) {
    const int n = static_cast<int>(values.size());
    std::vector<double> result(values.size());
    for (int i = 0; i < n; ++i) {
        const int first = std::max(0, i - half), last = std::min(n - 1, i + half);
        double sum = 0.0;
        for (int k = first; k <= last; ++k) sum += values[static_cast<std::size_t>(k)];
        result[static_cast<std::size_t>(i)] = sum / (last - first + 1);
    }
    return result;
}

/// The movie, or why there will be none: pictures are worth having without it.
struct MovieOrReason {
    std::unique_ptr<MovieWriter> writer;
    std::exception_ptr reason;

    template <class F> void attempt(const F& f) {
        try {
            f();
        } catch (const Error& error) {
            if (error.code() != ExitCode::environment) throw;
            reason = std::current_exception();
            writer.reset();
        }
    }
};

}  // namespace

int time_decimals(std::span<const double> time_s) {
    constexpr double k_same_time_s = 1e-9;  // rounding of sums of steps stays below it for hours
    double interval_s = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < time_s.size(); ++i)
        if (time_s[i] - time_s[i - 1] > k_same_time_s)
            interval_s = std::min(interval_s, time_s[i] - time_s[i - 1]);
    if (!std::isfinite(interval_s)) return 1;  // nothing to be told apart from
    const auto are_as_written = [&](double unit_s) {
        return std::all_of(time_s.begin(), time_s.end(), [&](double t) {
            return std::abs(t - unit_s * std::round(t / unit_s)) <= 0.02 * interval_s;
        });
    };
    return are_as_written(0.1) ? 1 : are_as_written(0.01) ? 2 : 3;
}

std::vector<double> fit_radii(std::span<const double> extent_um, double fps) {
    const auto [smallest, largest] = std::minmax_element(extent_um.begin(), extent_um.end());
    if (*largest <= 1.2 * *smallest) return std::vector<double>(extent_um.size(), *largest);
    const int n = static_cast<int>(extent_um.size());
    const int half = std::max(2, static_cast<int>(std::lround(fps)));
    // The largest extent within `half` frames, then two averages that reach `half` frames together:
    // every term of them has seen this frame's extent, so the result is nowhere below it.
    std::vector<double> envelope(extent_um.size());
    for (int i = 0; i < n; ++i) {
        const int first = std::max(0, i - half), last = std::min(n - 1, i + half);
        envelope[static_cast<std::size_t>(i)] =
            *std::max_element(extent_um.begin() + first, extent_um.begin() + last + 1);
    }
    return smooth(smooth(envelope, half / 2), half - half / 2);
}

Survey survey_frames(FrameSource& frames, const scene::Picture& picture) {
    const int n_frames = frames.n_frames();
    if (n_frames == 0)
        throw Error("a movie wants at least one frame, the run has none",
                    "was the run stopped before its first output?");
    Survey survey;
    const TotalsRow* const plotted = find_total(picture.plot);
    std::vector<double> extent_um;
    std::optional<RangeFinder> finder;
    for (int i = 0; i < n_frames; ++i) {
        const SnapshotPtr snapshot = frames.frame(i);
        survey.time_s.push_back(snapshot->time_s);
        survey.stage_names.push_back(snapshot->stage_name);
        // Beads that are being packed have no stress: their frames are a gap in the curve.
        if (plotted != nullptr)
            survey.plotted.push_back(shows_field(*snapshot)
                                         ? value_of(*plotted, snapshot->totals)
                                         : std::numeric_limits<double>::quiet_NaN());
        extent_um.push_back(shown_extent_um(*snapshot, picture));
        const int field = find_picture_field(*snapshot->header, picture);
        if (field >= 0) {
            const auto index = static_cast<std::size_t>(field);
            if (!finder) finder.emplace(*snapshot->header->fields[index]);
            if (shows_field(*snapshot)) finder->add(snapshot->fields[index]);
        }
    }
    survey.fit_radius_um = fit_radii(extent_um, picture.fps);
    survey.time_decimals = time_decimals(survey.time_s);
    if (finder) {
        survey.range = picture.range == "given"
                           ? Range{picture.given_range[0], picture.given_range[1]}
                           : finder->range();
        survey.share_outside = finder->share_outside(survey.range);
    }
    return survey;
}

namespace {

/// One range and one scale for two runs; each keeps its times, stages and curve.
void unite(Survey& first, Survey& other, const std::vector<int>& beside, bool is_of_frames) {
    if (!is_of_frames) {
        const Range range{std::min(first.range.low, other.range.low),
                          std::max(first.range.high, other.range.high)};
        first.range = other.range = range;
        // The wider range holds what each one's own range held.
        first.share_outside = std::max(first.share_outside, other.share_outside);
    }
    first.time_decimals = other.time_decimals = std::max(first.time_decimals, other.time_decimals);
    for (std::size_t i = 0; i < beside.size(); ++i)
        first.fit_radius_um[i] = std::max(first.fit_radius_um[i],
                                          other.fit_radius_um[static_cast<std::size_t>(beside[i])]);
}

/// A chapter for each stage, beginning with its first picture.
std::vector<MovieWriter::Chapter> chapters(const Survey& survey,
                                           const std::vector<MovieFrame>& pictures) {
    std::vector<MovieWriter::Chapter> result;
    std::string current;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::string& stage = survey.stage_names[static_cast<std::size_t>(pictures[i].frame)];
        if (!result.empty() && stage == current) continue;
        current = stage;
        result.push_back({static_cast<int>(i), stage});
    }
    return result;
}

std::string range_text(const scene::Picture& picture, const Survey& survey,
                       const RunHeader& header) {
    const int field = find_picture_field(header, picture);
    if (field < 0) return "";
    const std::string_view unit = header.fields[static_cast<std::size_t>(field)]->shown_unit;
    if (picture.range == "frame") return fmt::format("; {} of each frame", picture.field);
    return fmt::format("; {} {:g} to {:g} {}", picture.field, survey.range.low, survey.range.high,
                       unit);
}

MovieWriter::Settings writer_settings(const MovieSettings& settings, const Survey& survey,
                                      const std::vector<MovieFrame>& pictures,
                                      const RunHeader& header, const RunHeader* beside,
                                      std::array<int, 2> size_px) {
    MovieWriter::Settings result;
    result.path = settings.movie_path;
    result.width_px = size_px[0];
    result.height_px = size_px[1];
    result.fps = settings.picture.fps;
    result.title = header.title.empty() ? header.scene_name : header.title;
    result.comment =
        fmt::format("spheroscope {}; scene {}; seed {}; frames {} to {}{}", settings.drawn_by,
                    header.scene_name, header.seed, pictures.front().frame, pictures.back().frame,
                    range_text(settings.picture, survey, header));
    if (beside != nullptr)
        result.comment +=
            fmt::format("; beside it: scene {}; seed {}", beside->scene_name, beside->seed);
    if (!header.command_line.empty()) result.comment += "; run by: " + header.command_line;
    if (beside != nullptr && !beside->command_line.empty())
        result.comment += "; beside it by: " + beside->command_line;
    result.description = header.resolved_scene;
    result.chapters = chapters(survey, pictures);
    result.n_pictures = static_cast<int>(pictures.size());
    return result;
}

/// Makes the folders of a movie, and keeps other jobs out of the one that it gets.
FolderLock lock_folders(const MovieSettings& settings) {
    const fs::path folder =
        settings.movie_path.has_parent_path() ? settings.movie_path.parent_path() : fs::path(".");
    make_folder(folder);
    FolderLock lock(folder);
    if (settings.keeps_pictures) make_folder(settings.frames_folder);
    return lock;
}

MoviePainter::Shown shown_in(const MovieFrame& wanted, const Survey& survey,
                             const scene::Picture& picture) {
    MoviePainter::Shown shown;
    shown.frame = wanted.frame;
    shown.view.fit_radius_um = survey.fit_radius_um[static_cast<std::size_t>(wanted.frame)];
    shown.view.progress = wanted.progress;
    shown.view.turned_deg = wanted.turned_deg;
    shown.view.cutaway = wanted.cutaway;
    shown.view.time_decimals = survey.time_decimals;
    if (picture.range != "frame") shown.view.range = survey.range;
    return shown;
}

MovieResult make_movie_of(std::span<FrameSource* const> runs, const MovieSettings& settings) {
    const scene::Picture& picture = settings.picture;
    check_movie_size(picture.size_px[0], picture.size_px[1]);
    std::vector<Survey> surveys;
    for (FrameSource* run : runs) surveys.push_back(survey_frames(*run, picture));
    std::vector<int> beside;
    if (runs.size() == 2) {
        beside = frames_beside(surveys[0].time_s, surveys[1].time_s);
        unite(surveys[0], surveys[1], beside, picture.range == "frame");
    }
    const std::vector<MovieFrame> pictures = movie_frames(picture, surveys[0].time_s);
    if (pictures.empty())
        throw Error(picture.loc, "picture.shots show nothing of this run",
                    fmt::format("its first frame is at {:g} s", surveys[0].time_s[0]));
    MovieResult result;
    result.n_frames = static_cast<int>(pictures.size());
    result.range = surveys[0].range;
    result.remarks = shots_beyond_the_end(picture, surveys[0].time_s.back());
    result.share_outside =
        picture.range == "frame" ? 2.0 * RangeFinder::k_share_beyond : surveys[0].share_outside;

    const FolderLock lock = lock_folders(settings);
    if (settings.keeps_pictures) remove_left_overs(settings.frames_folder, result.n_frames);

    // Renderers are made when the first picture has to be drawn: a movie that is only put together
    // needs no OpenGL.
    MoviePainter painter(runs, surveys, picture, settings.drawn_by);
    MovieOrReason movie;
    movie.attempt([&] {
        const SnapshotPtr first = runs[0]->frame(0);
        const SnapshotPtr other = runs.size() == 2 ? runs[1]->frame(0) : nullptr;
        movie.writer = std::make_unique<MovieWriter>(
            writer_settings(settings, surveys[0], pictures, *first->header,
                            other ? other->header.get() : nullptr, painter.size_px()));
    });
    if (!settings.keeps_pictures && movie.reason) std::rethrow_exception(movie.reason);

    WorkQueue files(2);  // compressing a picture takes half as long as drawing it
    for (int i = 0; i < result.n_frames; ++i) {
        if (settings.stop_requested && settings.stop_requested()) {
            result.stopped = true;
            break;
        }
        const MovieFrame& wanted = pictures[static_cast<std::size_t>(i)];
        std::vector<MoviePainter::Shown> all{shown_in(wanted, surveys[0], picture)};
        if (runs.size() == 2) {
            all.push_back(all[0]);
            all[1].frame = beside[static_cast<std::size_t>(wanted.frame)];
        }

        const fs::path path = picture_path(settings.frames_folder, i);
        PngTexts texts = painter.texts(all);
        std::optional<Image> image;
        if (settings.keeps_pictures) image = find_picture(path, texts[k_fingerprint_key]);
        if (!image) {
            image = painter.paint(all);
            texts[k_drawn_with_key] = painter.drawn_with();
            ++result.n_drawn;
            if (settings.keeps_pictures)
                files.add([path, copy = *image, texts] { write_png(path, copy, texts); });
        }
        if (movie.writer) movie.attempt([&] { movie.writer->add(std::move(*image)); });
        if (!settings.keeps_pictures && movie.reason) std::rethrow_exception(movie.reason);
        result.n_done = i + 1;
        if (settings.on_progress) settings.on_progress(result.n_done, result.n_frames);
    }
    files.finish();
    if (result.stopped) return result;
    if (movie.writer) movie.attempt([&] { movie.writer->finish(); });
    if (movie.reason) std::rethrow_exception(movie.reason);
    return result;
}

}  // namespace

MovieResult make_movie(FrameSource& frames, const MovieSettings& settings) {
    FrameSource* const runs[]{&frames};
    return make_movie_of(runs, settings);
}

MovieResult make_comparison(FrameSource& frames, FrameSource& other,
                            const MovieSettings& settings) {
    FrameSource* const runs[]{&frames, &other};
    return make_movie_of(runs, settings);
}

}  // namespace spheroscope::render
