#include "host_sim/controllers/live_link.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "firmtouch/link/frame.hpp"
#include "harness/test.hpp"

namespace firmtouch::host_sim {
namespace {

// Answers the first request only when it was sent twice, and then both times, as a controller does
// that was busy with its flash; the next one at once, by a rejection.
void answer_late(int file) {
  link::Decoder decoder;
  std::vector<uint16_t> waiting;
  uint8_t byte;
  while (read(file, &byte, 1) == 1) {
    decoder.push(byte);
    for (link::Frame frame; decoder.next(frame);) {
      waiting.push_back(frame.sequence);
      if (waiting.size() == 1 && frame.type == link::kBeginAsset) continue;
      link::AssetAck ack;
      if (frame.type == link::kCommitAsset) ack.result = link::kAckAssetRejected;
      for (const uint16_t sequence : waiting) {
        uint8_t reply[link::kMaxFrameBytes];
        const uint32_t count = link::encode(link::kAssetAck, sequence, link::bytes_of(ack), reply);
        (void)send(file, reply, count, MSG_NOSIGNAL);
        usleep(50'000);  // the other end takes this one alone
      }
      waiting.clear();
    }
  }
}

}  // namespace

TEST(LiveLink_SecondAnswerToARepeatedRequest_IsNoneToTheNext) {
  int ends[2];
  CHECK_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  std::thread controller([&] { answer_late(ends[1]); });
  {
    LiveLink link(std::make_unique<ByteStream>(ends[0], dup(ends[0]), "slow"));
    CHECK_EQ(link.begin_asset(100, 1).result, link::kAckTaken);
    CHECK_EQ(link.commit_asset().result, link::kAckAssetRejected);
  }
  shutdown(ends[1], SHUT_RDWR);
  controller.join();
  close(ends[1]);
}

}  // namespace firmtouch::host_sim
