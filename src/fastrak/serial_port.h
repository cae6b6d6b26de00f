#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>
#include <chrono>
#include <stdexcept>
#include <string>

namespace spring_workbench::fastrak {

inline std::chrono::steady_clock::duration seconds(double s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(s));
}

/// One line that names a serial port and says why it cannot be used.
class SerialError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A serial port opened for exclusive use: 8 data bits, no parity, one stop bit, no handshake.
class SerialPort {
 public:
  /// Throws SerialError.
  SerialPort(const std::string& path, int baud);
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Throws SerialError if the port has disappeared or does not accept the bytes within 0.2 s.
  void write(const std::string& bytes);

  /// Returns the bytes that have arrived; waits for some for at most `timeout` [s]. Throws SerialError if the port has
  /// disappeared.
  std::string read(double timeout);

 private:
  void listen();
  void set_up(int baud);
  [[noreturn]] void fail(const boost::system::error_code& error) const;

  const std::string path_;
  boost::asio::io_context context_;
  boost::asio::serial_port port_;
  std::array<char, 4096> chunk_{};
  std::string received_;
  boost::system::error_code failure_;
};

}  // namespace spring_workbench::fastrak
