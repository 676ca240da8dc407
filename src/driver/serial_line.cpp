#include "sightline/driver/serial_line.h"

#include <cerrno>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "sightline/driver/port_name.h"

namespace sightline::driver {

namespace {

using boost::system::error_code;

Fault faultOf(const error_code& error) {
  switch (error.value()) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return Fault::kNoSuchPort;
    case EACCES:
    case EPERM:
      return Fault::kNoPermission;
    case EBUSY:
    case EWOULDBLOCK:
      return Fault::kPortBusy;
    case ENOTTY:
      return Fault::kNotASerialPort;
    default:
      return Fault::kPortFailed;
  }
}

error_code lastError() {
  return {errno, boost::system::system_category()};
}

// What the error of the system is worth telling beside the name of the fault.
std::string detailOf(const error_code& error, const std::string& path) {
  const Fault fault = faultOf(error);
  if (fault == Fault::kNoSuchPort || fault == Fault::kNotASerialPort) return path;
  if (fault != Fault::kPortBusy) return path + ": " + error.message();
  const std::string holder = holderOf(path);
  return path + ": " + (holder.empty() ? "another program has it" : "held by " + holder);
}

// Every byte as it is. The rest of the settings is asio's.
error_code makeRaw(int handle) {
  termios settings{};
  if (tcgetattr(handle, &settings) != 0) return lastError();
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  return tcsetattr(handle, TCSANOW, &settings) == 0 ? error_code() : lastError();
}

}  // namespace

error_code SerialLine::configure(int baud_rate) {
  using Port = boost::asio::serial_port_base;
  error_code error;
  port_.set_option(Port::baud_rate(static_cast<unsigned>(baud_rate)), error);
  if (!error) port_.set_option(Port::character_size(8), error);
  if (!error) port_.set_option(Port::parity(Port::parity::none), error);
  if (!error) port_.set_option(Port::stop_bits(Port::stop_bits::one), error);
  if (!error) port_.set_option(Port::flow_control(Port::flow_control::none), error);
  return error;
}

SerialLine::~SerialLine() {
  close();
}

// Changes nothing on a port before it is ours: TIOCEXCL keeps out everybody but root, the lock
// those who ask for it.
Trouble SerialLine::open(const std::string& path, int baud_rate) {
  close();
  const auto fail = [&](const error_code& error) {
    close();
    return trouble(faultOf(error), detailOf(error, path));
  };
  const int handle = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return fail(lastError());
  if (isatty(handle) == 0 || flock(handle, LOCK_EX | LOCK_NB) != 0) {
    const error_code error = lastError();
    ::close(handle);
    return fail(error);
  }
  error_code error;
  port_.assign(handle, error);
  if (!error && ioctl(handle, TIOCEXCL) != 0) error = lastError();
  if (!error) error = makeRaw(handle);
  if (error) return fail(error);
  error = configure(baud_rate);
  if (error) {
    close();
    return trouble(faultOf(error),
                   fmt::format("{} at a baud_rate of {}: {}", path, baud_rate, error.message()));
  }
  tcflush(handle, TCIOFLUSH);
  return {};
}

void SerialLine::close() {
  if (!isOpen()) return;
  ioctl(port_.native_handle(), TIOCNXCL);  // the claim outlives the handle where others hold one
  error_code ignored;
  port_.close(ignored);
}

void SerialLine::write(ByteView bytes) {
  if (bytes.size == 0 || !isOpen()) return;
  // Errors show in reading, too, which is where they are dealt with.
  [[maybe_unused]] const auto written = ::write(port_.native_handle(), bytes.data, bytes.size);
}

}  // namespace sightline::driver
