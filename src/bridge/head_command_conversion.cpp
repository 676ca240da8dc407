#include "sightline/bridge/head_command_conversion.h"

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

motion::HeadCommand::Mode modeOf(const HeadCommand& message) {
  using Mode = motion::HeadCommand::Mode;
  switch (message.mode) {
    case HeadCommand::STOP:
      return Mode::kStop;
    case HeadCommand::POSITION:
      return Mode::kPosition;
    case HeadCommand::RATE:
      return Mode::kRate;
    default:
      throw InvalidHeadCommand(fmt::format("an unknown mode {}", message.mode));
  }
}

}  // namespace

motion::HeadCommand fromMessage(const HeadCommand& message, const std::string& joint,
                                const motion::HeadLimits& limits) {
  if (!message.joint.empty() && message.joint != joint) {
    throw InvalidHeadCommand(fmt::format("for the joint '{}', not '{}'", message.joint, joint));
  }
  const motion::HeadCommand command{modeOf(message), message.position, message.rate};
  const std::string fault = limits.fault(command);
  if (!fault.empty()) throw InvalidHeadCommand(fault);
  return command;
}

}  // namespace sightline::bridge
