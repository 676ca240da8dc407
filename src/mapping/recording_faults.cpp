#include "sightline/mapping/recording_faults.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace sightline::mapping {

namespace {

constexpr struct {
  double least_way = 0.5;       // of a drive [m]
  std::size_t fewest_keys = 8;  // of a part of a path
} kFaults{};

// Sets of key scans that relations join.
class Parts {
 public:
  explicit Parts(std::size_t keys) : parent_(keys) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t key) {
    while (parent_[key] != key) key = parent_[key] = parent_[parent_[key]];
    return key;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t low = std::min(of(a), of(b));
    const std::size_t high = std::max(of(a), of(b));
    parent_[high] = low;
  }

 private:
  std::vector<std::size_t> parent_;
};

double secondsUpTo(const Survey& survey, std::size_t key) {
  const auto& path = survey.path();
  const auto first = std::find_if(path.begin(), path.end(),
                                  [&](const PathPoint& point) { return point.key >= key; });
  return 1e-9 * static_cast<double>(first->stamp - path.front().stamp);
}

}  // namespace

std::vector<std::size_t> partsOf(std::size_t keys, const std::vector<Relation>& relations) {
  Parts parts(keys);
  for (const Relation& relation : relations) parts.join(relation.from, relation.to);
  std::vector<std::size_t> sizes(keys, 0);
  for (std::size_t key = 0; key < keys; ++key) ++sizes[parts.of(key)];
  std::vector<std::size_t> firsts;
  for (std::size_t key = 0; key < keys; ++key) {
    if (key == 0 || sizes[key] >= kFaults.fewest_keys) firsts.push_back(key);
  }
  return firsts;
}

std::string faultOf(const Survey& survey, const AdjustedPath& path) {
  const std::size_t scans = survey.path().size();
  if (scans == 0) return "no scan of it can be used";
  if (scans == 1) return "it holds one scan that can be used: rooms need a drive through them";
  if (survey.keys().back().way < kFaults.least_way) {
    return "the scanner did not move: rooms need a drive through them";
  }
  const auto parts = partsOf(survey.keys().size(), path.relations);
  if (parts.size() == 1) return "";
  return fmt::format(
      "it falls into {} parts that nothing joins: the scans from {:.1f} s after its start on match "
      "nothing before. Two buildings need a file each; parts of one, a drive that joins them",
      parts.size(), secondsUpTo(survey, parts[1]));
}

}  // namespace sightline::mapping
