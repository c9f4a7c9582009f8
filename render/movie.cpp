#include "render/movie.hpp"

#include "engine/base/error.hpp"
#include "render/movie_writer.hpp"
#include "render/picture.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "render/work_queue.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Decimals that tell neighbouring frames apart: 1 down to a tenth of a second between them, 2 to a
/// hundredth.
int decimals_for(double smallest_interval_s) {
    if (!std::isfinite(smallest_interval_s)) return 1;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(smallest_interval_s) - 1e-9)), 1, 4);
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
    std::vector<double> extent_um;
    std::optional<RangeFinder> finder;
    double last_time_s = -std::numeric_limits<double>::infinity();
    double smallest_interval_s = std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_frames; ++i) {
        const SnapshotPtr snapshot = frames.frame(i);
        extent_um.push_back(aggregate_extent_um(*snapshot));
        const int field = find_picture_field(*snapshot->header, picture);
        if (field >= 0) {
            const auto index = static_cast<std::size_t>(field);
            if (!finder) finder.emplace(*snapshot->header->fields[index]);
            if (shows_field(*snapshot)) finder->add(snapshot->fields[index]);
        }
        if (snapshot->time_s > last_time_s && std::isfinite(last_time_s))
            smallest_interval_s = std::min(smallest_interval_s, snapshot->time_s - last_time_s);
        last_time_s = snapshot->time_s;
    }
    survey.fit_radius_um = fit_radii(extent_um, picture.fps);
    survey.time_decimals = decimals_for(smallest_interval_s);
    if (finder) {
        survey.range = picture.range == "given"
                           ? Range{picture.given_range[0], picture.given_range[1]}
                           : finder->range();
        survey.share_outside = finder->share_outside(survey.range);
    }
    return survey;
}

MovieResult make_movie(FrameSource& frames, const MovieSettings& settings) {
    const scene::Picture& picture = settings.picture;
    check_movie_size(picture.size_px[0], picture.size_px[1]);
    const Survey survey = survey_frames(frames, picture);
    MovieResult result;
    result.n_frames = frames.n_frames();
    result.range = survey.range;
    result.share_outside =
        picture.range == "frame" ? 2.0 * RangeFinder::k_share_beyond : survey.share_outside;

    const SnapshotPtr first = frames.frame(0);
    std::error_code error;
    fs::create_directories(settings.frames_folder, error);
    if (!error && settings.movie_path.has_parent_path())
        fs::create_directories(settings.movie_path.parent_path(), error);
    if (error)
        throw Error("the folder " + settings.frames_folder.string() +
                    " cannot be made: " + error.message());
    remove_left_overs(settings.frames_folder, result.n_frames);

    // Made when the first picture has to be drawn: a movie that is only put together needs no
    // OpenGL.
    std::unique_ptr<Renderer> renderer;
    MovieOrReason movie;
    movie.attempt([&] {
        movie.writer = std::make_unique<MovieWriter>(MovieWriter::Settings{
            settings.movie_path, picture.size_px[0], picture.size_px[1], picture.fps,
            first->header->title.empty() ? first->header->scene_name : first->header->title,
            fmt::format("spheroscope {}; scene {}; seed {}", settings.drawn_by,
                        first->header->scene_name, first->header->seed)});
    });

    WorkQueue files(2);  // compressing a picture takes half as long as drawing it
    for (int i = 0; i < result.n_frames; ++i) {
        if (settings.stop_requested && settings.stop_requested()) {
            result.stopped = true;
            break;
        }
        const SnapshotPtr snapshot = frames.frame(i);
        View view;
        view.fit_radius_um = survey.fit_radius_um[static_cast<std::size_t>(i)];
        view.progress = result.n_frames > 1 ? static_cast<double>(i) / (result.n_frames - 1) : 0.0;
        view.time_decimals = survey.time_decimals;
        if (picture.range != "frame") view.range = survey.range;

        const fs::path path = picture_path(settings.frames_folder, i);
        PngTexts texts = make_provenance(*snapshot, picture, view, settings.drawn_by);
        std::optional<Image> image = find_picture(path, texts[k_fingerprint_key]);
        if (!image) {
            if (!renderer) renderer = std::make_unique<Renderer>(snapshot->header, picture);
            image = renderer->render(*snapshot, view);
            ++result.n_drawn;
            files.add([path, copy = *image, texts] { write_png(path, copy, texts); });
        }
        if (movie.writer) movie.attempt([&] { movie.writer->add(std::move(*image)); });
        if (settings.on_progress) settings.on_progress(i + 1, result.n_frames);
    }
    files.finish();
    if (result.stopped) return result;
    if (movie.writer) movie.attempt([&] { movie.writer->finish(); });
    if (movie.reason) std::rethrow_exception(movie.reason);
    return result;
}

}  // namespace spheroscope::render
