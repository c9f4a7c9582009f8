#pragma once

namespace spheroscope {

/// From now on this thread, and the threads that it starts, get a processor only as far as others
/// of this program (and of the machine) leave one: a tenth of it where all are busy. Where the
/// system refuses, nothing changes.
void let_other_threads_first();

}  // namespace spheroscope
