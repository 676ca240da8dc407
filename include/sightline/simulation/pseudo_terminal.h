#pragma once

#include <string>

namespace sightline::simulation {

/// A serial line without a cable: whoever opens `path` as a serial port talks to handle(), which
/// never blocks.
class PseudoTerminal {
 public:
  /// `path` becomes a link to the terminal; a link that is there already is replaced. Throws
  /// config::Error naming the path.
  explicit PseudoTerminal(std::string path);
  /// As a cable that is pulled: the port at the other end is gone.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int handle() const { return master_; }

 private:
  std::string path_;
  int master_ = -1;
  int slave_ = -1;  // kept open, or the line would end with each port that is closed
};

}  // namespace sightline::simulation
