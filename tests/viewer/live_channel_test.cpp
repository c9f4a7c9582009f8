#include "tests/viewer/two_cells.hpp"
#include "viewer/model/live_channel.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace spheroscope::viewer {
namespace {

/// An engine of nothing: counts its steps until it is stopped.
class CountingEngine {
  public:
    explicit CountingEngine(LiveChannel& channel)
        : channel_(channel), thread_([this] {
              const auto snapshot = two_cells();
              channel_.begin(snapshot->header);
              const std::atomic<bool> no_signal{false};
              while (channel_.go_on(no_signal)) {
                  if (const auto question = channel_.take_question()) {
                      auto answer = std::make_shared<StepAnatomy>();
                      answer->node = question->node;
                      answer->time_s = n_steps;
                      channel_.anatomy(answer);
                      continue;
                  }
                  for (const Change& change : channel_.take_changes()) channel_.changed(change);
                  ++n_steps;
                  if (channel_.wants_look()) channel_.look(snapshot);
                  if (n_steps % 10 == 0) channel_.frame(snapshot);
                  std::this_thread::sleep_for(std::chrono::microseconds(200));
              }
          }) {}
    ~CountingEngine() {
        channel_.stop();
        thread_.join();
    }
    std::atomic<int> n_steps{0};

  private:
    LiveChannel& channel_;
    std::thread thread_;
};

template <class Condition> bool comes_true(const Condition& condition) {
    for (int k = 0; k < 5000 && !condition(); ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return condition();
}

/// The number of steps once it no longer changes.
int steps_at_rest(const CountingEngine& engine) {
    int before = -1;
    while (before != engine.n_steps.load()) {
        before = engine.n_steps.load();
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
    return before;
}

TEST(APause, ReallyStopsTheEngineAndStepsAreSingle) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    EXPECT_TRUE(comes_true([&] { return engine.n_steps > 5; }));
    channel.pause();
    const int paused_at = steps_at_rest(engine);
    for (int k = 1; k <= 3; ++k) {
        channel.step();
        EXPECT_TRUE(comes_true([&] { return engine.n_steps == paused_at + k; }));
        EXPECT_EQ(steps_at_rest(engine), paused_at + k);
        EXPECT_NE(channel.take_look(), nullptr);  // what the step has done is shown
    }
    channel.play();
    EXPECT_TRUE(comes_true([&] { return engine.n_steps > paused_at + 20; }));
}

TEST(AQuestionAboutTheNextStep, IsAnsweredInAPauseWithoutMakingTheStep) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    std::shared_ptr<const StepAnatomy> answer;
    const auto comes = [&] {
        if (auto news = channel.take_anatomy()) answer = std::move(news);
        return answer != nullptr;
    };
    channel.look_into_step(NodeOfCell{1, 5});  // the engine was running
    ASSERT_TRUE(comes_true(comes));
    EXPECT_TRUE(channel.is_paused());
    const int paused_at = steps_at_rest(engine);
    EXPECT_EQ(answer->time_s, paused_at);
    ASSERT_TRUE(answer->node.has_value());
    EXPECT_EQ(answer->node->node, 5);
    EXPECT_EQ(channel.take_anatomy(), nullptr);  // once
    answer.reset();
    channel.look_into_step({});
    EXPECT_TRUE(comes_true(comes));
    EXPECT_EQ(steps_at_rest(engine), paused_at);
    channel.step();
    EXPECT_TRUE(comes_true([&] { return engine.n_steps == paused_at + 1; }));
}

TEST(AHold, StopsTheEngineAndNothingElse) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    channel.hold(true);
    const int held_at = steps_at_rest(engine);
    EXPECT_FALSE(channel.is_paused());
    channel.step();  // a pause was asked for, and one step in it
    EXPECT_EQ(steps_at_rest(engine), held_at);
    channel.hold(false);
    EXPECT_TRUE(comes_true([&] { return engine.n_steps == held_at + 1; }));
    EXPECT_EQ(steps_at_rest(engine), held_at + 1);
    channel.play();
    EXPECT_TRUE(comes_true([&] { return engine.n_steps > held_at + 20; }));
    channel.hold(true);  // and the panel is closed
}

TEST(APause, EndsWhenThePanelIsClosed) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    channel.pause();
    static_cast<void>(steps_at_rest(engine));
    channel.stop();  // the engine's thread is joined when it has ended
}

TEST(AnOrder, ReachesTheEngineOnce) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    channel.order({0.0, "cortex.tension.gamma", {0.7}});
    EXPECT_TRUE(comes_true([&] { return channel.changes().size() == 1; }));
    const int n = engine.n_steps;
    EXPECT_TRUE(comes_true([&] { return engine.n_steps > n + 5; }));
    EXPECT_EQ(channel.changes().size(), 1U);
}

TEST(Frames, AllArriveAndLooksOnlyTheNewest) {
    LiveChannel channel([] {});
    CountingEngine engine(channel);
    EXPECT_TRUE(comes_true([&] { return engine.n_steps > 100; }));
    channel.pause();
    const int n = steps_at_rest(engine);
    EXPECT_EQ(static_cast<int>(channel.take_frames().size()), n / 10);
    EXPECT_TRUE(channel.take_frames().empty());
    EXPECT_NE(channel.wait_for_header(), nullptr);
}

TEST(WaitingForTheBegin, EndsWhenTheEngineBeginsOrEndsWithout) {
    LiveChannel channel([] {});
    std::thread engine([&] { channel.begin(two_cells()->header); });
    EXPECT_NE(channel.wait_for_header(), nullptr);
    engine.join();
    LiveChannel without([] {});
    std::thread failed([&] { without.end(); });
    EXPECT_EQ(without.wait_for_header(), nullptr);
    failed.join();
}

}  // namespace
}  // namespace spheroscope::viewer
