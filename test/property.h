#pragma once

#include <cstdlib>

#include <gtest/gtest.h>
// rapidcheck after gtest, which it extends.
#include <rapidcheck/gtest.h>

namespace sightline::test {

/// The same cases in every run, unless the environment asks for others.
inline const int kSeeded = setenv("RC_PARAMS", "seed=20261122", /*overwrite=*/0);

/// Numbers of [-bound, bound] to a millionth of it.
inline rc::Gen<double> within(double bound) {
  return rc::gen::map(rc::gen::inRange(-1000000, 1000001),
                      [bound](int i) { return bound * 1e-6 * i; });
}

}  // namespace sightline::test
