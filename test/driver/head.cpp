// The newest command on its way, and whether the head follows.
#include <gtest/gtest.h>

#include "sightline/driver/head_command_outbox.h"
#include "sightline/driver/head_watch.h"

namespace sightline::driver {
namespace {

using CommandMode = motion::HeadCommand::Mode;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr motion::HeadCommand kAhead{CommandMode::kPosition, 0.0, 0.0};
constexpr motion::HeadCommand kAside{CommandMode::kPosition, 0.5, 0.0};

// Times at which a command goes out in two seconds [ms].
std::vector<int> timesSent(HeadCommandOutbox& outbox) {
  std::vector<int> times;
  for (int ms = 1000; ms < 3000; ++ms) {
    if (outbox.due(ms * kMillisecond)) times.push_back(ms - 1000);
  }
  return times;
}

TEST(HeadCommandOutbox, RepeatsLessAndLess) {
  HeadCommandOutbox outbox;
  outbox.give(kAside, 1000 * kMillisecond);
  EXPECT_EQ(timesSent(outbox), (std::vector<int>{0, 100, 300, 700}));
  EXPECT_EQ(outbox.counts().lost, 1U);
}

TEST(HeadCommandOutbox, NewestWins) {
  HeadCommandOutbox outbox;
  int sent = 0;
  for (int ms = 1000; ms < 2000; ++ms) {
    outbox.give({CommandMode::kPosition, 1e-3 * ms, 0.0}, ms * kMillisecond);
    const auto target = outbox.due(ms * kMillisecond);
    if (!target) continue;
    ++sent;
    EXPECT_EQ(target->command.position, 1e-3 * ms);
  }
  EXPECT_EQ(sent, 50) << "of a thousand a second";
  EXPECT_EQ(outbox.counts().lost, 0U);
}

TEST(HeadCommandOutbox, AnswerEndsIt) {
  HeadCommandOutbox outbox;
  outbox.give(kAside, 1000 * kMillisecond);
  ASSERT_TRUE(outbox.due(1000 * kMillisecond));
  outbox.sent(7);
  outbox.take({FrameKind::kHeadTarget, CommandResult::kBeyondLimits, 6});
  EXPECT_EQ(outbox.counts().refused, 0U) << "an older one";
  outbox.take({FrameKind::kHeadTarget, CommandResult::kBeyondLimits, 7});
  EXPECT_EQ(outbox.counts().refused, 1U);
  EXPECT_TRUE(timesSent(outbox).empty());
}

TEST(HeadWatch, StuckHeadIsNamed) {
  HeadWatch watch;
  watch.command(kAside, 0);
  watch.observe({0.0, 0.001}, 900 * kMillisecond);
  EXPECT_EQ(watch.fault(), "");
  watch.observe({0.0, 0.001}, 1100 * kMillisecond);
  EXPECT_EQ(watch.fault(), "does not follow: at 0.00 rad, sent to 0.50 rad");
  watch.observe({0.0, 0.1}, 1200 * kMillisecond);
  EXPECT_EQ(watch.fault(), "");
}

TEST(HeadWatch, NewCommandsGiveAStuckHeadNoMoreTime) {
  HeadWatch watch;
  for (int ms = 0; ms < 1200; ms += 100) {
    watch.command({CommandMode::kPosition, 0.3 + 1e-4 * ms, 0.0}, ms * kMillisecond);
    watch.observe({0.0}, ms * kMillisecond);
  }
  EXPECT_NE(watch.fault(), "");
}

TEST(HeadWatch, HeadThatArrivedOrHaltedAtALimitIsWell) {
  HeadWatch watch;
  watch.command(kAhead, 0);
  watch.observe({0.01}, 5000 * kMillisecond);
  EXPECT_EQ(watch.fault(), "");
  watch.command({CommandMode::kRate, 0.0, -1.0}, 5000 * kMillisecond);
  watch.observe({motion::HeadLimits{}.lower}, 5100 * kMillisecond);
  watch.observe({motion::HeadLimits{}.lower}, 9000 * kMillisecond);
  EXPECT_EQ(watch.fault(), "");
  watch.command({CommandMode::kRate, 0.0, 1.0}, 9000 * kMillisecond);
  watch.observe({motion::HeadLimits{}.lower}, 10500 * kMillisecond);
  EXPECT_EQ(watch.fault(), "does not follow: at -1.57 rad, told to turn at 1.00 rad/s");
  watch.command({}, 10500 * kMillisecond);
  watch.observe({motion::HeadLimits{}.lower}, 20000 * kMillisecond);
  EXPECT_EQ(watch.fault(), "") << "it was told to stop";
}

}  // namespace
}  // namespace sightline::driver
