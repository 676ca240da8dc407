#pragma once

#include <string>

#include <gtest/gtest.h>

#include "tools/program.h"

namespace sightline::test {

/// What a node says that ends at once, and with 1, because of its parameters. Each is in a
/// namespace of its own, as parameters stay with the master.
inline std::string refusalOf(const std::string& node, const std::string& parameters) {
  static int number = 0;
  const auto result = runCommand("timeout 60 " SIGHTLINE_PROGRAMS "/" + node + " __ns:=refused" +
                                 std::to_string(++number) + " " + parameters);
  EXPECT_EQ(result.status, 1) << result.output;
  return result.output;
}

}  // namespace sightline::test
