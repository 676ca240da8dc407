#include "sightline/mapping/recording_faults.h"

#include <gmock/gmock.h>

namespace sightline::mapping {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Relation relation(std::size_t from, std::size_t to) {
  Relation relation;
  relation.from = from;
  relation.to = to;
  return relation;
}

TEST(PartsOf, APathThatHoldsTogetherIsOne) {
  std::vector<Relation> relations;
  for (std::size_t i = 1; i < 20; ++i) relations.push_back(relation(i - 1, i));
  EXPECT_THAT(partsOf(20, relations), ElementsAre(0));
}

TEST(PartsOf, TwoBuildingsAreTwo) {
  std::vector<Relation> relations;
  for (std::size_t i = 1; i < 20; ++i) {
    if (i != 10) relations.push_back(relation(i - 1, i));
  }
  EXPECT_THAT(partsOf(20, relations), ElementsAre(0, 10));
  relations.push_back(relation(2, 15));  // a loop joins them
  EXPECT_THAT(partsOf(20, relations), ElementsAre(0));
}

TEST(PartsOf, AFewScansOfTheirOwnAreNone) {
  std::vector<Relation> relations;
  for (std::size_t i = 1; i < 20; ++i) {
    if (i != 18) relations.push_back(relation(i - 1, i));
  }
  EXPECT_THAT(partsOf(20, relations), ElementsAre(0));
}

TEST(FaultOf, NothingToRead) {
  const Survey survey{pipeline::EstimatorsConfig()};
  EXPECT_THAT(faultOf(survey, {}), HasSubstr("no scan"));
}

TEST(FaultOf, AScannerThatStands) {
  Survey survey{pipeline::EstimatorsConfig()};
  const auto geometry = scan::ScanGeometry::uniform(-1.5, 0.05, 61, 0.0, 0.1, 10.0);
  for (std::int64_t i = 1; i <= 5; ++i) {
    pipeline::LocatedScan located;
    located.scan = scan::Scan(geometry, i * 200'000'000, std::vector<double>(61, 2.0));
    survey.take(std::move(located));
    const auto fault = faultOf(survey, {});
    EXPECT_THAT(fault, HasSubstr(i == 1 ? "one scan" : "did not move"));
  }
}

}  // namespace
}  // namespace sightline::mapping
