#include "firmtouch/link/command_mailbox.hpp"

#include "harness/test.hpp"

namespace firmtouch::link {
namespace {

TEST(CommandMailbox_OneCommandPerTick_InOrder) {
  CommandMailbox mailbox;
  record::TickInput input{};
  input.command = 99;
  mailbox.take(input);
  CHECK_EQ(input.command, 0u);
  CHECK(mailbox.put(0, 1.5f));
  CHECK(mailbox.put(4, 2.5f));
  mailbox.take(input);
  CHECK_EQ(input.command, 1u);
  CHECK_EQ(input.command_value, 1.5f);
  mailbox.take(input);
  CHECK_EQ(input.command, 5u);
  CHECK_EQ(input.command_value, 2.5f);
  mailbox.take(input);
  CHECK_EQ(input.command, 0u);
  CHECK_EQ(input.command_value, 0.0f);
}

TEST(CommandMailbox_ClearFaults_KeepsOrder) {
  CommandMailbox mailbox;
  record::TickInput input{};
  CHECK(mailbox.put(3, 1.5f));
  CHECK(mailbox.put_clear_faults());
  mailbox.take(input);
  CHECK_EQ(input.command, 4u);
  mailbox.take(input);
  CHECK_EQ(input.command, record::kCommandClearFaults);
  mailbox.take(input);
  CHECK_EQ(input.command, record::kCommandNone);
}

TEST(CommandMailbox_Full_RejectsAndKeepsItsCommands) {
  CommandMailbox mailbox;
  for (uint32_t i = 0; i < CommandMailbox::kCapacity; ++i) CHECK(mailbox.put(i, 0));
  CHECK(!mailbox.put(100, 0));
  record::TickInput input{};
  for (uint32_t i = 0; i < CommandMailbox::kCapacity; ++i) {
    mailbox.take(input);
    CHECK_EQ(input.command, i + 1);
  }
  CHECK(mailbox.put(100, 0));
}

}  // namespace
}  // namespace firmtouch::link
