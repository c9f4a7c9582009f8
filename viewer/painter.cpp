#include "viewer/painter.hpp"

#include "engine/inspect/contact_story.hpp"
#include "render/contact_sheet.hpp"
#include "render/node_sheet.hpp"

#include <chrono>
#include <memory>
#include <utility>

namespace spheroscope::viewer {

namespace {

/// Draws one contact in whichever frames are asked for.
class ContactPainter {
  public:
    ContactPainter(const std::shared_ptr<const RunHeader>& header, const inspect::ContactKey& key)
        : key_(key),
          pair_(header, {key.cell_a, key.cell_b}, inspect::FrameSystem::Detail::contacts),
          sheet_(header, key) {}

    [[nodiscard]] const inspect::ContactKey& key() const { return key_; }

    void paint(const PictureRequest& request, PaintedPicture& painted) {
        const SheetRequest& wanted = *request.sheet;
        if (wanted.history != history_) sheet_.set_history(*wanted.history);
        history_ = wanted.history;
        painted.image = sheet_.draw(inspect::contact_in(pair_, request.snapshot, key_));
        painted.sheet_texts = sheet_.texts(wanted.made_by, wanted.command);
    }

  private:
    inspect::ContactKey key_;
    inspect::FrameSystem pair_;
    render::ContactSheet sheet_;
    ContactRows history_;
};

/// Draws the forces on any node in any frame.
class NodePainter {
  public:
    explicit NodePainter(const std::shared_ptr<const RunHeader>& header)
        : whole_(header, {}, inspect::FrameSystem::Detail::forces) {}

    void paint(const PictureRequest& request, PaintedPicture& painted) {
        const SheetRequest& wanted = *request.sheet;
        const inspect::NodeMoment moment =
            inspect::node_in(whole_, request.snapshot, std::get<NodeOfCell>(wanted.opened));
        painted.image = sheet_.draw(moment);
        painted.sheet_texts = render::node_sheet_texts(moment, wanted.made_by, wanted.command);
    }

  private:
    inspect::FrameSystem whole_;
    render::NodeSheet sheet_;
};

/// Draws what is open; keeps what the next picture of the same kind needs.
class SheetPainter {
  public:
    void paint(const PictureRequest& request, PaintedPicture& painted) {
        const std::shared_ptr<const RunHeader>& header = request.snapshot->header;
        if (const auto* key = std::get_if<inspect::ContactKey>(&request.sheet->opened)) {
            if (contact_ == nullptr || !(contact_->key() == *key))
                contact_ = std::make_unique<ContactPainter>(header, *key);
            contact_->paint(request, painted);
        } else {
            if (node_ == nullptr) node_ = std::make_unique<NodePainter>(header);
            node_->paint(request, painted);
        }
    }

  private:
    std::unique_ptr<ContactPainter> contact_;
    std::unique_ptr<NodePainter> node_;
};

}  // namespace

Painter::Painter(std::shared_ptr<const RunHeader> header, scene::Picture first,
                 std::function<void()> on_news)
    : header_(std::move(header)), first_(std::move(first)), on_news_(std::move(on_news)),
      thread_([this] { paint_all(); }) {}

Painter::~Painter() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Painter::request(PictureRequest wanted) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = std::move(wanted);
    }
    changed_.notify_all();
}

std::optional<PaintedPicture> Painter::take() {
    const std::lock_guard lock(mutex_);
    if (not_ready_) std::rethrow_exception(not_ready_);
    return std::exchange(painted_, std::nullopt);
}

void Painter::paint_all() {
    std::unique_ptr<render::Renderer> renderer;
    SheetPainter sheets;
    std::exception_ptr not_ready;
    try {
        renderer = std::make_unique<render::Renderer>(header_, first_);
    } catch (...) {
        not_ready = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    if (not_ready) {
        not_ready_ = not_ready;
        on_news_();
        return;
    }
    while (true) {
        changed_.wait(lock, [&] { return is_over_ || wanted_; });
        if (is_over_) return;
        PaintedPicture painted{.request = std::move(*wanted_), .image = {}, .camera = {}};
        wanted_.reset();
        lock.unlock();
        const PictureRequest& request = painted.request;
        const auto begin = std::chrono::steady_clock::now();
        try {
            renderer->set_picture(request.picture);
            if (request.sheet)
                sheets.paint(request, painted);
            else
                painted.image = renderer->render(*request.snapshot, request.view);
            painted.camera = renderer->camera(*request.snapshot, request.view);
        } catch (...) {
            painted.trouble = std::current_exception();
        }
        painted.took_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        lock.lock();
        painted_ = std::move(painted);
        on_news_();
    }
}

}  // namespace spheroscope::viewer
