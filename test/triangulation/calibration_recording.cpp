#include "sightline/triangulation/calibration_recording.h"

#include <gmock/gmock.h>

#include "config_error.h"

namespace sightline::triangulation {
namespace {

using test::errorOf;
using testing::HasSubstr;

const std::string kHeader =
    "beam,target,depth_m,readings,current_A,image_position_m,stripe_edge_m,stripe_width_m\n";

CalibrationRecording readCsv(const std::string& text) {
  return readRecording(config::CsvTable::parse(text, "r.csv"), SensorParameters());
}

TEST(CalibrationRecording, GathersRowsByPlacement) {
  const auto recording = readCsv(kHeader +
                                 "7,plain,1,40,2e-8,1e-3,,\n"
                                 "3,striped,1,20,3e-9,-2e-3,-0.5,0.06\n"
                                 "2,plain,1,40,2.5e-8,1.1e-3,,\n");
  ASSERT_EQ(recording.placements.size(), 2U);
  const TargetPlacement& plain = recording.placements[0];
  EXPECT_FALSE(plain.stripes);
  EXPECT_EQ(plain.depth, 1.0);
  ASSERT_EQ(plain.beams.size(), 2U);
  EXPECT_EQ(plain.beams[0].beam, 2U);
  EXPECT_EQ(plain.beams[0].image_position, 1.1e-3);
  EXPECT_EQ(plain.beams[1].beam, 7U);
  EXPECT_EQ(plain.beams[1].readings, 40);
  EXPECT_EQ(plain.beams[1].current, 2e-8);
  const TargetPlacement& striped = recording.placements[1];
  ASSERT_TRUE(striped.stripes);
  EXPECT_DOUBLE_EQ(striped.stripes->edgeAt(2), -0.38);
}

TEST(CalibrationRecording, IsWrittenToTheLastDigit) {
  CalibrationRecording recording;
  recording.placements.push_back({1.0 / 3.0, {}, {{0, 40, 1e-3 / 3.0, 2e-8 / 3.0}}});
  recording.placements.push_back({1.0 / 7.0, Stripes{-0.1, 0.06}, {{255, 1, -1e-3 / 7.0, 1e-9}}});
  const auto back = readCsv(toCsv(recording));
  ASSERT_EQ(back.placements.size(), 2U);
  EXPECT_EQ(back.placements[0].depth, 1.0 / 3.0);
  EXPECT_EQ(back.placements[0].beams[0].image_position, 1e-3 / 3.0);
  EXPECT_EQ(back.placements[0].beams[0].current, 2e-8 / 3.0);
  EXPECT_EQ(back.placements[1].stripes->edge, -0.1);
  EXPECT_EQ(back.placements[1].stripes->width, 0.06);
  EXPECT_EQ(back.placements[1].beams[0].beam, 255U);
}

TEST(CalibrationRecording, PlainTargetsNeedNoStripeColumns) {
  const std::string header = "target,depth_m,beam,readings,image_position_m,current_A\n";
  EXPECT_EQ(readCsv(header + "plain,1,0,1,0,1e-8\n").placements.size(), 1U);
  EXPECT_STREQ(errorOf([&] { readCsv(header + "striped,1,0,1,0,1e-8\n"); }).key().c_str(),
               "stripe_width_m");
}

TEST(CalibrationRecording, NamesTheColumnAtFault) {
  struct Case {
    const char* row;
    const char* column;
  };
  for (const Case& fault :
       {Case{"256,plain,1,40,2e-8,1e-3,,", "beam"}, Case{"-1,plain,1,40,2e-8,1e-3,,", "beam"},
        Case{"1.5,plain,1,40,2e-8,1e-3,,", "beam"}, Case{"1,dotted,1,40,2e-8,1e-3,,", "target"},
        Case{"1,plain,0,40,2e-8,1e-3,,", "depth_m"}, Case{"1,plain,-1,40,2e-8,1e-3,,", "depth_m"},
        Case{"1,plain,1,0,2e-8,1e-3,,", "readings"}, Case{"1,plain,1,40,0,1e-3,,", "current_A"},
        Case{"1,plain,1,40,2e-8,6e-3,,", "image_position_m"},
        Case{"1,plain,1,40,2e-8,x,,", "image_position_m"},
        Case{"1,striped,1,40,2e-8,1e-3,0,-1", "stripe_width_m"},
        Case{"1,striped,1,40,2e-8,1e-3,,1", "stripe_edge_m"},
        Case{"9,plain,1,40,2e-8,1e-3,,", "beam"}}) {
    const auto error =
        errorOf([&] { readCsv(kHeader + "9,plain,1,40,2e-8,1e-3,,\n" + fault.row + "\n"); });
    EXPECT_EQ(error.key(), fault.column) << fault.row;
    EXPECT_EQ(error.line(), 3) << fault.row;
  }
}

TEST(CalibrationRecording, RefusesAFileWithoutReadingsOrWithAMissingColumn) {
  EXPECT_THAT(errorOf([] { readCsv(kHeader); }).what(), HasSubstr("holds no reading"));
  const auto error =
      errorOf([] { readCsv("target,depth_m,beam,readings,image_position_m\nplain,1,0,1,0\n"); });
  EXPECT_EQ(error.key(), "current_A");
  EXPECT_EQ(error.line(), 1);
}

}  // namespace
}  // namespace sightline::triangulation
