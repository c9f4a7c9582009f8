#include "viewer/app.hpp"

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/cli/interrupt.hpp"
#include "engine/cli/log.hpp"
#include "engine/run/exploded.hpp"
#include "render/png.hpp"
#include "render/provenance.hpp"
#include "viewer/engine_commands.hpp"
#include "viewer/layout.hpp"
#include "viewer/live_run.hpp"
#include "viewer/opened_sheet.hpp"
#include "viewer/painter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace spheroscope::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

constexpr double k_moving_wait_s = 1.0 / 60.0, k_still_wait_s = 0.1;
/// While the view is turned the window is drawn with each new picture, and at least this often.
constexpr double k_turning_draw_s = 0.1;
/// The survey goes on in another thread; copies of it are made this often.
constexpr double k_survey_every_s = 0.2;

class App {
  public:
    App(Window& window, Frames& frames, Painter& painter, PanelModel& model, LiveRun* live,
        const AppSettings& settings)
        : window_(window), frames_(frames), model_(model), live_(live), settings_(settings),
          survey_(frames.survey()), sheet_(frames, model, settings), painter_(painter) {
        const scene::Picture& picture = model.view.now().picture;
        if (picture.range == "given")
            recorded_range_.assign(picture.given_range.begin(), picture.given_range.end());
    }

    AppReport run();

  private:
    void take_input();
    void act(Action action);
    void take_engines_news();
    /// A range of colours that was given by hand is a change that belongs to the run.
    void record_range();
    [[nodiscard]] bool engine_runs() const {
        return live_ != nullptr && !live_->is_over() && !live_->channel().is_paused();
    }
    [[nodiscard]] SnapshotPtr wanted_snapshot();
    /// Why the frame that is wanted will not come; "" where a state of the engine is wanted.
    [[nodiscard]] std::string frame_failure();
    void pick_at(const Sight& sight);
    void take_news();
    /// What there is to say about the frames as they are now.
    [[nodiscard]] std::string status();
    void request_picture();
    /// Whether there was a new one.
    bool take_picture();
    /// A picture could not be drawn: who asked for it bears it.
    void take_trouble(const PaintedPicture& failed);
    void save_wanted_picture();
    void refuse_to_save(const std::string& reason);
    void write_image(const std::string& name, const render::Image& image,
                     const render::PngTexts& texts);
    void draw_panels();

    Window& window_;
    Frames& frames_;
    PanelModel& model_;
    LiveRun* live_;
    const AppSettings& settings_;
    const Clock::time_point begin_ = Clock::now();

    RunSurvey survey_;
    Clock::time_point surveyed_at_{};
    struct Wanted {
        SnapshotPtr snapshot;
        ViewSettings view;
        int n_surveyed = -1;
        render::Quality quality = render::Quality::full;
        std::optional<Opened> opened = {};
        ContactRows history = nullptr;
        bool operator==(const Wanted&) const = default;
    };
    Wanted requested_;
    int n_requests_ = 0, n_answered_ = 0;  // the newest one that a picture, or its trouble, came of
    std::vector<double> recorded_range_;
    std::int64_t logged_step_ = -1;
    Clock::time_point drawn_at_{};
    bool knows_end_ = false;
    bool wants_frame_ = false;  // and no state of the engine
    std::optional<PaintedPicture> shown_;
    SnapshotPtr curves_of_;
    Curve radial_stress_, force_distribution_;
    OpenedSheet sheet_;
    bool saves_picture_ = false, saves_panel_ = false;
    std::string status_;
    AppReport report_;
    Painter& painter_;
};

