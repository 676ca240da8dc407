#pragma once

#include <gtest/gtest.h>

#include "sightline/config/error.h"

namespace sightline::test {

/// The configuration error that a call ends with; fails the test where there is none.
template <class Call>
config::Error errorOf(const Call& call) {
  try {
    call();
  } catch (const config::Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error";
  return {"", 0, "", ""};
}

}  // namespace sightline::test
