#pragma once

#include <string>
#include <vector>

namespace sightline::bridge {

/// Says in the log when an input does not come, or no more, and which topics have messages of its
/// type instead; again when that changes. Without a type it says nothing.
class MissingInput {
 public:
  MissingInput(std::string topic, std::string type)
      : topic_(std::move(topic)), type_(std::move(type)) {}

  /// Told now and then how it stands.
  enum class State { kComes, kNeverCame, kCeased };
  void update(State state);

 private:
  std::vector<std::string> others() const;

  std::string topic_;
  std::string type_;  // such as sensor_msgs/LaserScan
  State state_ = State::kComes;
  std::string said_;
};

/// Sentence on topics that have the messages which do not come on `topic`.
std::string adviceOn(const std::string& topic, const std::string& type,
                     const std::vector<std::string>& others);

}  // namespace sightline::bridge