AppReport App::run() {
    Clock::time_point last = Clock::now();
    while (true) {
        const bool moves = model_.playback.is_playing() || model_.wants_draft();
        if (!window_.begin_frame(moves ? k_moving_wait_s : k_still_wait_s)) break;
        const double wall_s = seconds_since(last);
        last = Clock::now();
        if (model_.wants_draft()) report_.dragged_s += wall_s;
        take_input();
        take_news();
        model_.playback.advance(wall_s, model_.view.now().picture.fps);
        sheet_.follow();
        // The engine's steps would take what turning the view needs.
        if (live_ != nullptr) live_->channel().hold(model_.wants_draft());
        request_picture();
        const bool has_new_picture = take_picture();
        draw_panels();
        record_range();
        // Each motion of the mouse comes here. Where no graphics card draws the window, drawing it
        // for every one would take from the picture that is waited for.
        if (has_new_picture || saves_panel_ || !model_.wants_draft() ||
            seconds_since(drawn_at_) > k_turning_draw_s) {
            window_.draw();
            drawn_at_ = Clock::now();
        } else {
            window_.skip_drawing();
        }
        if (std::exchange(saves_panel_, false)) write_image("panel", window_.panel(), {});
    }
    return report_;
}

void App::take_input() {
    for (const KeyPress& press : window_.take_keys())
        if (const auto action = PanelModel::action_of(press.key, press.shift, press.control))
            act(*action);
}

void App::act(Action action) {
    if (command_engine(model_, live_, action)) return;
    const std::optional<Action> left = model_.act(action);
    if (!left) return;
    const auto copy = [&](const std::string& text, const std::string& what) {
        window_.set_clipboard(text);
        report_.copied = text;
        model_.message = what + " is in the clipboard";
    };
    try {
        switch (*left) {
        case Action::quit: window_.close(); break;
        case Action::save_picture: saves_picture_ = true; break;
        case Action::save_panel: saves_panel_ = true; break;
        case Action::copy_view: copy(view_text(model_.view.now()), "the view"); break;
        case Action::copy_table:
            if (model_.selection && shown_)
                copy(csv_text(*shown_->request.snapshot,
                              describe(*shown_->request.snapshot, *model_.selection)),
                     "the table");
            break;
        case Action::event_before:
        case Action::event_after: sheet_.go_to_event(*left); break;
        case Action::bookmark:
            write_bookmarks(bookmarks_path(settings_.run_file), model_.bookmarks);
            model_.message = "bookmarked in " + bookmarks_path(settings_.run_file);
            break;
        default: break;
        }
    } catch (const Error& error) {
        model_.message = error.what();
    }
}

void App::pick_at(const Sight& sight) {
    const Clock::time_point begin = Clock::now();
    const double share = shown_->request.picture.exploded;
    try {
        model_.selection = share > 0.0 ? pick(exploded(*shown_->request.snapshot, share), sight)
                                       : pick(*shown_->request.snapshot, sight);
    } catch (const Error& error) {
        model_.message = error.what();
        return;
    }
    report_.longest_pick_s = std::max(report_.longest_pick_s, seconds_since(begin));
    if (model_.selection)
        cli::log_info(fmt::format(
            "picked node {} of cell {}{}", model_.selection->node, model_.selection->cell,
            model_.selection->other_cell < 0
                ? ""
                : fmt::format(", contact with cell {}", model_.selection->other_cell)));
}

void App::take_engines_news() {
    // A look that cannot be drawn yet would cost the engine a measurement for nothing.
    if (!shown_ || n_answered_ == n_requests_) live_->take_look();
    const KeptLooks& looks = live_->looks();
    model_.live->n_looks = looks.size();
    if (looks.size() > 0) model_.live->oldest_look_s = looks.back(looks.size() - 1)->time_s;
    const std::vector<std::string> messages = live_->channel().take_messages();
    for (const std::string& message : messages) cli::log_info(message);
    if (!messages.empty()) model_.message = fmt::format("{}", fmt::join(messages, "\n"));
    if (const SnapshotPtr look = live_->newest_look();
        look != nullptr && !engine_runs() && look->diagnostics.steps != logged_step_) {
        logged_step_ = look->diagnostics.steps;
        cli::log_info(fmt::format("paused at t = {:.6g} s, step {}", look->time_s, logged_step_));
    }
    if (auto anatomy = live_->channel().take_anatomy()) {
        cli::log_info(fmt::format("took the step at t = {:.6g} s apart, {} phases", anatomy->time_s,
                                  anatomy->phases.size()));
        model_.live->anatomy = std::move(anatomy);
        model_.live->moment = 0;
        model_.live->anatomy_is_new = true;
    }
    if (live_->is_over() && !std::exchange(knows_end_, true)) {
        model_.message = live_->end_text();
        cli::log_info(model_.message);
    }
    if (cli::interrupt_signal() != 0) window_.close();
}

