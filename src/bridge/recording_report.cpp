#include "sightline/bridge/recording_report.h"

#include <algorithm>

#include <fmt/format.h>

namespace sightline::bridge {

namespace {

const char* labelOf(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "  ERROR    ";
    case Severity::kWarning:
      return "  warning  ";
    case Severity::kNote:
      break;
  }
  return "  ";
}

std::string textOf(const Section& section) {
  std::string text = section.title + "\n";
  for (const std::string& fact : section.facts) text += "  " + fact + "\n";
  for (const Finding& finding : section.findings) {
    text += labelOf(finding.severity) + finding.text + "\n";
  }
  return text + "\n";
}

}  // namespace

std::size_t RecordingReport::count(Severity severity) const {
  std::size_t count = 0;
  for (const Section& section : sections) {
    for (const Finding& finding : section.findings) count += finding.severity == severity;
  }
  return count;
}

int RecordingReport::exitStatus() const {
  if (count(Severity::kError) > 0) return 3;
  return count(Severity::kWarning) > 0 ? 4 : 0;
}

std::string RecordingReport::text() const {
  std::string text;
  for (const Section& section : sections) text += textOf(section);
  text += "What can run\n";
  for (const std::string& line : next) text += "  " + line + "\n";
  return text + fmt::format("\n{} errors, {} warnings\n", count(Severity::kError),
                            count(Severity::kWarning));
}

}  // namespace sightline::bridge
