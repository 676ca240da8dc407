#include "sightline/driver/serial_line.h"

#include <cerrno>

#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

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

// TIOCEXCL keeps out everybody but root, the lock those who ask for it.
error_code claim(int handle) {
  if (flock(handle, LOCK_EX | LOCK_NB) != 0 || ioctl(handle, TIOCEXCL) != 0) {
    return {errno, boost::system::system_category()};
  }
  tcflush(handle, TCIOFLUSH);
  return {};
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

Trouble SerialLine::open(const std::string& path, int baud_rate) {
  close();
  error_code error;
  port_.open(path, error);
  if (!error) error = claim(port_.native_handle());
  if (!error) error = configure(baud_rate);
  if (!error) return {};
  close();
  return trouble(faultOf(error), path + ": " + error.message());
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