void App::record_range() {
    const scene::Picture& picture = model_.view.now().picture;
    if (live_ == nullptr || picture.range != "given" || ImGui::IsAnyItemActive()) return;
    const std::vector<double> range(picture.given_range.begin(), picture.given_range.end());
    if (range == recorded_range_) return;
    recorded_range_ = range;
    live_->channel().order({0.0, "picture.given_range", range});
}

void App::take_news() {
    if (live_ != nullptr) take_engines_news();
    for (const double time_s : frames_.take_new_times()) model_.playback.add_frame(time_s);
    if (frames_.n_surveyed() != survey_.n_frames() &&
        (seconds_since(surveyed_at_) > k_survey_every_s ||
         frames_.n_surveyed() == model_.playback.n_frames())) {
        survey_ = frames_.survey();
        surveyed_at_ = Clock::now();
        if (live_ == nullptr && survey_.n_frames() == model_.playback.n_frames())
            cli::log_info(fmt::format("all of the run ({}) was read after {:.2f} s",
                                      counted(survey_.n_frames(), "frame"), seconds_since(begin_)));
    }
    status_ = status();
}

std::string App::status() {
    std::string failure = frame_failure();
    if (failure.empty()) failure = frames_.contact_failure();
    if (!failure.empty()) return failure;
    const int n_frames = model_.playback.n_frames();
    if (survey_.n_frames() < n_frames)
        return fmt::format("reading the run: {} of {}; until then the colours are those of each "
                           "frame",
                           survey_.n_frames(), n_frames);
    if (survey_.n_unreadable() > 0)
        return fmt::format(
            "{} of {} cannot be read; range, scale and plots are those of the others",
            survey_.n_unreadable(), counted(n_frames, "frame"));
    return "";
}

std::string App::frame_failure() { return wants_frame_ ? frames_.failure() : ""; }

SnapshotPtr App::wanted_snapshot() {
    wants_frame_ = false;
    if (model_.shows_engine() || (live_ != nullptr && model_.playback.frame() < 0)) {
        const int back = model_.live->looks_back;
        if (SnapshotPtr look = back > 0 ? live_->looks().back(back) : live_->newest_look())
            return look;
    }
    const int frame = model_.playback.frame();
    wants_frame_ = frame >= 0;
    return wants_frame_ ? frames_.frame(frame) : nullptr;
}

void App::request_picture() {
    SnapshotPtr snapshot = wanted_snapshot();
    if (snapshot == nullptr) return;  // the one on show stays until it is there
    const int n_frames = model_.playback.n_frames();
    Wanted wanted{std::move(snapshot), model_.view.now(),
                  survey_.n_frames() == n_frames ? n_frames : 0,
                  // While the engine runs, speed matters more than smooth edges.
                  model_.wants_draft()                     ? render::Quality::coarse
                  : model_.shows_engine() && engine_runs() ? render::Quality::draft
                                                           : render::Quality::full,
                  sheet_.opened(), sheet_.contact_history()};
    if (wanted == requested_) return;
    render::View view = survey_.view_of(*wanted.snapshot, wanted.view.picture, n_frames);
    view.quality = wanted.quality;
    PictureRequest request{wanted.snapshot, wanted.view.picture, view, ++n_requests_,
                           sheet_.request_for(*wanted.snapshot)};
    painter_.request(std::move(request));
    requested_ = std::move(wanted);
}

void App::take_trouble(const PaintedPicture& failed) {
    try {
        std::rethrow_exception(failed.trouble);
    } catch (const Error& error) {
        if (failed.request.sheet) {
            sheet_.close(failed.request.sheet->opened, error.what());
            return;
        }
        if (failed.request.number != n_requests_) return;  // another picture is on its way
        if (!shown_) throw;  // there is nothing that could be shown beside the reason
        // What is on show stays, and so does a run that goes on behind it.
        model_.message = error.what();
        cli::log_error(error.what());
        saves_picture_ = false;
    }
}

