#pragma once

#include <string>
#include <vector>

#include <dynamic_reconfigure/Config.h>

#include "sightline/config/fields.h"

/// Settings that dynamic_reconfigure changes while a node runs, by the field list of their struct:
/// the setting `gate_sigmas` of a .cfg file is the field `gate.sigmas`. A new setting costs a line
/// of its .cfg file and none here.
namespace sightline::bridge {

/// Puts the values of a struct into the settings of a message that have its fields' names.
class ReconfigureWriter : public config::FieldObserver {
 public:
  explicit ReconfigureWriter(dynamic_reconfigure::Config& message) : message_(message) {}

 private:
  void value(const char* name, const config::Value& value, const config::Field& field) override;
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }

  dynamic_reconfigure::Config& message_;
  std::vector<std::string> path_;
};

/// The settings of a message put into the fields that have their names; other fields stay.
class ReconfigureReader : public config::FieldVisitor {
 public:
  explicit ReconfigureReader(const dynamic_reconfigure::Config& message) : message_(message) {}
  void member(const char* name, const config::Member& member, const config::Field& field) override;
  void enter(const char* group) override { path_.emplace_back(group); }
  void leave() override { path_.pop_back(); }
  bool wants(const char*, bool present) override { return present; }
  std::vector<std::string> names(const std::vector<std::string>& present, const char*) override {
    return present;
  }

 private:
  const dynamic_reconfigure::Config& message_;
  std::vector<std::string> path_;
};

template <class Settings, class Config>
Settings settingsOf(const Config& config) {
  auto settings = Settings::__getDefault__();
  dynamic_reconfigure::Config message;
  settings.__toMessage__(message);
  ReconfigureWriter(message).observe(config);
  settings.__fromMessage__(message);
  return settings;
}

template <class Settings, class Config>
void applySettings(const Settings& settings, Config& config) {
  dynamic_reconfigure::Config message;
  settings.__toMessage__(message);
  ReconfigureReader reader(message);
  config.visit(reader);
}

}  // namespace sightline::bridge
