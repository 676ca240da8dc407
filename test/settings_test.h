#pragma once

#include <cmath>

#include <gtest/gtest.h>

#include "round_trip.h"
#include "setting_limits.h"
#include "sightline/config/yaml_writer.h"

namespace sightline::test {

/// Tests that hold for every setting of a configuration struct, from its field list alone.
template <class Config>
class EverySetting : public testing::Test {};

TYPED_TEST_SUITE_P(EverySetting);

TYPED_TEST_P(EverySetting, IsWrittenAndReadBack) {
  const TypeParam written = changed(TypeParam());
  TypeParam read;
  config::read(config::Node::parse(config::toYaml(written), "settings.yaml"), read);
  const auto expected = settingsOf(written);
  const auto found = settingsOf(read);
  const auto defaults = settingsOf(TypeParam());
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [name, value] : expected) {
    EXPECT_EQ(found.at(name), value) << name;
    const auto before = defaults.find(name);
    EXPECT_TRUE(before == defaults.end() || value != before->second) << name;
  }
}

TYPED_TEST_P(EverySetting, HasAnEndOnBothSides) {
  config::validate(TypeParam());
  for (const auto& limit : atBothEnds(changed(TypeParam()))) {
    SCOPED_TRACE(limit.name);
    EXPECT_NO_THROW(config::validate(limit.config));
    EXPECT_EQ(limit.name.find("= inf"), std::string::npos);
    EXPECT_EQ(limit.name.find("= -inf"), std::string::npos);
    EXPECT_EQ(limit.name.find("e+30"), std::string::npos) << "no practical end";
    EXPECT_EQ(limit.name.find("e-30"), std::string::npos) << "no practical end";
  }
}

REGISTER_TYPED_TEST_SUITE_P(EverySetting, IsWrittenAndReadBack, HasAnEndOnBothSides);

}  // namespace sightline::test
