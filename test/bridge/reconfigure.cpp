#include <algorithm>
#include <set>
#include <string>

#include <dynamic_reconfigure/ConfigDescription.h>
#include <gmock/gmock.h>

#include "round_trip.h"
#include "sightline/bridge/line_settings.h"
#include "sightline/bridge/tracker_settings.h"
#include "sightline/config/fields.h"

namespace sightline::bridge {
namespace {

// Numbers of a field list under the names of dynamic_reconfigure: a dot becomes an underscore.
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

// Every setting there and back: those of cfg/ arrive, each in its own place, and the others stay.
template <class Settings, class Config>
void expectRoundTrip() {
  const auto sent = test::settingsOf(test::changed(Config()));
  const auto settings = toReconfigure(test::changed(Config()));
  Config config;
  applyReconfigure(settings, config);
  std::set<std::string> held;
  for (const auto& description : Settings::__getParamDescriptions__()) {
    held.insert(description->name);
  }
  auto kept = test::settingsOf(Config());
  for (const auto& [name, value] : test::settingsOf(config)) {
    std::string setting = name;
    std::replace(setting.begin(), setting.end(), '.', '_');
    const bool is_held = held.erase(setting) > 0;
    EXPECT_EQ(value, is_held ? sent.at(name) : kept.at(name)) << name;
    EXPECT_NE(sent.at(name), kept.at(name)) << name;
  }
  EXPECT_TRUE(held.empty()) << *held.begin() << " is no field";
}

TEST(Reconfigure, LineSettingsGoThereAndBack) {
  expectRoundTrip<LineExtractorConfig, lines::LineExtractorConfig>();
}

TEST(Reconfigure, TrackerSettingsGoThereAndBack) {
  expectRoundTrip<RoomTrackerConfig, tracking::TrackerConfig>();
}

}  // namespace
}  // namespace sightline::bridge
