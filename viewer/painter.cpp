#include "viewer/painter.hpp"

#include "engine/inspect/contact_story.hpp"
#include "render/contact_sheet.hpp"

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
        const ContactRequest& wanted = *request.contact;
        if (wanted.history != history_) sheet_.set_history(*wanted.history);
        history_ = wanted.history;
        painted.image = sheet_.draw(inspect::contact_in(pair_, request.snapshot, key_));
        painted.contact_texts = sheet_.texts(wanted.made_by, wanted.command);
    }

  private:
    inspect::ContactKey key_;
    inspect::FrameSystem pair_;
    render::ContactSheet sheet_;
    ContactRows history_;
};

}  // namespace

Painter::Painter(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this] { paint_all(); }) {}

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
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return std::exchange(painted_, std::nullopt);
}

void Painter::paint_all() {
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<ContactPainter> contact;
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return is_over_ || wanted_; });
        if (is_over_) return;
        PaintedPicture painted{std::move(*wanted_), {}, {}, 0.0, {}};
        wanted_.reset();
        lock.unlock();
        const PictureRequest& request = painted.request;
        const auto begin = std::chrono::steady_clock::now();
        std::exception_ptr failure;
        try {
            if (request.contact &&
                (contact == nullptr || !(contact->key() == request.contact->key)))
                contact = std::make_unique<ContactPainter>(request.snapshot->header,
                                                           request.contact->key);
            if (renderer == nullptr)
                renderer =
                    std::make_unique<render::Renderer>(request.snapshot->header, request.picture);
            renderer->set_picture(request.picture);
            if (request.contact)
                contact->paint(request, painted);
            else
                painted.image = renderer->render(*request.snapshot, request.view);
            painted.camera = renderer->camera(*request.snapshot, request.view);
        } catch (...) {
            failure = std::current_exception();
        }
        painted.took_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        lock.lock();
        if (failure)
            failure_ = failure;
        else
            painted_ = std::move(painted);
        on_news_();
    }
}

}  // namespace spheroscope::viewer
