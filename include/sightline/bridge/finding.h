#pragma once

#include <string>
#include <vector>

namespace sightline::bridge {

/// Weight of something that was found in a recording.
enum class Severity {
  kNote,     ///< nothing is wrong
  kWarning,  ///< results may be worse than they could be
  kError,    ///< something will not run, or be wrong
};

struct Finding {
  Severity severity = Severity::kNote;
  std::string text;  ///< what there is, and what to do about it
};

using Findings = std::vector<Finding>;

}  // namespace sightline::bridge
