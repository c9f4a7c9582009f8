#pragma once

#include "engine/run/checkpoint_data.hpp"

#include <string>

namespace spheroscope {

struct LoadedCheckpoint {
    CheckpointData data;
    std::string path;  ///< where it came from
    std::string note;  ///< to be shown: why it is not the newest one; "" if it is
};

/// "out/a.h5" -> "out/a.checkpoint.h5" and "out/a.checkpoint.1.h5", the one before.
[[nodiscard]] std::string checkpoint_path(const std::string& run_path);
[[nodiscard]] std::string older_checkpoint_path(const std::string& run_path);

/// Writes the newest checkpoint of a run; the one before it is kept, those before are gone. The new
/// file has its name only when it is on the disk to the last byte: a power cut leaves one of the
/// two. Throws Error, e.g. when the disk is full; then the earlier checkpoints are as they were.
void write_checkpoint(const std::string& run_path, const CheckpointData& data);

/// Reads one file and verifies its checksum. Throws Error.
[[nodiscard]] CheckpointData read_checkpoint(const std::string& path);

/// The newest checkpoint of a run that can be read. Throws Error, with the reasons for both files,
/// if there is none.
[[nodiscard]] LoadedCheckpoint read_newest_checkpoint(const std::string& run_path);

/// Removes both, if they are there. For a run that begins anew under an old name.
void remove_checkpoints(const std::string& run_path);

}  // namespace spheroscope
