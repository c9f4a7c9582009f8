#include "engine/base/priority.hpp"

#include <sys/resource.h>
#include <unistd.h>

namespace spheroscope {

void let_other_threads_first() {
    constexpr int nice = 10;  // on Linux a property of each thread, and inherited
    static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), nice));
}

}  // namespace spheroscope
