#include "firmtouch/link/handshake.hpp"

#include "firmtouch/link/text_writer.hpp"

namespace firmtouch::link {
namespace {

constexpr char kSameSources[] = "use the same sources and parts";

void add_difference(TextWriter& out, const char* what, uint64_t host, uint64_t controller,
                    uint32_t digits, const char* remedy) {
  out.text(what).text(": host ").hex(host, digits).text(", controller ").hex(controller, digits);
  out.text(": ").text(remedy).text("\n");
}

}  // namespace

uint32_t compare(const Identity& host, const Identity& controller) {
  if (host.protocol != controller.protocol) return kRefusedProtocol;
  uint32_t refused = 0;
  if (host.asset_crc != controller.asset_crc) refused |= kRefusedAsset;
  if (host.parameter_table_hash != controller.parameter_table_hash)
    refused |= kRefusedParameterTable;
  if (host.build_id != controller.build_id) refused |= kRefusedBuild;
  return refused;
}

uint32_t explain(const Identity& host, const HelloReply& reply, core::Span<char> to) {
  TextWriter out(to);
  const Identity& controller = reply.controller;
  if ((reply.refused & kRefusedProtocol) != 0) {
    out.text("protocol version: host ").decimal(host.protocol).text(", controller ");
    out.decimal(controller.protocol).text(": build both from the same release\n");
  }
  if ((reply.refused & kRefusedNotReady) != 0) {
    out.text("asset: it is still being checked: try again\n");
  }
  if ((reply.refused & kRefusedAssetRejected) != 0) {
    out.text("asset: the controller rejects it by rule R").decimal(reply.asset_rule);
    out.text(" at element ").decimal(reply.asset_element);
    out.text(" (tools/FORMAT.md)\n");
  }
  if ((reply.refused & kRefusedAsset) != 0) {
    add_difference(out, "asset CRC", host.asset_crc, controller.asset_crc, 8,
                   "load the same .fta file on both");
  }
  if ((reply.refused & kRefusedParameterTable) != 0) {
    add_difference(out, "parameter table hash", host.parameter_table_hash,
                   controller.parameter_table_hash, 16, kSameSources);
  }
  if ((reply.refused & kRefusedBuild) != 0) {
    add_difference(out, "build id", host.build_id, controller.build_id, 16, kSameSources);
  }
  if ((reply.refused & kRefusedMode) != 0) {
    out.text("mode: unknown to the controller: build both from the same release\n");
  }
  if ((reply.refused & kRefusedBusy) != 0) {
    out.text("lock-step: the servo runs already: reset it with the enable switch open\n");
  }
  return out.size();
}

}  // namespace firmtouch::link
