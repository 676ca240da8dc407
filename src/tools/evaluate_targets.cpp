// Scores tracked targets against where they are.
#include <array>
#include <cstdio>

#include "program/program.h"
#include "sightline/config/error.h"
#include "sightline/targets/target_log.h"

namespace {

using namespace sightline;

struct TargetComparison {
  std::string log;
  std::string truth;
  double order = 1.0;
  double cutoff = 5.0;
  double from = 0.0;
  double to = 1e9;
  double step = 10.0;
};

int evaluate(const TargetComparison& comparison) {
  const bool is_metric = comparison.order >= 1.0 && comparison.cutoff > 0.0;
  if (!is_metric || !(comparison.step > 0.0)) {
    throw tools::UsageError("--order is at least 1, --cutoff and --step are above 0");
  }
  const auto estimates = targets::readTargetLog(comparison.log);
  const auto truth = targets::readTargetTruth(comparison.truth);
  if (truth.empty()) throw config::Error(comparison.truth, 0, "kind", "no row is a target");
  const auto score = targets::score(estimates, truth, {comparison.order, comparison.cutoff},
                                    {comparison.from, comparison.to}, comparison.step);
  if (score.moments == 0) {
    std::fputs("no estimate is from that time\n", stderr);
    return 1;
  }
  std::printf("moments %zu\nospa_mean %.4f m\ngospa_mean %.4f m\nnumber_error %.4f targets\n",
              score.moments, score.ospa, score.gospa, score.number_error);
  std::printf("mass_error %.4f targets\nmissed %.4f targets\nspurious %.4f targets\n",
              score.mass_error, score.missed, score.spurious);
  std::printf("nees %.3f\ninside_95 %.3f\n", score.nees, score.inside);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  TargetComparison comparison;
  tools::Program program("evaluate_targets",
                         "Scores targets that stand still: OSPA, GOSPA and errors of the number, "
                         "means over moments.");
  program.positional("TARGETS.csv", comparison.log, "as offline writes it");
  program.positional("TRUTH.csv", comparison.truth, "`kind,id,x,y`, where kind is target");
  program.option("--order", comparison.order, "P", "order of the metrics, by default 1");
  program.option("--cutoff", comparison.cutoff, "METRES", "their cut-off, by default 5");
  program.option("--from", comparison.from, "SECONDS", "after the first look");
  program.option("--to", comparison.to, "SECONDS", "up to here");
  program.option("--step", comparison.step, "SECONDS", "between two moments, by default 10");
  return program.run(argc, argv, [&] { return evaluate(comparison); });
}
