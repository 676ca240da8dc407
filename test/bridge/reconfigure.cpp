#include <algorithm>
#include <string>

#include <dynamic_reconfigure/ConfigDescription.h>
#include <gtest/gtest.h>

#include "sightline/bridge/line_settings.h"
#include "sightline/bridge/tracker_settings.h"
#include "sightline/config/fields.h"

namespace sightline::bridge {
namespace {

// What a field list says of its numbers, under the names of dynamic_reconfigure: a dot becomes an
// underscore.
class Numbers : public config::FieldObserver {
 public:
  struct Entry {
    std::string name;
    double value;
    config::Range range;
  };

  const Entry* find(const std::string& name) const {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries.end() ? nullptr : &*found;
  }

  std::vector<Entry> entries;

 private:
  void value(const char* name, const config::Value& value, const config::Field& field) override {
    if (const auto* number = std::get_if<double>(&value)) add(name, *number, field);
    if (const auto* number = std::get_if<int>(&value)) add(name, *number, field);
  }
  void add(const char* name, double number, const config::Field& field) {
    entries.push_back({prefix_ + name, number, field.range});
  }
  void enter(const char* group) override { prefix_ = std::string(group) + "_"; }
  void leave() override { prefix_.clear(); }

  std::string prefix_;
};

double valueOf(const dynamic_reconfigure::Config& config, const std::string& name) {
  for (const auto& parameter : config.doubles) {
    if (parameter.name == name) return parameter.value;
  }
  for (const auto& parameter : config.ints) {
    if (parameter.name == name) return parameter.value;
  }
  ADD_FAILURE() << "no parameter " << name;
  return 0.0;
}

template <class Settings>
dynamic_reconfigure::Config messageOf(const Settings& settings) {
  dynamic_reconfigure::Config message;
  settings.__toMessage__(message);
  return message;
}

template <class Settings, class Config>
void expectCfgToFollow(Config config) {
  Numbers fields;
  fields.observe(config);
  const auto defaults = messageOf(Settings::__getDefault__());
  const auto least = messageOf(Settings::__getMin__());
  const auto most = messageOf(Settings::__getMax__());
  for (const auto& description : Settings::__getParamDescriptions__()) {
    SCOPED_TRACE(description->name);
    const auto* field = fields.find(description->name);
    ASSERT_TRUE(field) << "no such field";
    EXPECT_EQ(valueOf(defaults, description->name), field->value);
    EXPECT_EQ(valueOf(least, description->name), field->range.min);
    EXPECT_EQ(valueOf(most, description->name), field->range.max);
  }
}

TEST(Reconfigure, CfgOfTheLineExtractorFollowsItsFieldList) {
  expectCfgToFollow<LineExtractorConfig>(lines::LineExtractorConfig());
}

TEST(Reconfigure, CfgOfTheRoomTrackerFollowsItsFieldList) {
  expectCfgToFollow<RoomTrackerConfig>(tracking::TrackerConfig());
}

TEST(Reconfigure, TrackerSettingsGoThereAndBack) {
  tracking::TrackerConfig config;
  config.gate.sigmas = 4.0;
  config.wall.min_beams = 17;
  config.slip.min_quality = 0.25;
  config.odometry.scale_mean = 1.3;
  const auto settings = toReconfigure(config);
  tracking::TrackerConfig other;
  applyReconfigure(settings, other);
  EXPECT_EQ(other.gate.sigmas, 4.0);
  EXPECT_EQ(other.wall.min_beams, 17);
  EXPECT_EQ(other.slip.min_quality, 0.25);
  EXPECT_EQ(other.odometry.scale_mean, 1.0) << "what cfg/ does not hold stays";
}

}  // namespace
}  // namespace sightline::bridge
