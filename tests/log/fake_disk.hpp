#pragma once
#include <functional>
#include <map>
#include <string>

#include "log/memory_sink.hpp"

namespace firmtouch::log_test {

/// A disk and a clock in one: a write takes the time that its bytes take, and whoever makes records
/// makes them meanwhile. From `stall_from_s` it stands still for `stall_s`; from `full_from_s` to
/// `full_to_s` it has no room.
struct FakeDisk {
  double now_s = 0;
  double bytes_per_s = 100e6;
  double stall_from_s = 1e18, stall_s = 0;
  double full_from_s = 1e18, full_to_s = 1e18;
  std::function<void(double now_s)> meanwhile;  // records up to this time are made
  std::map<uint32_t, std::vector<uint8_t>> files;
  // Takes a file that was closed; without it they are kept in `files`.
  std::function<void(const std::vector<uint8_t>&)> closed;

  void pass(double seconds) {
    now_s += seconds;
    if (meanwhile) meanwhile(now_s);
  }
  bool work(uint64_t bytes) {
    const bool stalls = now_s >= stall_from_s;
    if (stalls) stall_from_s = 1e18;
    pass(static_cast<double>(bytes) / bytes_per_s + (stalls ? stall_s : 0));
    return !(now_s >= full_from_s && now_s < full_to_s);
  }
};

class FakeFile : public log::MemorySink {
 public:
  FakeFile(FakeDisk& disk, uint32_t part) : disk_(disk), part_(part) {}
  ~FakeFile() override {
    if (disk_.closed)
      disk_.closed(bytes());
    else
      disk_.files[part_] = bytes();
  }
  bool write(uint64_t offset, Part first, Part second) override {
    if (disk_.work(first.bytes + second.bytes)) return MemorySink::write(offset, first, second);
    // A full disk takes a part of it.
    Part some = first;
    some.bytes /= 2;
    MemorySink::write(offset, some, {nullptr, 0});
    return false;
  }
  bool sync() override { return disk_.work(0); }
  std::string problem() const override { return "no space left on the fake disk"; }

 private:
  FakeDisk& disk_;
  uint32_t part_;
};

}  // namespace firmtouch::log_test
