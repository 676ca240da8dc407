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
class Numbers : public config::FieldVisitor {
 public:
  struct Entry {
    std::string name;
    double value;
    config::Range range;
  };

  void number(const char* name, double& value, const config::Field& field) override {
    entries.push_back({prefix_ + name, value, field.range});
  }
  void integer(const char* name, int& value, const config::Field& field) override {
    entries.push_back({prefix_ + name, static_cast<double>(value), field.range});
  }
  void flag(const char*, bool&, const char*) override {}
  void text(const char*, std::string&, const char*) override {}
  void numbers(const char*, std::vector<double>&, const config::Field&) override {}
  void option(const char*, std::size_t&, const std::vector<const char*>&, const char*) override {}
  void enter(const char* group) override { prefix_ = std::string(group) + "_"; }
  void leave() override { prefix_.clear(); }

  const Entry* find(const std::string& name) const {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.name == name; });
    return found == entries.end() ? nullptr : &*found;
  }

  std::vector<Entry> entries;

 private:
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
  config.visit(fields);
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
