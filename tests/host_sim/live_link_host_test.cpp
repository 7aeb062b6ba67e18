#include "host_sim/controllers/live_link.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "firmtouch/asset/loading.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/link/frame.hpp"
#include "harness/test.hpp"
#include "host_sim/controllers/asset_remedy.hpp"
#include "host_sim/scenario/scenario.hpp"
#include "host_sim/trace/queued_records.hpp"

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

// A controller that receives, and sends what `answer` makes of the first frame.
std::string said_after(double wait_s, const std::vector<uint8_t>& answer) {
  int ends[2];
  CHECK_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  if (!answer.empty()) (void)send(ends[1], answer.data(), answer.size(), MSG_NOSIGNAL);
  auto stream = std::make_unique<ByteStream>(ends[0], dup(ends[0]), "silent");
  stream->set_wait_s(wait_s);
  LiveLink link(std::move(stream));
  std::string said;
  try {
    link.begin(1);
  } catch (const Refused& refused) {
    said = refused.what();
  }
  close(ends[1]);
  return said;
}

std::vector<uint8_t> hello_reply(uint32_t refused, uint32_t rule) {
  link::HelloReply reply;
  reply.refused = refused;
  reply.asset_rule = rule;
  uint8_t bytes[link::kMaxFrameBytes];
  const uint32_t count = link::encode(link::kHelloReply, 1, link::bytes_of(reply), bytes);
  return {bytes, bytes + count};
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(LiveLink_ControllerThatDoesNotAnswer_IsReportedInItsTimeWithWhatCame) {
  const auto begin = std::chrono::steady_clock::now();
  CHECK(said_after(0.3, {}) ==
        "silent: no answer to the handshake in 0.3 s (--wait S); nothing came: is it powered, "
        "does it run firmtouch_app, is this its port?");
  const auto passed = std::chrono::steady_clock::now() - begin;
  CHECK(passed >= std::chrono::milliseconds(300) && passed < std::chrono::seconds(3));
  CHECK(contains(said_after(0.1, std::vector<uint8_t>(7, 0xA5)),
                 "in 0.1 s (--wait S); 7 bytes came, and no answer"));
  CHECK(contains(said_after(0.1, hello_reply(link::kRefusedNotReady, 0)),
                 "the controller is still checking its asset: wait longer"));
}

// Its queue is full: the kernel drops whoever else knocks.
TEST(Connect_HostThatDoesNotAnswer_IsGivenUpInItsTime) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  CHECK_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&address), size), 0);
  CHECK_EQ(listen(listener, 0), 0);
  CHECK_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  int waiting[4];
  for (int& one : waiting) {
    one = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
    (void)connect(one, reinterpret_cast<const sockaddr*>(&address), size);
  }
  const std::string where = "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  std::string said;
  const auto begin = std::chrono::steady_clock::now();
  try {
    connect_stream(where, 0.3);
  } catch (const Refused& refused) {
    said = refused.what();
  }
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(3));
  CHECK(contains(said, (where + ": no connection in 0.3 s (--wait S)").c_str()));
  for (const int one : waiting) close(one);
  close(listener);
}

TEST(AssetRemedy_EveryRuleOfTheController_SaysWhatToDo) {
  for (uint32_t part = 0; part < kPartCount; ++part) {
    const std::string said =
        said_after(60, hello_reply(link::kRefusedAssetRejected, kRuleNeedsMesh + part));
    CHECK(contains(said, ("by rule R" + std::to_string(909 + part)).c_str()));
    CHECK(contains(said, (std::string("it needs part `") + part_name(part) + "`,").c_str()));
    CHECK(contains(said, "build the program with it (FIRMTOUCH_APP), and flash it"));
    CHECK(!contains(said, "bake"));
  }
  for (uint32_t rule = kRuleNoSuchSurface; rule < kRuleNeedsMesh; ++rule)
    CHECK(asset_remedy(rule) != asset_remedy(0));
  CHECK(contains(said_after(60, hello_reply(link::kRefusedAssetRejected, 201)),
                 "asset: it is damaged or of another release; bake it again"));
}

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

// A log with a number that is not above the one before cannot be read.
TEST(QueuedRecords_DoubledOrLateRecord_IsLeftOut) {
  QueuedRecords records(4, 8);
  const uint8_t numbers[] = {7, 8, 8, 10, 9, 11};
  for (const uint8_t number : numbers) {
    const uint8_t record[] = {number, 0, 0, 0};
    const bool is_late = records.produced() > number;
    CHECK_EQ(records.push(record), !is_late);
  }
  CHECK_EQ(records.waiting(), 4u);
  CHECK_EQ(records.produced(), 12u);
  CHECK_EQ(log::word(records.ready().data(), 8), 10u);
}

}  // namespace firmtouch::host_sim
