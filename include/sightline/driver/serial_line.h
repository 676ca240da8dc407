#pragma once

#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>

#include "sightline/driver/bytes.h"
#include "sightline/driver/trouble.h"

namespace sightline::driver {

/// A serial port for this program alone: 8 data bits, no parity, one stop bit, no flow control.
class SerialLine {
 public:
  explicit SerialLine(boost::asio::io_context& context) : port_(context) {}
  ~SerialLine();
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Opens the port; bytes that came before are dropped. Without trouble it is open afterwards.
  Trouble open(const std::string& path, int baud_rate);
  void close();
  bool isOpen() const { return port_.is_open(); }

  /// Hands over what the line takes without waiting; a device that does not listen misses the rest.
  void write(ByteView bytes);
  boost::asio::serial_port& port() { return port_; }

 private:
  boost::system::error_code configure(int baud_rate);

  boost::asio::serial_port port_;
};

}  // namespace sightline::driver
