#include "engine/base/folder_lock.hpp"

#include "engine/base/error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>

namespace spheroscope {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_.number() >= 0 && flock(folder_.number(), LOCK_EX | LOCK_NB) != 0 &&
        errno == EWOULDBLOCK)
        throw Error(folder.string() + ": another program is writing into this folder",
                    "wait until it has ended, or name another folder with -o",
                    ExitCode::environment);
}

}  // namespace spheroscope
