#include "sightline/simulation/device_faults.h"

#include <functional>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "sightline/config/node.h"

namespace sightline::simulation {

namespace {

constexpr config::Range kShare{0.0, 1.0};
constexpr config::Range kSeconds{0.0, 3600.0};
constexpr config::Range kPpm{-1e4, 1e4};

struct Word {
  config::Range range;
  std::function<void(EmulatedDevice&, CableFaults&, double)> apply;
};

Word ofCable(config::Range range, double CableFaults::*fault) {
  return {range, [fault](EmulatedDevice& device, CableFaults& cable, double value) {
            cable.*fault = value;
            device.setCable(cable);
          }};
}

Word ofDevice(config::Range range, void (EmulatedDevice::*call)(double)) {
  return {range,
          [call](EmulatedDevice& device, CableFaults&, double value) { (device.*call)(value); }};
}

const std::map<std::string, Word>& words() {
  static const std::map<std::string, Word> kWords{
      {"corrupted", ofCable(kShare, &CableFaults::corrupted)},
      {"dropped", ofCable(kShare, &CableFaults::dropped)},
      {"bursts", ofCable(kShare, &CableFaults::bursts)},
      {"delay", ofCable(kSeconds, &CableFaults::delay)},
      {"jitter", ofCable(kSeconds, &CableFaults::jitter)},
      {"drift", ofDevice(kPpm, &EmulatedDevice::setDrift)},
      {"stall", ofDevice(kSeconds, &EmulatedDevice::stall)},
      {"reboot", ofDevice(kSeconds, &EmulatedDevice::reboot)},
      {"disconnect", ofDevice(kSeconds, &EmulatedDevice::disconnect)},
  };
  return kWords;
}

}  // namespace

void DeviceFaults::apply(const std::string& text, const std::string& source) {
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) {
    if (part.find_first_not_of(" \t\r") != std::string::npos) applyOne(part, source);
  }
}

void DeviceFaults::applyOne(const std::string& text, const std::string& source) {
  std::istringstream stream(text);
  std::string name;
  std::string rest;
  double value = 0.0;
  stream >> name;
  const auto found = words().find(name);
  if (found == words().end()) throw config::Error(source, 0, name, "no such fault");
  if (!(stream >> value) || stream >> rest) {
    throw config::Error(source, 0, name, "needs one number");
  }
  const Word& word = found->second;
  if (!word.range.contains(value)) {
    throw config::Error(source, 0, name, fmt::format("{} is outside {}", value, word.range.text()));
  }
  word.apply(device_, cable_, value);
}

}  // namespace sightline::simulation
