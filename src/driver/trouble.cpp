#include "sightline/driver/trouble.h"

#include <array>
#include <cstddef>

namespace sightline::driver {

const char* nameOf(Fault fault) {
  constexpr std::array<const char*, 14> kNames{"none",
                                               "no such port",
                                               "no permission",
                                               "port busy",
                                               "not a serial port",
                                               "port failed",
                                               "silent device",
                                               "garbage",
                                               "no scans",
                                               "scans refused",
                                               "wrong device",
                                               "wrong protocol version",
                                               "wrong serial number",
                                               "wrong number of samples"};
  return kNames[static_cast<std::size_t>(fault)];
}

Trouble trouble(Fault fault, const std::string& detail) {
  return {fault, std::string(nameOf(fault)) + ": " + detail};
}

}  // namespace sightline::driver
