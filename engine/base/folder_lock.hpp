#pragma once

#include "engine/base/descriptor.hpp"

#include <filesystem>

namespace spheroscope {

/// While it lives, no other one of this folder can be had, in this program or another: two jobs do
/// not write the same pictures. It leaves no file behind, and ends with its process however that
/// ends. Where the file system knows no locks (some network ones), nothing is locked.
class FolderLock {
  public:
    /// Throws Error (environment) when another program has the folder. Precondition: the folder
    /// exists.
    explicit FolderLock(const std::filesystem::path& folder);

  private:
    Descriptor folder_;
};

}  // namespace spheroscope
