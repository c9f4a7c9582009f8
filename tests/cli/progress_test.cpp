#include "engine/cli/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace spheroscope::cli {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

/// A progress display that writes into memory, with a clock that the test sets.
class ProgressTest : public testing::Test {
  protected:
    ~ProgressTest() override {
        std::fclose(out_);
        std::free(text_);
    }
    Progress make(ProgressStyle style, int width = 120) {
        return Progress(style, out_, width, [this] { return now_s_; });
    }
    std::string text() {
        std::fflush(out_);
        return {text_, size_};
    }
    std::size_t n_lines() {
        const std::string all = text();
        return static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
    }

    double now_s_ = 100.0;

  private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    std::FILE* out_ = open_memstream(&text_, &size_);
};

TEST_F(ProgressTest, ALogGetsOneLinePerFivePercent) {
    Progress progress = make(ProgressStyle::lines);
    for (int step = 0; step <= 10000; ++step)
        progress.update({"compact", step / 10000.0, 0.001 * step, 1e-3});
    EXPECT_EQ(n_lines(), 21U);
}

TEST_F(ProgressTest, ALineSaysPartShareTimeStepAndRemainingTime) {
    Progress progress = make(ProgressStyle::lines);
    progress.update({"relax", 0.0, 0.0, k_unknown});
    now_s_ += 60.0;
    progress.update({"relax", 0.25, 12.5, 3.85e-3});
    EXPECT_EQ(text(), "relax        0 %  t = 0.00 s\n"
                      "relax       25 %  t = 12.50 s  dt = 3.85 ms  ETA 3 min 00 s\n");
}

TEST_F(ProgressTest, WhereTheEndIsNotKnownThereIsASignOfLifeButNoShare) {
    Progress progress = make(ProgressStyle::lines);
    for (int second = 0; second < 95; ++second) {
        now_s_ = second;
        progress.update({"relax", k_unknown, k_unknown, k_unknown});
    }
    EXPECT_EQ(n_lines(), 4U);
    EXPECT_EQ(text().find('%'), std::string::npos);
    EXPECT_EQ(text().find("ETA"), std::string::npos);
}

TEST_F(ProgressTest, ANewPartBeginsItsOwnCount) {
    Progress progress = make(ProgressStyle::lines);
    progress.update({"anneal", 0.9, k_unknown, k_unknown});
    now_s_ += 10.0;
    progress.update({"compact", 0.0, k_unknown, k_unknown});
    now_s_ += 10.0;
    progress.update({"compact", 0.5, k_unknown, k_unknown});
    EXPECT_NE(text().find("compact     50 %  ETA 10 s\n"), std::string::npos) << text();
}

TEST_F(ProgressTest, ABarIsRedrawnAtMostTenTimesASecond) {
    Progress progress = make(ProgressStyle::bar);
    for (int step = 0; step < 1000; ++step) {
        now_s_ = 0.001 * step;
        progress.update({"compact", 0.001 * step, 1.0, 1e-3});
    }
    const std::string all = text();
    EXPECT_EQ(std::count(all.begin(), all.end(), '\r'), 10);
    EXPECT_NE(all.find("[##########..........]  50 %"), std::string::npos) << all;
}

TEST_F(ProgressTest, ABarIsNeverWiderThanTheTerminal) {
    Progress progress = make(ProgressStyle::bar, 20);
    progress.update({"compact", 0.5, 1.0, 1e-3});
    EXPECT_EQ(text(), "\r\033[Kcompact    [#######");
}

TEST_F(ProgressTest, QuietWritesNothing) {
    Progress progress = make(ProgressStyle::none);
    progress.update({"compact", 0.5, 1.0, 1e-3});
    EXPECT_EQ(text(), "");
}

TEST(DurationText, GivesTwoUnitsAtMost) {
    EXPECT_EQ(duration_text(0.26), "0.3 s");
    EXPECT_EQ(duration_text(9.96), "10 s");
    EXPECT_EQ(duration_text(59.7), "1 min 00 s");
    EXPECT_EQ(duration_text(125.0), "2 min 05 s");
    EXPECT_EQ(duration_text(11520.0), "3 h 12 min");
}

}  // namespace
}  // namespace spheroscope::cli
