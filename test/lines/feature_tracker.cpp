// Features over scans of a scanner that is carried past walls, boxes and moving things.
#include "sightline/lines/feature_tracker.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lines/room_scan.h"
#include "sightline/lines/line_extractor.h"

namespace sightline::lines {
namespace {

using geometry::Feature;
using geometry::FeatureBehaviour;
using geometry::FeatureKind;
using geometry::Pose2;

// Carries a scanner through a scene, ten scans a second, with odometry that is exact.
class Carried {
 public:
  explicit Carried(const FeatureTrackerConfig& config = {}) : tracker_(config) {
    scene_.walls = test::rectangle(-1.0, -2.5, 5.0, 2.0);
  }

  void moveTo(const Pose2& pose) {
    const Pose2 step = geometry::between(scene_.pose, pose);
    scene_.pose = pose;
    stamp_ += 100'000'000;
    scan_ = scene_.take(gauss_);
    scan_.stamp = stamp_;
    segments_ = extractor_.extract(scan_);
    arcs_ = extractor_.arcs();
    tracker_.update({scan_, segments_, arcs_,
                     CarrierStep::byWheels(tracker_.config().odometry, step), Pose2()});
  }
  // On at half a metre a second.
  void go(int scans, const Eigen::Vector2d& direction = {1.0, 0.0}) {
    for (int i = 0; i < scans; ++i) {
      moveTo(Pose2(scene_.pose.translation() + 0.05 * direction, scene_.pose.theta()));
    }
  }
  std::vector<Feature> features() const { return tracker_.features(scene_.pose); }
  const Feature* at(const Eigen::Vector2d& place, double radius = 0.1) {
    found_ = features();
    for (const Feature& feature : found_) {
      if ((feature.position - place).norm() < radius) return &feature;
    }
    return nullptr;
  }
  void setClock(std::int64_t stamp) { stamp_ = stamp; }

  test::ScanOf scene_;
  FeatureTracker tracker_;
  std::vector<geometry::LineSegment> segments_;
  std::vector<geometry::Arc> arcs_;

 private:
  LineExtractor extractor_;
  test::Gauss gauss_{7};
  scan::Scan scan_;
  std::int64_t stamp_ = 1'000'000'000;
  std::vector<Feature> found_;
};

TEST(FeatureTracker, KnowsACornerAgainAndTellsThatItIsFixed) {
  Carried carried;
  carried.go(3);
  const Feature* corner = carried.at({5.0, 2.0});
  ASSERT_TRUE(corner);
  const std::uint32_t id = corner->id;
  carried.go(30);
  corner = carried.at({5.0, 2.0});
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->id, id);
  EXPECT_EQ(corner->kind, FeatureKind::kCorner);
  EXPECT_EQ(corner->behaviour, FeatureBehaviour::kFixed);
  EXPECT_GT(corner->sightings, 28U);
  EXPECT_NEAR(corner->age, 3.2, 0.11);
}

TEST(FeatureTracker, GivesEachWallAnIdThatLasts) {
  Carried carried;
  carried.go(1);
  const auto before = carried.segments_;
  ASSERT_GE(before.size(), 4U);
  carried.go(20, {0.2, 0.1});
  ASSERT_EQ(carried.segments_.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NE(before[i].id, 0U);
    EXPECT_EQ(carried.segments_[i].id, before[i].id);
  }
}

TEST(FeatureTracker, TellsTheBorderOfAViewFromACorner) {
  Carried carried;
  // A screen, past which the far wall is seen: where the view of that wall begins slides along it.
  carried.scene_.walls.push_back({{2.5, -0.8}, {2.5, 0.3}});
  carried.scene_.pose = Pose2(0.0, -1.2, 0.0);
  carried.go(30, {0.0, 1.0});
  const Feature* screen = carried.at({2.5, 0.3});
  ASSERT_TRUE(screen);
  EXPECT_EQ(screen->behaviour, FeatureBehaviour::kFixed);
  int sliding = 0;
  for (const Feature& feature : carried.features()) {
    const bool on_far_wall = std::abs(feature.position.x() - 5.0) < 0.1;
    if (!on_far_wall || feature.kind != FeatureKind::kLineEnd) continue;
    EXPECT_NE(feature.behaviour, FeatureBehaviour::kFixed);
    sliding += feature.behaviour == FeatureBehaviour::kSliding ? 1 : 0;
  }
  EXPECT_GE(sliding, 1);
}

TEST(FeatureTracker, TellsAThingThatMoves) {
  Carried carried;
  carried.scene_.posts = {{{3.0, -1.5}, 0.2}};
  for (int i = 0; i < 20; ++i) {
    carried.scene_.posts[0].centre.y() += 0.08;  // 0.8 m/s
    carried.go(1);
  }
  const Feature* post = carried.at(carried.scene_.posts[0].centre);
  ASSERT_TRUE(post);
  EXPECT_EQ(post->kind, FeatureKind::kArc);
  EXPECT_EQ(post->behaviour, FeatureBehaviour::kMoving);
  EXPECT_NEAR(post->velocity.y(), 0.8, 0.2);
  ASSERT_EQ(carried.arcs_.size(), 1U);
  EXPECT_EQ(carried.arcs_[0].id, post->id);
}

TEST(FeatureTracker, KeepsTheIdOfAHiddenFeature) {
  Carried carried;
  carried.go(10);
  const Feature* corner = carried.at({5.0, 2.0});
  ASSERT_TRUE(corner);
  const std::uint32_t id = corner->id;
  carried.scene_.walls.push_back({{2.0, 0.2}, {2.0, 1.5}});
  carried.go(20, {0.0, 0.0});
  corner = carried.at({5.0, 2.0});
  ASSERT_TRUE(corner);
  EXPECT_GT(corner->unseen, 1.5);
  carried.scene_.walls.pop_back();
  carried.go(1, {0.0, 0.0});
  corner = carried.at({5.0, 2.0});
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->id, id);
  EXPECT_EQ(corner->unseen, 0.0);
}

