#pragma once

#include <string>

namespace sightline::driver {

/// Link in `folder` that leads to the same port: the name by which udev knows the adapter, whatever
/// port it gets next. Empty where there is none.
std::string lastingName(const std::string& port, const std::string& folder = "/dev/serial/by-id");

/// Program that has a port open, as `NAME, process N`; empty where none is found. Those of other
/// users are seen by root alone.
std::string holderOf(const std::string& port);

}  // namespace sightline::driver
