#pragma once

#include "render/picture.hpp"
#include "render/png.hpp"
#include "viewer/frames.hpp"
#include "viewer/model/opened.hpp"

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace spheroscope::viewer {

/// What is to be shown instead of the aggregate, as `inspect` draws it.
struct SheetRequest {
    Opened opened;
    ContactRows history;           ///< of a contact; nullptr otherwise
    std::string made_by, command;  ///< for the texts of a file
};

/// What a picture is to show.
struct PictureRequest {
    SnapshotPtr snapshot;
    scene::Picture picture;
    render::View view;
    int number = 0;  ///< tells requests apart
    std::optional<SheetRequest> sheet = {};
};

struct PaintedPicture {
    PictureRequest request;
    /// Why it could not be drawn; then there is nothing else but the request.
    std::exception_ptr trouble = nullptr;
    render::Image image;
    render::Camera camera;
    double took_s = 0.0;
    render::PngTexts sheet_texts = {};
};

/// Draws pictures in a thread of its own, which owns the OSMesa context. The newest request wins:
/// whoever turns a view wants to see where it is, not where it was.
class Painter {
  public:
    /// Gets ready at once for pictures of this run. `on_news` is called in the drawing thread after
    /// each picture.
    Painter(std::shared_ptr<const RunHeader> header, scene::Picture first,
            std::function<void()> on_news);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    void request(PictureRequest wanted);
    /// The newest picture, once, or what has come of it. Throws where nothing can be drawn at all.
    [[nodiscard]] std::optional<PaintedPicture> take();

  private:
    void paint_all();

    const std::shared_ptr<const RunHeader> header_;
    const scene::Picture first_;
    const std::function<void()> on_news_;
    std::mutex mutex_;
    std::condition_variable changed_;
    // guarded by mutex_
    bool is_over_ = false;
    std::optional<PictureRequest> wanted_;
    std::optional<PaintedPicture> painted_;
    std::exception_ptr not_ready_;

    std::thread thread_;  // last
};

}  // namespace spheroscope::viewer
