#pragma once

#include <string>
#include <vector>

#include "sightline/bridge/finding.h"
#include "sightline/plot/figure.h"

namespace sightline::bridge {

/// One part of a report.
struct Section {
  std::string title;
  std::vector<std::string> facts;
  Findings findings;
};

/// What there is in a recording and what is wrong with it.
struct RecordingReport {
  std::vector<Section> sections;
  std::vector<std::string> next;  ///< lines to type
  std::string settings;           ///< YAML for `offline` and `replay.launch`
  plot::Figure figure;            ///< without panels where there is nothing to draw

  std::size_t count(Severity severity) const;
  /// Status for a program to end with: 0 where all is well, 3 with errors, 4 with warnings alone.
  int exitStatus() const;
  /// One page of text; `warning` and `ERROR` begin the lines of findings.
  std::string text() const;
};

}  // namespace sightline::bridge
