#include "engine/base/whole_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace spheroscope {
namespace {

namespace fs = std::filesystem;

class WholeFileTest : public testing::Test {
  protected:
    WholeFileTest() { fs::create_directories(folder_); }
    ~WholeFileTest() override { fs::remove_all(folder_); }
    WholeFileTest(const WholeFileTest&) = delete;
    WholeFileTest& operator=(const WholeFileTest&) = delete;
    static std::string text_in(const fs::path& path) {
        std::ifstream file(path);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::ptrdiff_t n_files() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }
    const fs::path folder_ = fs::path(testing::TempDir()) / "whole_file";
    const fs::path path_ = folder_ / "a.txt";
};

TEST_F(WholeFileTest, HasItsNameWhenItIsPublishedAndNotBefore) {
    std::ofstream(path_) << "old";
    WholeFile file(path_);
    std::ofstream(file.working_path()) << "new";
    EXPECT_EQ(text_in(path_), "old");
    EXPECT_FALSE(file.publish());
    EXPECT_EQ(text_in(path_), "new");
    EXPECT_EQ(n_files(), 1);
}

TEST_F(WholeFileTest, ThatIsNotPublishedLeavesNothing) {
    {
        const WholeFile file(path_);
        std::ofstream(file.working_path()) << "half";
        EXPECT_EQ(n_files(), 1);
    }
    EXPECT_EQ(n_files(), 0);
}

TEST_F(WholeFileTest, SaysWhyItCannotHaveItsName) {
    WholeFile file(path_);
    std::ofstream(file.working_path()) << "whole";
    fs::create_directories(path_ / "in_the_way");
    EXPECT_TRUE(file.publish());
}

TEST_F(WholeFileTest, ThatIsADeviceIsWrittenAsItIs) {
    WholeFile device("/dev/null");
    EXPECT_EQ(device.working_path(), "/dev/null");
    EXPECT_FALSE(device.publish());
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace spheroscope
