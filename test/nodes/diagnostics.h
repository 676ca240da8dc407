#pragma once

#include <optional>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>

#include "nodes/comes_true.h"
#include "nodes/recorder.h"

namespace sightline::test {

/// The latest status of every part of every node.
class Diagnostics {
 public:
  std::string text(const std::string& name) const {
    const auto status = find(name);
    return status ? status->message : "";
  }
  std::string value(const std::string& name, const std::string& key) const {
    const auto status = find(name);
    if (!status) return "";
    for (const auto& pair : status->values) {
      if (pair.key == key) return pair.value;
    }
    return "";
  }
  std::string hardware(const std::string& name) const {
    const auto status = find(name);
    return status ? status->hardware_id : "";
  }

  /// Waits until a value is there and holds the text.
  void expectValue(const std::string& name, const std::string& key, const std::string& text) const {
    EXPECT_TRUE(comesTrue([&] { return value(name, key).find(text) != std::string::npos; }))
        << name << ": " << key << " '" << value(name, key) << "'";
  }

 private:
  std::optional<diagnostic_msgs::DiagnosticStatus> find(const std::string& name) const {
    std::optional<diagnostic_msgs::DiagnosticStatus> latest;
    for (const auto& array : recorder_.all()) {
      for (const auto& status : array.status) {
        if (status.name == name) latest = status;
      }
    }
    return latest;
  }
  Recorder<diagnostic_msgs::DiagnosticArray> recorder_{"/diagnostics"};
};

}  // namespace sightline::test