TEST(FeatureTracker, DropsWhatIsNotThereAnyMore) {
  Carried carried;
  carried.scene_.posts = {{{2.0, 0.5}, 0.2}};
  carried.go(10);
  ASSERT_TRUE(carried.at({2.0, 0.5}));
  carried.scene_.posts.clear();
  carried.go(25, {0.0, 0.0});
  EXPECT_FALSE(carried.at({2.0, 0.5}));
}

TEST(FeatureTracker, NeverGivesAnIdTwice) {
  Carried carried;
  carried.go(5);
  std::uint32_t last = 0;
  for (const Feature& feature : carried.features()) last = std::max(last, feature.id);
  carried.tracker_.restart();
  EXPECT_EQ(carried.tracker_.size(), 0U);
  carried.setClock(1'000'000'000);
  carried.go(5);
  ASSERT_FALSE(carried.features().empty());
  for (const Feature& feature : carried.features()) EXPECT_GT(feature.id, last);
}

TEST(FeatureTracker, TakesAStampThatGoesBackForTheSameTime) {
  Carried carried;
  carried.go(10);
  carried.setClock(0);
  carried.go(1);
  for (const Feature& feature : carried.features()) {
    EXPECT_TRUE(std::isfinite(feature.age));
    EXPECT_GE(feature.age, 0.0);
  }
  EXPECT_TRUE(carried.at({5.0, 2.0}));
}

TEST(FeatureTracker, KeepsNoMoreFeaturesThanItIsTold) {
  FeatureTrackerConfig config;
  config.max_features = 3;
  config.max_walls = 2;
  Carried carried(config);
  carried.scene_.posts = {{{2.0, 0.5}, 0.2}, {{2.0, -1.0}, 0.2}};
  carried.go(20);
  EXPECT_EQ(carried.tracker_.size(), 3U);
  // The most certain of those in view stay.
  for (const Feature& feature : carried.features()) EXPECT_EQ(feature.unseen, 0.0);
}

TEST(FeatureTracker, StaysFiniteWithoutBeams) {
  Carried carried;
  carried.go(5);
  carried.scene_.walls.clear();
  carried.go(10);
  for (const Feature& feature : carried.features()) {
    EXPECT_TRUE(feature.position.allFinite());
    EXPECT_TRUE(feature.covariance.allFinite());
  }
}

TEST(FeatureTracker, RefusesSettingsOutOfRange) {
  FeatureTrackerConfig config;
  config.decided = 0.3;
  EXPECT_THROW(FeatureTracker{config}, config::Error);
}

}  // namespace
}  // namespace sightline::lines
