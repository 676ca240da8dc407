#pragma once

#include <string>

namespace sightline::simulation {

/// A serial line without a cable: a program that opens `path` as a serial port talks to handle(),
/// which never blocks.
///
/// Once nobody has the port open any more, reading from the handle fails with EIO. What its last
/// user did to the port outlives him then: a killed program's claim (TIOCEXCL) would keep everybody
/// else out. Another terminal at the same path is free.
class PseudoTerminal {
 public:
  /// `path` becomes a link to the terminal. A link to another terminal is replaced; nothing else
  /// is. Throws config::Error naming the path.
  explicit PseudoTerminal(std::string path);
  /// Ends like a cable that is pulled: the port at the other end is gone, and the link unless it
  /// leads elsewhere by now.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int handle() const { return master_; }

 private:
  std::string path_;
  std::string name_;  // of the port, below /dev/pts
  int master_ = -1;
};

}  // namespace sightline::simulation
