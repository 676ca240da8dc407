#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "sightline/logs/ospa.h"
#include "sightline/targets/target_filter.h"

namespace sightline::targets {

/// Writes estimates as text: `stamp,label,x,y,cov_xx,cov_xy,cov_yy,probability,moving` a target,
/// and a row of label 0 first, with the expected number as its x and its variance as its y, so that
/// an estimate without targets is there, too.
class TargetLogWriter {
 public:
  /// Throws config::Error if the file cannot be written.
  explicit TargetLogWriter(const std::string& path);
  void add(const TargetEstimate& estimate);
  /// Ends the file. Throws config::Error if not all could be written.
  void close();

 private:
  std::string path_;
  std::ofstream file_;
};

/// Throws config::Error with file and line.
std::vector<TargetEstimate> readTargetLog(const std::string& path);
/// Places of the rows of kind `target` of a table `kind,id,x,y` [m]. Throws config::Error.
logs::Points readTargetTruth(const std::string& path);

/// Span of the time since the first estimate [s].
struct ScoreSpan {
  double from = 0.0;
  double to = 1e12;
};

/// Errors of estimates, as they stand every so often.
struct TargetScore {
  std::size_t moments = 0;
  double ospa = 0.0;          ///< mean [m]
  double gospa = 0.0;         ///< mean [m]
  double number_error = 0.0;  ///< mean of |reported − true|
  double mass_error = 0.0;    ///< mean of |expected − true|
  double missed = 0.0;        ///< mean, by GOSPA
  double spurious = 0.0;
  double nees = 0.0;    ///< mean over pairs within the cut-off, ideal 2
  double inside = 0.0;  ///< share of these within their ellipses of 95 %
};

/// Scores the targets that stand still every `step` [s] of a span of time.
TargetScore score(const std::vector<TargetEstimate>& estimates, const logs::Points& truth,
                  const logs::SetMetric& metric, const ScoreSpan& span, double step);

}  // namespace sightline::targets
