#pragma once

#include <cstdint>

namespace spheroscope {
class AtomicFile;
}

namespace spheroscope::hdf5 {

/// Makes the HDF5 library read and write through `storage`: sets the driver of a file access
/// property list. `storage` must outlive every file that is opened with the list. Returns false if
/// HDF5 refuses.
///
/// The result is a plain HDF5 file. The library's own file locking does not take part, so that the
/// file of a killed writer opens without HDF5_USE_FILE_LOCKING; AtomicFile locks instead.
[[nodiscard]] bool use_storage(std::int64_t access_properties, AtomicFile& storage);

}  // namespace spheroscope::hdf5
