#include "sightline/targets/joint_association.h"

namespace sightline::targets {

namespace {

using Offsets = std::vector<Look::Offset>;  // by measurement

// Weights of targets with measurements over those of both apart (Williams and Lau 2014); below them
// those of known things, which compete for the measurements. `ratio(i, m)` without the offsets.
template <class TargetRatio, class KnownRatio>
Eigen::MatrixXd ratiosOf(std::size_t targets, std::size_t known, const std::vector<double>& unknown,
                         const TargetRatio& of_target, const KnownRatio& of_known) {
  Eigen::MatrixXd ratio(targets + known, unknown.size());
  for (std::size_t i = 0; i < targets + known; ++i) {
    for (std::size_t m = 0; m < unknown.size(); ++m) {
      const double weight = i < targets ? of_target(i, m) : of_known(i - targets, m);
      ratio(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m)) = weight / unknown[m];
    }
  }
  return ratio;
}

Eigen::MatrixXd ratiosApart(const std::vector<Candidate>& candidates, const Look& look,
                            const std::vector<double>& unknown) {
  return ratiosOf(
      candidates.size(), look.knownCount(), unknown,
      [&](std::size_t i, std::size_t m) { return candidates[i].ratio(m); },
      [&](std::size_t i, std::size_t m) { return look.knownRatio(i, m); });
}

Eigen::MatrixXd ratiosTogether(const std::vector<Candidate>& candidates, const Look& look,
                               const std::vector<double>& unknown, const Offsets& offsets) {
  return ratiosOf(
      candidates.size(), look.knownCount(), unknown,
      [&](std::size_t i, std::size_t m) { return candidates[i].ratio(m, offsets[m]); },
      [&](std::size_t i, std::size_t m) { return look.knownRatio(i, m, offsets[m]); });
}

Pull pullBy(std::size_t measurement, const Association& association,
            const std::vector<Candidate>& candidates, const Look& look) {
  constexpr double kHardly = 1e-3;
  Pull sum;
  for (std::size_t i = 0; i < candidates.size() + look.knownCount(); ++i) {
    const double share =
        association.assigned(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(measurement));
    if (share < kHardly) continue;
    const std::size_t known = i - candidates.size();
    sum.add(share, i < candidates.size() ? candidates[i].pull(measurement)
                                         : pullOf(look.knownInnovation(known, measurement), look));
  }
  return sum;
}

// For each measurement what the others say.
Offsets offsetsBy(const Association& association, const std::vector<Candidate>& candidates,
                  const Look& look) {
  Pull all{1.0 / look.commonVariance(), 0.0};
  std::vector<Pull> pulls;
  for (std::size_t m = 0; m < look.size(); ++m) {
    pulls.push_back(pullBy(m, association, candidates, look));
    all.add(1.0, pulls.back());
  }
  Offsets offsets;
  for (const Pull& own : pulls) {
    const double information = all.information - own.information;
    offsets.push_back({(all.moment - own.moment) / information, 1.0 / information});
  }
  return offsets;
}

}  // namespace

Association associateTogether(const std::vector<Candidate>& candidates, const Look& look,
                              const std::vector<double>& unknown) {
  constexpr int kRounds = 2;
  Association association = associate(ratiosApart(candidates, look, unknown));
  if (look.size() < 2 || !(look.commonVariance() > 0.0)) return association;
  for (int round = 0; round < kRounds; ++round) {
    const Offsets offsets = offsetsBy(association, candidates, look);
    association = associate(ratiosTogether(candidates, look, unknown, offsets));
  }
  return association;
}

}  // namespace sightline::targets
