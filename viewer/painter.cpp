#include "viewer/painter.hpp"

#include <chrono>
#include <memory>
#include <utility>

namespace spheroscope::viewer {

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
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return is_over_ || wanted_; });
        if (is_over_) return;
        PaintedPicture painted{std::move(*wanted_), {}, {}, 0.0};
        wanted_.reset();
        lock.unlock();
        const PictureRequest& request = painted.request;
        const auto begin = std::chrono::steady_clock::now();
        std::exception_ptr failure;
        try {
            if (renderer == nullptr)
                renderer =
                    std::make_unique<render::Renderer>(request.snapshot->header, request.picture);
            renderer->set_picture(request.picture);
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
