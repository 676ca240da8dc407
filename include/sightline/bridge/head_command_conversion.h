#pragma once

#include <stdexcept>
#include <string>

#include <sightline/HeadCommand.h>
#include "sightline/motion/head_command.h"

namespace sightline::bridge {

/// A head command that is not obeyed. what() names the reason.
class InvalidHeadCommand : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws InvalidHeadCommand: for another joint than `joint`, of an unknown mode, not finite or
/// beyond the limits.
motion::HeadCommand fromMessage(const HeadCommand& message, const std::string& joint,
                                const motion::HeadLimits& limits);

}  // namespace sightline::bridge
