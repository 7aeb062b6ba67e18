#pragma once
#include <cstdint>
#include <memory>
#include <string>

namespace firmtouch::host_sim {

/// Bytes to and from a controller. Throws Refused, naming it, where the far end is gone or silent.
class ByteStream {
 public:
  ByteStream(int in, int out, std::string name) : in_(in), out_(out), name_(std::move(name)) {}
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  virtual ~ByteStream();

  void write(const uint8_t* from, uint32_t count);
  /// Waits up to `timeout_ms` for at least one byte. Result: bytes read, 0 for none in that time.
  uint32_t read(uint8_t* to, uint32_t capacity, int timeout_ms);
  const std::string& name() const { return name_; }

 protected:
  /// Why it may be gone, for the message: " (exit status 71)".
  virtual std::string why_gone() { return ""; }
  int in_, out_;
  std::string name_;
};

/// unix:PATH, tcp:HOST:PORT, or a serial device (raw, 1 Mbaud).
std::unique_ptr<ByteStream> connect_stream(const std::string& where);

/// A board of ours in QEMU, `image` its program, the asset loaded where the board looks for it. It
/// speaks over two FIFOs of this machine, one trap a frame (hal/cortex-m/file_link.hpp): some
/// 20,000 ticks a second, where its emulated UART makes 1,000.
std::unique_ptr<ByteStream> start_emulator(const std::string& board, const std::string& image,
                                           const std::string& asset_path);

}  // namespace firmtouch::host_sim
