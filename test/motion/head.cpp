#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/motion/head_command.h"
#include "sightline/motion/range_scan.h"

namespace sightline::motion {
namespace {

// Against transforms taken one after the other.
TEST(HeadMotion, IsTheRigidMotionOfTheProjectionFrame) {
  const Eigen::Vector2d origin(0.05, -0.03);
  const std::vector<double> angles{0.3, 0.35, 0.5};
  const HeadSweep head{angles, "mount", origin};
  const std::vector<geometry::Pose2> mount{{}, {0.1, 0.0, 0.02}, {0.2, 0.01, 0.05}};
  const auto motion = headMotion(head, mount);
  const Eigen::Vector2d fixed(1.7, 0.4);  // in the mount's frame at the first beam
  const auto seenAt = [&](std::size_t beam) -> Eigen::Vector2d {
    const Eigen::Vector2d p_mount = mount[beam].inverse() * fixed;
    const Eigen::Vector2d p_head = geometry::Pose2(0.0, 0.0, angles[beam]).inverse() * p_mount;
    return p_head - origin;
  };
  for (const std::size_t beam : {0, 1, 2}) {
    EXPECT_TRUE((motion[beam] * seenAt(beam)).isApprox(seenAt(0), 1e-12)) << beam;
  }
  EXPECT_TRUE(headMotion({{0.3, 0.3}, "mount", origin}).empty());
  EXPECT_FALSE(headMotion({{0.3, 0.3}, "mount", origin}, {{}, {}}).empty());
}

TEST(HeadLimits, NameWhatIsWrongWithACommand) {
  using Mode = HeadCommand::Mode;
  const HeadLimits limits;
  const double nan = std::nan("");
  EXPECT_EQ(limits.fault({Mode::kPosition, 1.5, 0.0}), "");
  EXPECT_EQ(limits.fault({Mode::kRate, nan, -4.0}), "");
  EXPECT_EQ(limits.fault({Mode::kStop, nan, nan}), "");
  EXPECT_EQ(limits.fault({Mode::kPosition, nan, 0.0}), "a position that is not finite");
  EXPECT_EQ(limits.fault({Mode::kPosition, -1.6, 0.0}),
            "a position of -1.6000 rad, beyond the limits [-1.5708, 1.5708]");
  EXPECT_EQ(limits.fault({Mode::kRate, 0.0, nan}), "a rate that is not finite");
  EXPECT_EQ(limits.fault({Mode::kRate, 0.0, 5.0}),
            "a rate of 5.0000 rad/s, beyond the limit 4.5000");
}

}  // namespace
}  // namespace sightline::motion
