#include "sightline/targets/target_log.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <Eigen/LU>

#include "sightline/config/csv_table.h"
#include "sightline/config/error.h"
#include "sightline/geometry/statistics.h"
#include "sightline/logs/assignment.h"
#include "sightline/logs/fields.h"

namespace sightline::targets {

TargetLogWriter::TargetLogWriter(const std::string& path) : path_(path), file_(path) {
  if (!file_) throw config::Error(path, 0, "", "cannot be written");
  file_ << "stamp,label,x,y,cov_xx,cov_xy,cov_yy,probability,moving\n";
}

void TargetLogWriter::add(const TargetEstimate& estimate) {
  const std::string stamp = logs::formatStamp(estimate.stamp);
  fmt::print(file_, "{},0,{:.4f},{:.4f},0,0,0,0,0\n", stamp, estimate.expected_number,
             estimate.number_variance);
  for (const Target& target : estimate.targets) {
    const Eigen::Matrix2d& c = target.covariance;
    fmt::print(file_, "{},{},{:.4f},{:.4f},{:.8f},{:.8f},{:.8f},{:.4f},{:.4f}\n", stamp,
               target.label, target.mean.x(), target.mean.y(), c(0, 0), c(0, 1), c(1, 1),
               target.probability, target.moving);
  }
}

void TargetLogWriter::close() {
  file_.close();
  if (!file_) throw config::Error(path_, 0, "", "could not be written to its end");
}

namespace {

Target targetOf(const config::CsvTable::Row& row) {
  Target target;
  target.label = static_cast<std::uint32_t>(row.integer("label"));
  target.mean = {row.number("x"), row.number("y")};
  const double cross = row.number("cov_xy");
  target.covariance << row.number("cov_xx"), cross, cross, row.number("cov_yy");
  target.probability = row.number("probability", {0.0, 1.0});
  target.moving = row.number("moving", {0.0, 1.0});
  return target;
}

}  // namespace

std::vector<TargetEstimate> readTargetLog(const std::string& path) {
  const config::CsvTable table = config::CsvTable::readFile(path);
  std::vector<TargetEstimate> estimates;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    const auto stamp = logs::parseStamp(row.text("stamp"));
    if (!stamp) row.fail("stamp", "expected a time");
    if (row.integer("label") == 0) {
      TargetEstimate estimate;
      estimate.stamp = *stamp;
      estimate.expected_number = row.number("x");
      estimate.number_variance = row.number("y");
      estimates.push_back(estimate);
    } else if (estimates.empty() || estimates.back().stamp != *stamp) {
      row.fail("label", "a target before the row of label 0 of its stamp");
    } else {
      estimates.back().targets.push_back(targetOf(row));
    }
  }
  return estimates;
}

logs::Points readTargetTruth(const std::string& path) {
  const config::CsvTable table = config::CsvTable::readFile(path);
  logs::Points points;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    if (row.text("kind") == "target") points.emplace_back(row.number("x"), row.number("y"));
  }
  return points;
}

namespace {

std::vector<Target> standing(const TargetEstimate& estimate) {
  std::vector<Target> targets;
  for (const Target& target : estimate.targets) {
    if (target.moving < 0.5) targets.push_back(target);
  }
  return targets;
}

// Sums of NEES over the pairs of the best assignment that lie within the cut-off.
struct NeesSum {
  double sum = 0.0;
  double inside = 0.0;
  double count = 0.0;

  void add(const NeesSum& other) {
    sum += other.sum;
    inside += other.inside;
    count += other.count;
  }
};

NeesSum neesOf(const std::vector<Target>& targets, const logs::Points& truth, double cutoff) {
  Eigen::MatrixXd cost(targets.size(), truth.size());
  for (Eigen::Index i = 0; i < cost.rows(); ++i) {
    for (Eigen::Index j = 0; j < cost.cols(); ++j) {
      const Eigen::Vector2d error =
          targets[static_cast<std::size_t>(i)].mean - truth[static_cast<std::size_t>(j)];
      cost(i, j) = std::min(cutoff, error.norm());
    }
  }
  NeesSum result;
  const auto partners = logs::assign(cost);
  for (std::size_t i = 0; i < partners.size(); ++i) {
    if (!partners[i]) continue;
    const Eigen::Vector2d error = targets[i].mean - truth[*partners[i]];
    if (error.norm() >= cutoff || targets[i].covariance.determinant() <= 0.0) continue;
    const double square = error.dot(targets[i].covariance.inverse() * error);
    result.add({square, square <= geometry::kChiSquare95Of2 ? 1.0 : 0.0, 1.0});
  }
  return result;
}

// Sums over moments; divided by them in the end.
void addMoment(const TargetEstimate& estimate, const logs::Points& truth,
               const logs::SetMetric& metric, TargetScore& score, NeesSum& nees) {
  const std::vector<Target> targets = standing(estimate);
  logs::Points places;
  for (const Target& target : targets) places.push_back(target.mean);
  const logs::Gospa gospa = logs::gospa(truth, places, metric);
  const auto count = static_cast<double>(truth.size());
  ++score.moments;
  score.ospa += logs::ospa(truth, places, metric);
  score.gospa += gospa.value;
  score.number_error += std::abs(static_cast<double>(places.size()) - count);
  score.mass_error += std::abs(estimate.expected_number - count);
  score.missed += static_cast<double>(gospa.missed);
  score.spurious += static_cast<double>(gospa.spurious);
  nees.add(neesOf(targets, truth, metric.cutoff));
}

}  // namespace

TargetScore score(const std::vector<TargetEstimate>& estimates, const logs::Points& truth,
                  const logs::SetMetric& metric, const ScoreSpan& span, double step) {
  TargetScore result;
  NeesSum nees;
  double next = span.from;
  for (std::size_t i = 0; i < estimates.size() && next < span.to; ++i) {
    // The estimate stands until the next one.
    const bool is_last = i + 1 == estimates.size();
    const double until =
        1e-9 * static_cast<double>(estimates[is_last ? i : i + 1].stamp - estimates[0].stamp);
    for (; next < span.to && (next < until || (is_last && next <= until)); next += step) {
      addMoment(estimates[i], truth, metric, result, nees);
    }
  }
  const double moments = std::max<double>(1.0, static_cast<double>(result.moments));
  for (double* sum : {&result.ospa, &result.gospa, &result.number_error, &result.mass_error,
                      &result.missed, &result.spurious}) {
    *sum /= moments;
  }
  if (nees.count > 0.0) {
    result.nees = nees.sum / nees.count;
    result.inside = nees.inside / nees.count;
  }
  return result;
}

}  // namespace sightline::targets
