#include "engine/store/gzip_chunk.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

namespace spheroscope::hdf5 {
namespace {

/// The fastest that finds repetitions.
constexpr int k_level = 1;
/// Second filter of the pipeline.
constexpr std::uint32_t k_without_deflate = 2;

/// First bytes of all values, then their second ones, ...: similar bytes come together.
std::vector<std::byte> shuffled(std::span<const std::byte> values, std::size_t value_size) {
    std::vector<std::byte> out(values.size());
    const std::size_t n = values.size() / value_size;
    for (std::size_t k = 0; k < value_size; ++k)
        for (std::size_t i = 0; i < n; ++i) out[k * n + i] = values[i * value_size + k];
    return out;
}

struct FreeCompressor {
    void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

}  // namespace

GzipChunk pack_chunk(std::span<const std::byte> values, std::size_t value_size) {
    thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(k_level));
    if (!compressor) throw std::bad_alloc();
    std::vector<std::byte> plain = shuffled(values, value_size);
    GzipChunk chunk;
    chunk.bytes.resize(plain.size());
    const std::size_t size = libdeflate_zlib_compress(compressor.get(), plain.data(), plain.size(),
                                                      chunk.bytes.data(), chunk.bytes.size());
    if (size > 0)
        chunk.bytes.resize(size);
    else
        chunk = {std::move(plain), k_without_deflate};
    return chunk;
}

}  // namespace spheroscope::hdf5