bool App::take_picture() {
    bool is_new = false;
    std::optional<PaintedPicture> painted = painter_.take();
    if (painted) n_answered_ = painted->request.number;
    if (painted && painted->trouble) {
        take_trouble(*painted);
        painted.reset();
    }
    if (painted) {
        if (!shown_) {
            report_.first_picture_s = seconds_since(begin_);
            frames_.begin_survey();
            cli::log_info(fmt::format("first picture after {:.2f} s", report_.first_picture_s));
        }
        (painted->request.view.quality == render::Quality::full ? report_.full_s
                                                                : report_.draft_s) =
            painted->took_s;
        if (model_.wants_draft()) ++report_.dragged_pictures;
        window_.set_picture(painted->image);
        shown_ = std::move(painted);
        is_new = true;
    }
    if (!shown_) return false;
    const SnapshotPtr& snapshot = shown_->request.snapshot;
    if (snapshot != curves_of_) {
        curves_of_ = snapshot;
        radial_stress_ = viewer::radial_stress(*snapshot);
        force_distribution_ = viewer::force_distribution(*snapshot);
    }
    save_wanted_picture();
    return is_new;
}

void App::refuse_to_save(const std::string& reason) {
    saves_picture_ = false;
    model_.message = "no picture is saved: " + reason;
}

/// Saves what is on show as soon as it is what was asked for, in full quality and with what all
/// frames have to say about range and scale.
void App::save_wanted_picture() {
    if (const std::string failure = frame_failure(); saves_picture_ && !failure.empty()) {
        refuse_to_save(failure);
        return;
    }
    const PictureRequest& request = shown_->request;
    const bool is_current =
        request.number == n_requests_ && request.snapshot->frame == model_.playback.frame() &&
        requested_.view == model_.view.now() && requested_.quality == render::Quality::full;
    const bool knows_all = requested_.n_surveyed == model_.playback.n_frames();
    if (!saves_picture_ || !is_current || !knows_all) return;
    if (request.sheet) {
        if (const std::string failure = frames_.contact_failure(); !failure.empty()) {
            refuse_to_save(failure);
            return;
        }
        if (!sheet_.is_whole(*request.sheet)) return;
        saves_picture_ = false;
        write_image(sheet_name(*request.sheet, request.snapshot->frame), shown_->image,
                    shown_->sheet_texts);
        return;
    }
    saves_picture_ = false;
    write_image(fmt::format("{}_{:06d}", request.picture.name, request.snapshot->frame),
                shown_->image,
                render::make_provenance(*request.snapshot, request.picture, request.view,
                                        settings_.drawn_by));
}

void App::write_image(const std::string& name, const render::Image& image,
                      const render::PngTexts& texts) {
    const std::string path = (std::filesystem::path(settings_.folder) / (name + ".png")).string();
    try {
        std::error_code no_folder;  // then writing says why
        std::filesystem::create_directories(settings_.folder, no_folder);
        render::write_png(path, image, texts);
        report_.files.push_back(path);
        model_.message = "written to " + path;
        cli::log_info(fmt::format("written to {}", path));
    } catch (const Error& error) {
        model_.message = error.what();
    }
}

void App::draw_panels() {
    const SnapshotPtr snapshot = shown_ ? shown_->request.snapshot : nullptr;
    PanelContext panel{model_,
                       *frames_.header(),
                       shown_ ? &*shown_ : nullptr,
                       snapshot,
                       survey_.summaries(),
                       radial_stress_,
                       force_distribution_,
                       status_,
                       live_,
                       [this](Action action) { act(action); },
                       [this](const Sight& sight) { pick_at(sight); },
                       sheet_.contact_history(),
                       window_.picture_texture(),
                       window_.small_font()};
    draw_layout(panel);
}

}  // namespace

AppReport run_app(Window& window, Frames& frames, Painter& painter, PanelModel& model,
                  LiveRun* live, const AppSettings& settings) {
    return App(window, frames, painter, model, live, settings).run();
}

}  // namespace spheroscope::viewer
