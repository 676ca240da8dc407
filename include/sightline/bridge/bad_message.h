#pragma once

#include <stdexcept>

namespace sightline::bridge {

/// A message that cannot be used. what() names the reason.
class BadMessage : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace sightline::bridge
