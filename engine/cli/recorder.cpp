#include "engine/cli/recorder.hpp"

#include "engine/store/checkpoint_file.hpp"

#include <algorithm>
#include <utility>

namespace spheroscope::cli {
namespace {

/// Frames that the store may be behind the engine.
constexpr int k_queue_capacity = 8;

}  // namespace

Recorder::Recorder(const Engine& engine, const std::string& run_file, bool continues_file,
                   std::vector<Change> changes)
    : engine_(engine), run_file_(run_file), changes_(std::move(changes)), queue_(k_queue_capacity),
      store_(
          continues_file
              ? RunFileWriter::append(run_file, *engine.header(), engine.state().frames)
              : RunFileWriter::create(run_file, *engine.header(), RunFileWriter::Existing::replace),
          queue_.add_reader("store")) {}

void Recorder::add_to(EngineSinks& sinks) {
    if (!changes_.empty()) store_.record_changes(changes_);
    sinks.frame = [this](SnapshotPtr frame) { return queue_.push(std::move(frame)); };
    sinks.checkpoint = [this](const CheckpointData& data) {
        store_.when_written(engine_.state().frames, [&] { write_checkpoint(run_file_, data); });
    };
    sinks.changed = [this](const Change& change) { add_change(change); };
}

void Recorder::add_change(const Change& change) {
    // A resumed run may still have changes of its file before it.
    const auto is_earlier = [](const Change& a, const Change& b) { return a.time_s < b.time_s; };
    changes_.insert(std::upper_bound(changes_.begin(), changes_.end(), change, is_earlier), change);
    store_.record_changes(changes_);
}

void Recorder::end(RunResult& result) {
    queue_.close();
    store_.join();
    const auto reason = queue_.failure();
    if (!reason || result.verdict == RunVerdict::sink_failed) return;
    result.verdict = RunVerdict::sink_failed;
    result.outcome = "stopped";
    result.message = *reason;
}

}  // namespace spheroscope::cli
