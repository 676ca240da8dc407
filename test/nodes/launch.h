#pragma once

#include <csignal>
#include <cstdlib>
#include <string>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sightline::test {

/// A launch file of the package beside a test, at the test's own master; ended with it, and all
/// nodes with it.
class Launch {
 public:
  /// The file and its arguments, parted by blanks.
  explicit Launch(const std::string& arguments) {
    const std::string command = "exec roslaunch --wait sightline " + arguments;
    process_ = fork();
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGINT);  // a test that is killed leaves no nodes behind either
    execl("/bin/bash", "bash", "-c", command.c_str(), nullptr);
    std::_Exit(127);
  }
  ~Launch() {
    if (process_ <= 0) return;
    kill(process_, SIGINT);
    waitpid(process_, nullptr, 0);
  }
  Launch(const Launch&) = delete;
  Launch& operator=(const Launch&) = delete;

 private:
  pid_t process_ = -1;
};

}  // namespace sightline::test
