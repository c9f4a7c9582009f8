// Pictures that cannot be drawn: whose fault it is.
#include "tests/inspect/small_runs.hpp"
#include "tests/store/run_samples.hpp"
#include "viewer/app.hpp"
#include "viewer/opened_sheet.hpp"
#include "viewer/painter.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace spheroscope::viewer {
namespace {

const inspect::ContactKey k_contact{0, 1}, k_other_contact{0, 2};
const NodeOfCell k_nobodys{7, 0};

std::string trouble_of(const PaintedPicture& painted) {
    return samples::error_of([&] {
        if (painted.trouble) std::rethrow_exception(painted.trouble);
    });
}

TEST(APictureThatCannotBeDrawn, ComesBackWithTheRequestThatFailed) {
    const test::SmallRun run = test::run_scene_text(test::text_of({}));
    scene::Picture picture;
    picture.size_px = {64, 64};
    Painter painter(run.header, picture, [] {});
    const auto painted = [&](PictureRequest request) {
        painter.request(std::move(request));
        for (int k = 0; k < 5000; ++k) {
            if (std::optional<PaintedPicture> taken = painter.take()) return *taken;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return PaintedPicture{};
    };
    PictureRequest all_cells{run.last(), picture, {}, 1};
    all_cells.picture.field = "gamma_eff";  // which the run does not hold
    const PaintedPicture of_all = painted(all_cells);
    EXPECT_NE(trouble_of(of_all).find("gamma_eff"), std::string::npos) << trouble_of(of_all);
    EXPECT_EQ(of_all.request.number, 1);
    EXPECT_FALSE(of_all.request.sheet.has_value());

    PictureRequest sheet{run.last(), picture, {}, 2, SheetRequest{k_nobodys, nullptr, "", ""}};
    const PaintedPicture of_sheet = painted(sheet);
    EXPECT_NE(trouble_of(of_sheet), "");
    EXPECT_EQ(of_sheet.request.number, 2);
    ASSERT_TRUE(of_sheet.request.sheet.has_value());
    EXPECT_EQ(of_sheet.request.sheet->opened, Opened{k_nobodys});

    const PaintedPicture good = painted({run.last(), picture, {}, 3});
    EXPECT_EQ(trouble_of(good), "");
    EXPECT_EQ(good.image.width, 64);
}

/// Frames of nothing.
class NoFrames final : public Frames {
  public:
    [[nodiscard]] std::shared_ptr<const RunHeader> header() const override { return nullptr; }
    [[nodiscard]] std::vector<double> take_new_times() override { return {}; }
    [[nodiscard]] SnapshotPtr frame(int) override { return nullptr; }
    [[nodiscard]] RunSurvey survey() override { return RunSurvey(RunHeader()); }
    [[nodiscard]] int n_surveyed() override { return 0; }
    void watch_contact(std::optional<inspect::ContactKey>) override {}
    [[nodiscard]] ContactRows contact_history() override { return nullptr; }
    [[nodiscard]] std::string contact_failure() override { return ""; }
    [[nodiscard]] std::string failure() override { return ""; }
};

TEST(AnOpenedContact, IsClosedByItsOwnTroubleAndNotByThatOfAnother) {
    NoFrames frames;
    PanelModel model({scene::Picture{}});
    const AppSettings settings;
    OpenedSheet sheet(frames, model, settings);
    model.opened = k_contact;
    sheet.follow();
    sheet.close(Opened{k_other_contact}, "what was open before");
    EXPECT_EQ(model.opened, Opened{k_contact});
    EXPECT_NE(model.message, "what was open before");
    sheet.close(Opened{k_contact}, "it cannot be drawn");
    EXPECT_FALSE(model.opened.has_value());
    EXPECT_EQ(model.message, "it cannot be drawn");
    sheet.close(Opened{k_contact}, "late news of what is closed");
    EXPECT_EQ(model.message, "it cannot be drawn");
}

}  // namespace
}  // namespace spheroscope::viewer
