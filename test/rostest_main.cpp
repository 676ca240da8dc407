// The main of the node tests: runs the cases of test/nodes/NAME.cpp. ROS is up before the first,
// and callbacks run beside them.
//
// usage: test_nodes NAME
#include <iostream>
#include <string>

#include <gtest/gtest.h>
#include <ros/ros.h>

namespace {

// The cases that stand in a file, as a filter; empty if there are none.
std::string casesOf(const std::string& file) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& test = *suite.GetTestInfo(j);
      const std::string path = test.file();
      if (path.substr(path.rfind('/') + 1) == file) {
        filter += std::string(test.test_suite_name()) + "." + test.name() + ":";
      }
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_test");
  const std::string filter = casesOf(argc > 1 ? std::string(argv[1]) + ".cpp" : "");
  if (filter.empty()) {
    std::cerr << "usage: test_nodes NAME, where test/nodes/NAME.cpp has cases\n";
    return 2;
  }
  testing::GTEST_FLAG(filter) = filter;
  const ros::NodeHandle keeps_ros_up;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
