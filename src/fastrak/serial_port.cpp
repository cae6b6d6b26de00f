#include "serial_port.h"

#include <sys/file.h>
#include <termios.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <utility>

#include "constants.h"

namespace spring_workbench::fastrak {

using boost::asio::serial_port_base;
using boost::system::error_code;

SerialPort::SerialPort(const std::string& path, int baud) : path_(path), port_(context_) {
  error_code error;
  port_.open(path, error);
  if (error == boost::system::errc::no_such_file_or_directory || error == boost::system::errc::no_such_device ||
      error == boost::system::errc::no_such_device_or_address) {
    throw SerialError(path + ": no such port: is the device or its adapter plugged in?");
  }
  if (error == boost::system::errc::permission_denied) {
    throw SerialError(path + ": no permission: your user must be in the group that owns the port (often dialout)");
  }
  if (error == boost::system::errc::inappropriate_io_control_operation) {
    throw SerialError(path + ": is not a serial port");
  }
  if (error) fail(error);
  if (flock(port_.native_handle(), LOCK_EX | LOCK_NB) != 0) {
    throw SerialError(path + ": is in use by another program");
  }
  set_up(baud);
  tcflush(port_.native_handle(), TCIOFLUSH);
  listen();
}

void SerialPort::set_up(int baud) {
  error_code error;
  const auto set = [&](const auto& option) {
    if (!error) port_.set_option(option, error);
  };
  set(serial_port_base::character_size(8));
  set(serial_port_base::parity(serial_port_base::parity::none));
  set(serial_port_base::stop_bits(serial_port_base::stop_bits::one));
  set(serial_port_base::flow_control(serial_port_base::flow_control::none));
  set(serial_port_base::baud_rate(static_cast<unsigned>(baud)));
  if (error) fail(error);
}

void SerialPort::fail(const error_code& error) const {
  throw SerialError(path_ + ": the port has disappeared: " + error.message());
}

void SerialPort::listen() {
  port_.async_read_some(boost::asio::buffer(chunk_), [this](const error_code& error, std::size_t size) {
    received_.append(chunk_.data(), size);
    failure_ = error;
    if (!error) listen();
  });
}

void SerialPort::write(const std::string& bytes) {
  bool over = false;
  error_code failure;
  boost::asio::async_write(port_, boost::asio::buffer(bytes), [&](const error_code& error, std::size_t) {
    over = true;
    failure = error;
  });
  const auto deadline = std::chrono::steady_clock::now() + seconds(longest_write);
  context_.restart();
  while (!over && context_.run_one_until(deadline) > 0) continue;
  if (!over) {
    port_.cancel();
    context_.restart();
    while (!over && context_.run_one() > 0) continue;
    throw SerialError(path_ + ": does not accept data");
  }
  if (failure) fail(failure);
}

std::string SerialPort::read(double timeout) {
  if (received_.empty() && !failure_) {
    context_.restart();
    if (context_.poll_one() == 0) context_.run_one_for(seconds(timeout));
  }
  if (received_.empty() && failure_) fail(failure_);
  return std::exchange(received_, {});
}

}  // namespace spring_workbench::fastrak
