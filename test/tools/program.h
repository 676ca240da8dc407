#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace sightline::test {

/// Output of a program, on either channel, and its exit status: 128 and the signal, as shells have
/// it, where a signal ended it.
struct ProgramResult {
  int status = 0;
  std::string output;
};

inline ProgramResult runCommand(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  ProgramResult result;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) {
    result.output += buffer.data();
  }
  const int end = pclose(pipe);
  result.status = WIFEXITED(end) ? WEXITSTATUS(end) : 128 + WTERMSIG(end);
  return result;
}

/// Runs one of the package's own programs. Arguments are parted by blanks.
inline ProgramResult runProgram(const std::string& name, const std::string& arguments) {
  return runCommand(SIGHTLINE_PROGRAMS "/" + name + " " + arguments);
}

}  // namespace sightline::test
