#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_error.h"
#include "sightline/driver/head_joint.h"
#include "sightline/triangulation/calibration.h"

namespace sightline::driver {
namespace {

using testing::HasSubstr;

std::string shippedUrdf() {
  std::ifstream file(SIGHTLINE_SOURCE_DIR "/urdf/active_sensor.urdf");
  return {std::istreambuf_iterator<char>(file), {}};
}

// The description with one text in the place of another.
std::string changed(const std::string& from, const std::string& to) {
  std::string xml = shippedUrdf();
  const std::size_t at = xml.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return xml.replace(at, from.size(), to);
}

const HeadFrames kFrames{"head_joint", "active_sensor", "head", "projection"};

std::string faultOf(const std::string& xml, const HeadFrames& frames = kFrames) {
  const auto error = test::errorOf([&] { HeadJoint::fromUrdf(xml, frames, "robot"); });
  return error.what();
}

TEST(HeadJoint, ShippedDescriptionIsThatOfTheSensor) {
  const HeadJoint joint = HeadJoint::fromUrdf(shippedUrdf(), kFrames, "robot");
  const motion::HeadLimits limits;
  const triangulation::ScanOrigin origin;
  EXPECT_NEAR(joint.limits.lower, limits.lower, 1e-12);
  EXPECT_NEAR(joint.limits.upper, limits.upper, 1e-12);
  EXPECT_NEAR(joint.limits.max_rate, limits.max_rate, 1e-12);
  EXPECT_NEAR((joint.scan_origin - origin.position()).norm(), 0.0, 1e-12);
}

TEST(HeadJoint, WhatDoesNotFitIsNamed) {
  EXPECT_EQ(faultOf(shippedUrdf(), {"neck", "active_sensor", "head", "projection"}),
            "robot: neck: no such joint");
  EXPECT_EQ(faultOf(shippedUrdf(), {"head_joint", "base_link", "head", "projection"}),
            "robot: head_joint: its parent is 'active_sensor', not 'base_link'");
  EXPECT_EQ(faultOf(shippedUrdf(), {"head_joint", "active_sensor", "head", "lens"}),
            "robot: lens: no such link");
  EXPECT_EQ(faultOf(changed("<axis xyz=", "<origin xyz=\"0 0 1\"/><axis xyz=")),
            "robot: head_joint: does not sit in the origin of 'active_sensor'");
  EXPECT_THAT(faultOf("<robot"), HasSubstr("robot: not a robot description: Failed to read"));
  EXPECT_THAT(faultOf(""), HasSubstr("robot: not a robot description: "));
  EXPECT_EQ(faultOf(changed("<joint name=\"head_joint\" type=\"revolute\">",
                            "<joint name=\"head_joint\" type=\"prismatic\">")),
            "robot: head_joint: is not revolute");
  EXPECT_EQ(faultOf(changed("<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 1 0\"/>")),
            "robot: head_joint: does not turn about z");
  EXPECT_THAT(faultOf(changed("lower=\"-1.5707963267948966\"", "lower=\"2\"")),
              HasSubstr("head_joint"));
  EXPECT_THAT(faultOf(changed("<link name=\"projection\"/>", "")),
              HasSubstr("child link [projection] of joint [projection_joint] not found"));
  EXPECT_EQ(faultOf(changed("<parent link=\"head\"/>", "<parent link=\"base_link\"/>")),
            "robot: projection: does not hang on 'head'");
  EXPECT_EQ(faultOf(changed("<joint name=\"projection_joint\" type=\"fixed\">",
                            "<joint name=\"projection_joint\" type=\"floating\">")),
            "robot: projection_joint: is not fixed");
  EXPECT_EQ(faultOf(changed("xyz=\"0.050 -0.030 0\"", "xyz=\"0.05 -0.03 0\" rpy=\"0 0 0.1\"")),
            "robot: projection_joint: is turned against the head");
}

}  // namespace
}  // namespace sightline::driver
