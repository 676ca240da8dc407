// Any bytes, compressed or not, read as a file of each kind: whole results, or config::Error.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "sightline/config/error.h"
#include "sightline/logs/carmen_odometry.h"
#include "sightline/logs/trajectory.h"

namespace {

using namespace sightline;

// A file without a disk, gone when closed.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("fuzz", 0)) {
    if (write(descriptor_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

template <class Read>
void attempt(const Read& read) {
  try {
    read();
  } catch (const config::Error& error) {
    if (error.reason().empty()) std::abort();
  }
}

void readLog(const std::string& path) {
  auto odometry = logs::odometryOf(logs::readCarmenLog(path));
  logs::reverseFromVelocity(odometry);
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    if (odometry[i].stamp <= odometry[i - 1].stamp) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  attempt([&] { readLog(file.path()); });
  attempt([&] {
    if (logs::readTrajectory(file.path()).empty()) std::abort();
  });
  attempt([&] { logs::readRelations(file.path()); });
  return 0;
}
