// One fraction for a whole run, which never stands still and never claims more than it knows.
#include "runs/report/run_progress.h"
#include "runs/report/percent.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

const std::vector<RunStage> stages{
    {"scene", 1.0}, {"form factors", 4.0}, {"interpolation", 3.0}, {"render", 2.0}};

TEST(RunProgress, CountsAllStages) {
  RunProgress progress;
  progress.begin(stages, 0.0);
  progress.report("form factors", 0.5, 3.0);
  const RunState state = progress.state(3.0);
  EXPECT_EQ(state.stage, "form factors");
  EXPECT_NEAR(state.done, 0.3, 1e-12);
  ASSERT_TRUE(state.seconds_left);
  EXPECT_NEAR(*state.seconds_left, 7.0, 1e-9) << "of the whole run";
}

TEST(RunProgress, GoesOnThroughAStageThatReportsNothing) {
  RunProgress progress;
  progress.begin(stages, 0.0);
  progress.report("form factors", 1.0, 5.0);
  EXPECT_EQ(progress.state(5.0).stage, "interpolation");
  double before = progress.state(5.0).done;
  EXPECT_NEAR(before, 0.5, 1e-12);
  for (const double now : {6.0, 8.0, 20.0}) {
    const RunState state = progress.state(now);
    EXPECT_GT(state.done, before);
    EXPECT_LT(state.done, 0.8) << "the stage is not complete before the next one says so";
    before = state.done;
  }
  progress.report("render", 0.5, 21.0);
  EXPECT_NEAR(progress.state(21.0).done, 0.9, 1e-12);
}

TEST(RunProgress, NeverGoesBack) {
  RunProgress progress;
  progress.begin(stages, 0.0);
  progress.report("form factors", 0.9, 5.0);
  progress.report("form factors", 0.8, 5.1);
  EXPECT_GE(progress.state(5.1).done, 0.46);
  progress.report("form factors", 1.0, 6.0);
  progress.report("form factors", 0.1, 7.0);
  EXPECT_GE(progress.state(7.0).done, 0.5) << "a round more of a stage that is over";
}

TEST(RunProgress, DoesNotFallBackWhereAStageSlowsDown) {
  RunProgress progress;
  progress.begin(stages, 0.0);
  progress.report("form factors", 0.5, 1.0);
  double shown = 0.0;
  for (int tick = 10; tick < 200; ++tick) { // a hundredth of the pace
    const double now = 0.1 * tick;
    if (tick % 20 == 0)
      progress.report("form factors", 0.5 + 0.0005 * tick, now);
    const double done = progress.state(now).done;
    EXPECT_GE(done, shown) << now;
    EXPECT_LE(done, 0.5) << "the stage is not over at " << now;
    shown = done;
  }
}

TEST(RunProgress, TellsStagesOfOneNameApart) {
  RunProgress progress;
  progress.begin({{"render", 1.0}, {"render", 1.0}}, 0.0);
  progress.report("render", 1.0, 1.0);
  progress.report("render", 0.9, 1.0);
  EXPECT_NEAR(progress.state(1.0).done, 0.5, 1e-12) << "a late report of the first";
  progress.report("render", 0.5, 1.5);
  EXPECT_NEAR(progress.state(1.5).done, 0.75, 1e-12);
}

TEST(RunProgress, TakesAStageNobodyNamedForARun) {
  RunProgress progress;
  progress.report("trade", 0.25, 10.0);
  progress.report("trade", 0.5, 20.0);
  EXPECT_NEAR(progress.state(20.0).done, 0.5, 1e-12);
}

TEST(Percent, IsReadable) {
  EXPECT_EQ(readable_percent(0.0), "0 %");
  EXPECT_EQ(readable_percent(1e-6), "under 0.01 %");
  EXPECT_EQ(readable_percent(0.0045), "0.45 %");
  EXPECT_EQ(readable_percent(0.0996), "10 %");
  EXPECT_EQ(readable_percent(0.35), "35 %");
  EXPECT_EQ(readable_percent(1.4), "over 100 %");
}

TEST(Percent, IsAboutANumberAlone) {
  EXPECT_EQ(about_percent(0.0045), "about 0.45 %");
  EXPECT_EQ(about_percent(1e-6), "under 0.01 %");
  EXPECT_EQ(about_percent(1.4), "over 100 %");
}

} // namespace
} // namespace meninas::test
