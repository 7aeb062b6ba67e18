#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "host_sim/controllers/answer_time.hpp"

namespace firmtouch::host_sim {

/// Byte stream to and from a controller. Throws Refused with its name if the far end closed the
/// stream or accepts no bytes.
class ByteStream {
 public:
  ByteStream(int in, int out, std::string name) : in_(in), out_(out), name_(std::move(name)) {}
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  virtual ~ByteStream();

  void write(const uint8_t* from, uint32_t count);
  /// Waits up to `timeout_ms` for at least one byte. Result: bytes read; 0 after the time-out.
  uint32_t read(uint8_t* to, uint32_t capacity, int timeout_ms);
  const std::string& name() const { return name_; }
  /// How long an answer may take.
  double wait_s() const { return wait_s_; }
  void set_wait_s(double wait_s) { wait_s_ = wait_s; }
  /// After that time: what may be wrong, by what came until then.
  std::string why_silent() const;
  /// To wait for its bytes together with others.
  int descriptor() const { return in_; }

 protected:
  /// Why the stream was closed, for the message: " (exit status 71)".
  virtual std::string reason_closed() { return ""; }
  int in_, out_;
  std::string name_;

 private:
  double wait_s_ = kAnswer_s;
  uint64_t received_ = 0;
};

/// unix:PATH, tcp:HOST:PORT, or a serial device (raw, 1 Mbaud). Throws Refused.
std::unique_ptr<ByteStream> connect_stream(const std::string& where, double wait_s = kAnswer_s);

/// Starts QEMU with `image` and the asset in the board's slot. The link uses two FIFOs, one trap a
/// frame (hal/emulator/file_link.hpp): 20,000 ticks a second; the emulated UART carries 1,000.
std::unique_ptr<ByteStream> start_emulator(const std::string& board, const std::string& image,
                                           const std::string& asset_path);

}  // namespace firmtouch::host_sim
