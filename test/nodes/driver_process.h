#pragma once

#include <csignal>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sightline::test {

/// The node sync_scan_driver in a namespace of its own, ended with the object.
class DriverProcess {
 public:
  /// Parameters as on the command line, such as `_port:=PATH`; `before` goes ahead of the program.
  DriverProcess(const std::string& ns, const std::vector<std::string>& parameters,
                std::vector<std::string> before = {}) {
    std::vector<std::string> words = std::move(before);
    words.push_back(SIGHTLINE_PROGRAMS "/sync_scan_driver");
    words.push_back("__ns:=" + ns);
    words.insert(words.end(), parameters.begin(), parameters.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = fork();
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    execvp(arguments[0], arguments.data());
    std::_Exit(127);
  }
  ~DriverProcess() {
    kill(process_, SIGINT);
    waitpid(process_, nullptr, 0);
  }
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

 private:
  pid_t process_ = -1;
};

}  // namespace sightline::test
