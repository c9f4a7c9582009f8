#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spheroscope::hdf5 {

/// What a dataset of one chunk holds on disk behind HDF5's filters `shuffle` and `deflate`, in this
/// order; any HDF5 reader opens it.
struct GzipChunk {
    std::vector<std::byte> bytes;
    std::uint32_t filter_mask = 0;  ///< bit 1: not deflated, because that would not make it smaller
};

/// Packs the bytes of values of value_size bytes each (values.size() is a multiple of it). Done
/// here and not by HDF5, whose own filters take twice as long (zlib; libdeflate is faster).
[[nodiscard]] GzipChunk pack_chunk(std::span<const std::byte> values, std::size_t value_size);

}  // namespace spheroscope::hdf5
