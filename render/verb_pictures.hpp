#pragma once

#include "engine/cli/options.hpp"
#include "engine/scene/scene.hpp"
#include "engine/store/run_file.hpp"
#include "render/frame_source.hpp"

#include <string>
#include <vector>

namespace spheroscope {

/// The frames of a run's file.
class StoredFrames final : public render::FrameSource {
  public:
    explicit StoredFrames(const RunFileReader& reader) : reader_(&reader) {}
    [[nodiscard]] int n_frames() override { return reader_->n_frames(); }
    [[nodiscard]] SnapshotPtr frame(int i) override { return reader_->frame(i); }

  private:
    const RunFileReader* reader_;
};

/// Whether an argument names a run's file, and not a scene.
[[nodiscard]] bool is_run_file(const std::string& path);

/// The pictures that the run's own scene asks for, with the overrides of the command line.
[[nodiscard]] std::vector<scene::Picture> pictures_of(const RunFileReader& reader,
                                                      const cli::CommonOptions& options);

/// The pictures that `wanted` names: one of them, "all", or the first for "". Throws Error (usage)
/// with the names that exist.
[[nodiscard]] std::vector<scene::Picture> choose(const std::vector<scene::Picture>& pictures,
                                                 const std::string& wanted);

}  // namespace spheroscope
