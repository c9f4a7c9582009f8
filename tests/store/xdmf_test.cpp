#include "engine/store/hdf5_file.hpp"
#include "engine/store/run_file.hpp"
#include "engine/store/xdmf.hpp"
#include "run_samples.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace spheroscope {
namespace {

class Xdmf : public testing::Test {
  protected:
    void SetUp() override {
        RunFileWriter writer =
            RunFileWriter::create(path_, *header_, RunFileWriter::Existing::refuse);
        for (int n = 0; n < k_frames; ++n) writer.write(samples::make_frame(header_, n));
        text_ = xdmf_text(RunFileReader(path_));
    }
    [[nodiscard]] std::ptrdiff_t count(const std::string& pattern) const {
        const std::regex regex(pattern);
        return std::distance(std::sregex_iterator(text_.begin(), text_.end(), regex), {});
    }

    static constexpr int k_frames = 3;
    samples::Folder folder_;
    std::string path_ = folder_ / "run.h5";
    std::shared_ptr<const RunHeader> header_ = samples::make_header();
    std::string text_;
};

TEST_F(Xdmf, EveryArrayItNamesIsAWholeDatasetOfThatShape) {
    const hdf5::File file(path_, hdf5::File::Mode::read);
    const std::regex item("Dimensions=\"([0-9 ]+)\">run\\.h5:([^<]+)<");
    int n_items = 0;
    for (std::sregex_iterator it(text_.begin(), text_.end(), item), end; it != end; ++it) {
        std::string shape;
        for (const std::uint64_t n : file.shape((*it)[2]))
            shape += (shape.empty() ? "" : " ") + std::to_string(n);
        EXPECT_EQ((*it)[1], shape) << (*it)[2];
        ++n_items;
    }
    // triangles, positions, normals, one field of nodes, one of triangles
    EXPECT_EQ(n_items, 5 * k_frames);
}

TEST_F(Xdmf, EveryFrameHasItsTimeAndFieldsStandWhereTheyBelong) {
    EXPECT_EQ(count("<Time Value=\"[0-9.e+-]+\"/>"), k_frames);
    EXPECT_EQ(count("Name=\"sigma_nn \\(kPa\\)\" AttributeType=\"Scalar\" Center=\"Cell\""),
              k_frames);
    EXPECT_EQ(count("Name=\"gamma_eff \\(nN/um\\)\" AttributeType=\"Scalar\" Center=\"Node\""),
              k_frames);
    EXPECT_EQ(count("sigma_h"), 0);
}

TEST_F(Xdmf, AFileNameWithSpecialCharactersIsEscaped) {
    const std::string odd = folder_ / "a&b.h5";
    std::filesystem::copy_file(path_, odd);
    EXPECT_NE(xdmf_text(RunFileReader(odd)).find(">a&amp;b.h5:/steps"), std::string::npos);
}

TEST_F(Xdmf, ItIsWrittenBesideTheRun) {
    write_xdmf(RunFileReader(path_));
    EXPECT_EQ(samples::read_bytes(folder_ / "run.xdmf"), text_);
    EXPECT_EQ(folder_.list(), "run.h5 run.xdmf");
}

}  // namespace
}  // namespace spheroscope
