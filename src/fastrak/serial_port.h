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

/// Why a serial port cannot be used, in one line that names it.
class SerialError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An open serial port, 8 data bits, no parity, one stop bit, no handshake, for this process alone.
class SerialPort {
 public:
  /// Throws SerialError.
  SerialPort(const std::string& path, int baud);
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Throws SerialError where the port is gone or does not take the bytes in 0.2 s.
  void write(const std::string& bytes);

  /// What has come; waits for it, at most `timeout` [s]. Throws SerialError where the port is gone.
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
