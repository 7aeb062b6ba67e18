#include <cstring>
#include <filesystem>
#include <utility>

#include "firmtouch/link/build_id.hpp"
#include "firmtouch/link/decoder.hpp"
#include "firmtouch/link/protocol.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/controllers/byte_stream.hpp"
#include "host_sim/controllers/lock_step_controller.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr int kHelloAgain_ms = 1000;  // a Hello is lost if the controller is still starting

class Remote : public LockStepController {
 public:
  Remote(std::unique_ptr<ByteStream> stream, uint32_t asset_crc) : stream_(std::move(stream)) {
    handshake(asset_crc);
  }
  ~Remote() override {
    try {
      link::Bye bye;
      bye.what = link::kByeExit;
      send(link::kBye, link::bytes_of(bye));
    } catch (const Refused&) {  // it ended already
    }
  }
  TickCost tick(const record::TickInput& input, record::TickOutput& output) override;
  std::string name() const override { return board_ + " (" + stream_->name() + ")"; }

 private:
  void send(uint8_t type, core::Bytes payload);
  bool receive(link::Frame& frame, int timeout_ms);
  void handshake(uint32_t asset_crc);
  [[noreturn]] void refuse(const std::string& what) const {
    throw Refused(stream_->name() + ": " + what);
  }

  std::unique_ptr<ByteStream> stream_;
  link::Decoder decoder_;
  std::string board_;
  uint8_t bytes_[link::kMaxFrameBytes] = {};
  uint32_t count_ = 0, next_ = 0;
  uint16_t sequence_ = 0;
};

void Remote::send(uint8_t type, core::Bytes payload) {
  uint8_t frame[link::kMaxFrameBytes];
  const uint32_t count =
      link::encode(type, ++sequence_, payload, core::Span<uint8_t>(frame, sizeof frame));
  stream_->write(frame, count);
}

// Result: false if no complete frame arrived in time.
bool Remote::receive(link::Frame& frame, int timeout_ms) {
  for (;;) {
    if (decoder_.next(frame)) return true;
    if (next_ == count_) {
      next_ = 0;
      count_ = stream_->read(bytes_, sizeof bytes_, timeout_ms);
      if (count_ == 0) return false;
    }
    decoder_.push(bytes_[next_++]);
  }
}

void Remote::handshake(uint32_t asset_crc) {
  link::Hello hello;
  hello.host.asset_crc = asset_crc;
  hello.host.parameter_table_hash = params::table_hash();
  hello.host.build_id = link::build_id();
  hello.mode = link::kModeLockStep;
  link::HelloReply reply;
  AnswerTime time(stream_->name() + ": no answer to the handshake", stream_->wait_s());
  for (bool is_ready = false; !is_ready;) {
    if (time.is_over())
      throw Refused(time.text() + "; " +
                    ((reply.refused & link::kRefusedNotReady) != 0
                         ? "the controller is still checking its asset: wait longer"
                         : stream_->why_silent()));
    send(link::kHello, link::bytes_of(hello));
    link::Frame frame;
    bool replied = false;
    while (!replied && receive(frame, time.wait_ms(kHelloAgain_ms)))
      replied = frame.type == link::kHelloReply && link::take(frame, reply);
    is_ready = replied && (reply.refused & link::kRefusedNotReady) == 0;
  }
  if (reply.refused != 0)
    refuse("the controller rejects the session:\n" + refusal_text(hello.host, reply));
  board_ = std::string(reply.board, strnlen(reply.board, sizeof reply.board));
}

TickCost Remote::tick(const record::TickInput& input, record::TickOutput& output) {
  link::Step step;
  step.input = input;
  send(link::kStep, link::bytes_of(step));
  link::Frame frame;
  AnswerTime time(stream_->name() + ": no answer to tick " + std::to_string(input.tick),
                  stream_->wait_s());
  while (!time.is_over()) {
    link::StepReply reply;
    if (!receive(frame, time.wait_ms(kHelloAgain_ms))) continue;
    if (frame.type == link::kText)
      refuse(
          "tick " + std::to_string(input.tick) + ": " +
          std::string(reinterpret_cast<const char*>(frame.payload.data()), frame.payload.size()));
    if (frame.type != link::kStepReply || !link::take(frame, reply) || reply.tick != input.tick)
      continue;
    output = reply.output;
    TickCost cost;
    if (reply.work_per_1000 > 0)
      cost.instructions = static_cast<uint32_t>(
          (uint64_t{reply.work} * 1000 + reply.work_per_1000 / 2) / reply.work_per_1000);
    cost.stack_high_bytes = reply.stack_high_bytes;
    return cost;
  }
  throw Refused(time.text() + "; has it halted, or was its cable pulled?");
}

// build/<board>/bin/<program>.elf, next to this program's build/host/bin.
std::string image_of(const std::string& board, const std::string& program) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return (self.parent_path().parent_path().parent_path() / board / ("bin/" + program + ".elf"))
      .string();
}

}  // namespace

std::unique_ptr<LockStepController> open_controller(const std::string& controller,
                                                    const std::string& image,
                                                    const std::string& asset_path,
                                                    uint32_t asset_crc, const std::string& program,
                                                    double wait_s) {
  if (is_in_process(controller)) return nullptr;
  if (controller.compare(0, 5, "qemu:") != 0)
    return std::make_unique<Remote>(connect_stream(controller, wait_s), asset_crc);
  const std::string board = controller.substr(5);
  std::unique_ptr<ByteStream> emulator =
      start_emulator(board, image.empty() ? image_of(board, program) : image, asset_path);
  emulator->set_wait_s(wait_s);
  return std::make_unique<Remote>(std::move(emulator), asset_crc);
}

}  // namespace firmtouch::host_sim
