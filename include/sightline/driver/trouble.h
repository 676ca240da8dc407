#pragma once

#include <string>

namespace sightline::driver {

/// Reason for the absence of scans.
enum class Fault {
  kNone,
  kNoSuchPort,
  kNoPermission,
  kPortBusy,
  kNotASerialPort,
  kPortFailed,
  kSilentDevice,
  kGarbage,
  kNoScans,
  kRefusedScans,
  kWrongDevice,
  kWrongVersion,
  kWrongSerial,
  kWrongSamples,
};

struct Trouble {
  Fault fault = Fault::kNone;
  std::string text;  ///< the name of the fault and what is known of it; empty if there is none
};

/// The fault by its name alone, as the text begins.
const char* nameOf(Fault fault);
/// `NAME: detail`.
Trouble trouble(Fault fault, const std::string& detail);

}  // namespace sightline::driver
