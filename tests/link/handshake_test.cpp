#include "firmtouch/link/handshake.hpp"

#include "firmtouch/link/build_id.hpp"
#include "firmtouch/link/text_writer.hpp"
#include "harness/test.hpp"

namespace firmtouch::link {
namespace {

bool contains(const char* text, const char* part) {
  for (; *text != 0; ++text) {
    const char* a = text;
    const char* b = part;
    while (*b != 0 && *a == *b) ++a, ++b;
    if (*b == 0) return true;
  }
  return false;
}

Identity identity() {
  Identity made;
  made.asset_crc = 0x11112222u;
  made.parameter_table_hash = 0x3333444455556666ull;
  made.build_id = 0x777788889999AAAAull;
  return made;
}

TEST(Handshake_EqualIdentities_AreAccepted) {
  CHECK_EQ(compare(identity(), identity()), 0u);
  char text[64];
  CHECK_EQ(explain(identity(), HelloReply{}, text), 0u);
  CHECK_EQ(text[0], '\0');
}

TEST(Handshake_EachDifference_HasItsOwnBit) {
  Identity other = identity();
  other.asset_crc ^= 0x80000000u;
  CHECK_EQ(compare(identity(), other), kRefusedAsset);
  other = identity();
  other.parameter_table_hash ^= 1ull << 63;
  CHECK_EQ(compare(identity(), other), kRefusedParameterTable);
  other = identity();
  other.build_id ^= 1;
  CHECK_EQ(compare(identity(), other), kRefusedBuild);
  other.asset_crc = 0;
  CHECK_EQ(compare(identity(), other), kRefusedBuild | kRefusedAsset);
}

TEST(Handshake_OtherProtocol_IsTheOnlyReason) {
  Identity other = identity();
  other.protocol = kProtocolVersion + 1;
  other.asset_crc = 0;
  CHECK_EQ(compare(identity(), other), kRefusedProtocol);
  HelloReply reply;
  reply.refused = kRefusedProtocol;
  reply.controller = other;
  char text[256];
  explain(identity(), reply, text);
  CHECK(contains(text, "protocol version: host 7, controller 8"));
  CHECK(!contains(text, "asset"));
}

TEST(Handshake_RejectionText_HasBothValuesAndRemedy) {
  HelloReply reply;
  reply.controller = identity();
  Identity host = identity();
  host.asset_crc = 0xDEADBEEFu;
  host.parameter_table_hash = 0x0123456789ABCDEFull;
  host.build_id = 1;
  reply.refused = compare(host, reply.controller);
  char text[640];
  CHECK_LT(explain(host, reply, text), sizeof text - 1);
  CHECK(contains(
      text, "asset CRC: host 0xdeadbeef, controller 0x11112222: load the same .fta file on both"));
  CHECK(contains(text,
                 "parameter table hash: host 0x0123456789abcdef, controller 0x3333444455556666: "
                 "use the same sources and parts"));
  CHECK(contains(text,
                 "build id: host 0x0000000000000001, controller 0x777788889999aaaa: "
                 "use the same sources and parts"));
}

TEST(Handshake_RejectedAsset_ReportsRule) {
  HelloReply reply;
  reply.refused = kRefusedAssetRejected;
  reply.asset_rule = 17;
  reply.asset_element = 4294967295u;
  char text[200];
  explain(identity(), reply, text);
  CHECK(contains(text, "rule R17 at element 4294967295"));
}

TEST(Handshake_EveryReason_HasTextThatFits) {
  char text[1200];
  for (uint32_t bit = 0; bit < 8; ++bit) {
    HelloReply reply;
    reply.refused = 1u << bit;
    CHECK_GT(explain(identity(), reply, text), 20u);
  }
  HelloReply all;
  all.refused = 0xFFu;
  CHECK_LT(explain(identity(), all, text), sizeof text - 1);
}

TEST(TextWriter_TooLong_IsTruncatedAndTerminated) {
  char text[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  TextWriter out({text, 7});
  out.text("abc").decimal(4000000000u);
  CHECK_EQ(out.size(), 6u);
  CHECK_EQ(text[5], '0');
  CHECK_EQ(text[6], '\0');
  CHECK_EQ(text[7], 1);
}

TEST(BuildId_IsSet) {
  CHECK_NE(build_id(), 0ull);
  CHECK_EQ(build_id(), build_id());
}

}  // namespace
}  // namespace firmtouch::link
