// Who is timed runs in turn; a peer's word is taken only where it says a time.
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "bench/models.hpp"
#include "bench/peer.hpp"
#include "bench/problem.hpp"
#include "bench/timing.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch::bench;  // NOLINT: a test file

std::string problem_of(const std::string& command) {
  try {
    (void)Peer(command).us_per_query("closest", "a b.obj", "p.csv");
  } catch (const Problem& problem) {
    return problem.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST(ContendersAlternate_MedianIsReported) {
  std::string order;
  double a = 0;
  const double b[] = {5, 1, 100, 3, 2};
  size_t next = 0;
  const std::vector<double> us =
      medians_us({[&] { return order += 'a', ++a; }, [&] { return order += 'b', b[next++]; }});
  CHECK(order == "ababababab");
  CHECK_EQ(us.size(), size_t{2});
  CHECK_EQ(us[0], 3.0);
  CHECK_EQ(us[1], 3.0);
}

TEST(TimeIsOfOneQuery) {
  int passes = 0;
  const auto work = [&] {
    ++passes;
    double sum = 0;
    for (int i = 0; i < 1000000; ++i) sum += static_cast<double>(i) * 0.5;
    return sum;
  };
  const std::vector<double> us = medians_us({timed(1, work), timed(1000, work)});
  CHECK_EQ(passes, 10);
  CHECK(us[0] > 0);
  CHECK(us[1] < us[0] / 50);  // a thousandth; the machine may be busy
}

TEST(TimeIsTheProcessors_WaitingIsNotCounted) {
  const double us = timed(1, [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return 0.0;
  })();
  CHECK(us < 100e3);
}

TEST(PeerGetsKindFileAndPoints) {
  CHECK(!Peer("").is_present());
  CHECK(Peer("true").is_present());
  const Peer echo(
      "f() { [ \"$1-$2-$3\" = \"closest-it's a model.obj-p q.csv\" ] && "
      "echo warm us_per_query 0.125 queries 9; }; f");
  CHECK_EQ(echo.us_per_query("closest", "it's a model.obj", "p q.csv"), 0.125);
  const Peer warm("f() { [ $# = 4 ] && [ \"$4\" = --warm ] && echo us_per_query 0.25; }; f");
  CHECK_EQ(warm.us_per_query("closest", "a.obj", "p.csv", "--warm"), 0.25);
}

TEST(APeerThatFailsIsNamedWithItsStatus) {
  const std::string failed = problem_of("exit 7;");
  CHECK(holds(failed, "exit code 7") && holds(failed, "'a b.obj'") && holds(failed, "--peer"));
  CHECK(holds(problem_of("kill -9 $$;"), "signal 9"));
  CHECK(holds(problem_of("echo"), "us_per_query"));
  CHECK(holds(problem_of("echo us_per_query nan;:"), "us_per_query"));
  CHECK(holds(problem_of("echo us_per_query 0;:"), "us_per_query"));
  CHECK(holds(problem_of("no_such_program_here 2>/dev/null"), "exit code 127"));
}
