// Chunks that are packed here are read by HDF5's own filters.

#include "engine/base/random.hpp"
#include "engine/store/gzip_chunk.hpp"
#include "engine/store/hdf5_file.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace spheroscope::test {
namespace {

using hdf5::File;
using hdf5::Packing;

template <class T> std::vector<T> written_and_read(const std::vector<T>& values) {
    const samples::Folder folder;
    const std::string path = folder / "chunk.h5";
    {
        File file(path, File::Mode::create);
        file.write_array<T>("/values", values, {values.size()}, Packing::gzip);
        file.commit();
    }
    return File(path, File::Mode::read).read_array<T>("/values");
}

TEST(GzipChunk, IsReadByHdf5) {
    std::vector<float> smooth(10'000);
    std::iota(smooth.begin(), smooth.end(), 0.5F);
    EXPECT_EQ(written_and_read(smooth), smooth);
    const auto chunk = hdf5::pack_chunk(std::as_bytes(std::span(smooth)), sizeof(float));
    EXPECT_EQ(chunk.filter_mask, 0U);
    EXPECT_LT(chunk.bytes.size(), sizeof(float) * smooth.size() / 2);

    const std::vector<std::int64_t> wide{-1, std::int64_t{1} << 40, 3};
    EXPECT_EQ(written_and_read(wide), wide);
}

TEST(GzipChunk, OfNoiseIsStoredAsItIs) {
    Random random(1, 2);
    std::vector<std::uint8_t> noise(5000);
    std::uint64_t i = 0;
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(256.0 * random.uniform(i++));
    const auto chunk = hdf5::pack_chunk(std::as_bytes(std::span(noise)), 1);
    EXPECT_NE(chunk.filter_mask, 0U);
    EXPECT_EQ(chunk.bytes.size(), noise.size());
    EXPECT_EQ(written_and_read(noise), noise);
}

}  // namespace
}  // namespace spheroscope::test
