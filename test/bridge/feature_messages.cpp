#include "sightline/bridge/feature_messages.h"

#include <limits>

#include <gtest/gtest.h>

#include "sightline/bridge/bad_message.h"

namespace sightline::bridge {
namespace {

geometry::Feature someFeature() {
  geometry::Feature feature;
  feature.id = 7;
  feature.kind = geometry::FeatureKind::kEdge;
  feature.position = {1.5, -0.5};
  feature.covariance << 4e-4, 1e-4, 1e-4, 9e-4;
  feature.velocity = {0.1, 0.2};
  feature.behaviour = geometry::FeatureBehaviour::kFixed;
  feature.fixed_probability = 0.97;
  feature.sliding_probability = 0.02;
  feature.moving_probability = 0.01;
  feature.age = 3.0;
  feature.unseen = 0.2;
  feature.sightings = 28;
  return feature;
}

TEST(FeatureMessages, ComeBackAsTheyWent) {
  const auto message = toMessage({someFeature()}, "odom", 5'000'000'001);
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.header.stamp.nsec, 1U);
  const auto features = fromMessage(message);
  ASSERT_EQ(features.size(), 1U);
  const geometry::Feature expected = someFeature();
  EXPECT_EQ(features[0].id, expected.id);
  EXPECT_EQ(features[0].kind, expected.kind);
  EXPECT_EQ(features[0].position, expected.position);
  EXPECT_EQ(features[0].covariance, expected.covariance);
  EXPECT_EQ(features[0].velocity, expected.velocity);
  EXPECT_EQ(features[0].behaviour, expected.behaviour);
  EXPECT_EQ(features[0].fixed_probability, expected.fixed_probability);
  EXPECT_EQ(features[0].unseen, expected.unseen);
  EXPECT_EQ(features[0].sightings, expected.sightings);
}

TEST(FeatureMessages, RefuseWhatIsNoFeature) {
  const auto refuse = [](void (*spoil)(Feature&)) {
    auto message = toMessage({someFeature()}, "odom", 1);
    spoil(message.features[0]);
    EXPECT_THROW(fromMessage(message), BadMessage);
  };
  refuse([](Feature& feature) { feature.kind = 0; });
  refuse([](Feature& feature) { feature.behaviour = 9; });
  refuse([](Feature& feature) { feature.position.x = std::numeric_limits<double>::quiet_NaN(); });
  refuse([](Feature& feature) { feature.covariance[0] = -1.0; });
  refuse([](Feature& feature) { feature.covariance = {1.0, 2.0, 2.0, 1.0}; });
}

TEST(FeatureMarkers, TakeAwayLabelsOfFeaturesThatAreGone) {
  FeatureMarkers markers;
  std_msgs::Header header;
  EXPECT_EQ(markers.draw({someFeature(), someFeature()}, header).markers.size(), 3U);
  const auto after = markers.draw({someFeature()}, header).markers;
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(after[1].text, "7");
  EXPECT_EQ(after[2].action, visualization_msgs::Marker::DELETE);
}

}  // namespace
}  // namespace sightline::bridge
