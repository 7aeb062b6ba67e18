// What a sweep runs, and what is left of its results where it is killed.
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "batch/parallel.hpp"
#include "batch/results.hpp"
#include "harness/test.hpp"
#include "host_sim/sweep/plan.hpp"
#include "host_sim/trace/log.hpp"

namespace {

using namespace firmtouch::host_sim;  // NOLINT: a test file
using namespace firmtouch::tools;     // NOLINT

bool is_refused(const std::function<void()>& act) {
  try {
    act();
  } catch (const Refused&) {
    return true;
  }
  return false;
}

std::string place(const char* name) {
  return (std::filesystem::temp_directory_path() /
          ("firmtouch_sweep_" + std::to_string(::getpid()) + name))
      .string();
}

}  // namespace

TEST(Vary_NamesAKeyAndItsValues) {
  const Varied mass = varied_of("mass=60 g, 75 g,1 kg");
  CHECK(mass.key == "mass");
  CHECK(mass.values == (std::vector<std::string>{"60 g", "75 g", "1 kg"}));
  const Varied grip = varied_of("hand_stiffness=100..1000:4 N/m");
  CHECK(grip.values == (std::vector<std::string>{"100 N/m", "400 N/m", "700 N/m", "1000 N/m"}));
  CHECK(varied_of("friction_static=1..0:3").values == (std::vector<std::string>{"1", "0.5", "0"}));
  CHECK(varied_of("device=falcon_like").values.size() == 1);
  for (const char* const wrong : {"mass", "=1 g", "mass=", "mass=1 g,,2 g", "mass=1..2:1 g",
                                  "mass=1..2:0 g", "mass=nan..1:3", "mesh=\"a\""})
    CHECK(is_refused([&] { varied_of(wrong); }));
}

TEST(Combinations_TheLastChangesFirst_ShardsHaveEachOnce) {
  const std::vector<Varied> varied = {varied_of("a=1,2"), varied_of("b=x,y,z")};
  CHECK_EQ(combinations(varied), uint64_t{6});
  CHECK_EQ(combinations({}), uint64_t{1});
  CHECK(values_of(varied, 1) == (std::vector<std::string>{"1", "y"}));
  CHECK(values_of(varied, 5) == (std::vector<std::string>{"2", "z"}));
  CHECK(is_refused([] { combinations({varied_of("a=1..2:9999"), varied_of("b=1..2:9999")}); }));
  for (uint64_t of = 1; of <= 9; ++of) {
    std::vector<int> times(7);
    uint64_t all = 0;
    for (uint64_t i = 1; i <= of; ++i) {
      const Shard shard = shard_of(std::to_string(i) + "/" + std::to_string(of));
      all += shard.runs(7);
      for (uint64_t nth = 0; nth < shard.runs(7); ++nth) ++times[shard.run(nth)];
    }
    CHECK_EQ(all, uint64_t{7});
    for (const int n : times) CHECK_EQ(n, 1);
  }
  for (const char* const wrong : {"", "1", "0/3", "4/3", "1/0", "-1/2", "1/2/3", "a/b", "1/ 2"})
    CHECK(is_refused([&] { shard_of(wrong); }));
}

// Rows that end in any order; killed behind every byte; in shards: always the same bytes.
TEST(Results_AreTheSameBytes_KilledAnywhere_AndMerged) {
  const BatchIdentity sweep{5, 0xABCDEF0123456789ull};
  const std::string path = place("whole.csv"), part = place("part.csv");
  std::filesystem::remove(path);
  const auto row = [](uint64_t run) { return std::to_string(run * run) + ",0.5"; };
  {
    BatchResults results(path, "a,b", sweep, {});
    CHECK(is_refused([&] { BatchResults(path, "a,b", sweep, {}); }));  // two at once
    for (const uint64_t run : {2u, 0u, 4u, 1u, 3u}) results.add(run, row(run));
  }
  const std::string whole = read_file(path);
  CHECK(whole.substr(0, 57) == "run,runs,batch,a,b\n0,5,abcdef0123456789,0,0.5\n1,5,abcdef0");
  for (size_t bytes = 0; bytes <= whole.size(); ++bytes) {
    write_file(part, whole.substr(0, bytes));
    {
      BatchResults results(part, "a,b", sweep, {});
      for (uint64_t run = results.had(); run < 5; ++run) results.add(run, row(run));
    }
    CHECK(read_file(part) == whole);
  }
  std::vector<std::pair<std::string, std::string>> files;
  for (uint64_t i = 1; i <= 3; ++i) {
    std::filesystem::remove(part);
    BatchResults results(part, "a,b", sweep, {i, 3});
    for (uint64_t nth = 0; nth < Shard{i, 3}.runs(5); ++nth)
      results.add(nth, row(Shard{i, 3}.run(nth)));
    files.emplace_back("shard " + std::to_string(i), read_file(part));
  }
  CHECK(merged(files) == whole);
  CHECK(merged({{"whole", whole}}) == whole);
  CHECK(is_refused([&] { merged({files[0], files[1]}); }));            // a run is missing
  CHECK(is_refused([&] { merged({files[0], files[1], files[1]}); }));  // twice
  CHECK(is_refused([&] { merged({{"cut", whole.substr(0, 60)}}); }));
  CHECK(is_refused([&] { merged({{"no results", "x,y\n1,2\n"}}); }));
  CHECK(is_refused([&] { merged({{"empty", ""}}); }));
  // Another sweep, other columns, another shard.
  CHECK(is_refused([&] { BatchResults(path, "a,b", {5, 1}, {}); }));
  CHECK(is_refused([&] { BatchResults(path, "a,c", sweep, {}); }));
  CHECK(is_refused([&] { BatchResults(path, "a,b", sweep, {1, 2}); }));
  CHECK(is_refused([&] { BatchResults(path, "a,b", {4, sweep.hash}, {}); }));
  CHECK(read_file(path) == whole);
  std::filesystem::remove(path);
  std::filesystem::remove(part);
}

TEST(Parallel_EachOnce_AndWhatTheFirstThrew) {
  for (const uint32_t threads : {1u, 2u, 7u}) {
    std::vector<int> times(100);
    double share = 0;
    in_parallel(
        100, threads, [&](uint64_t i) { ++times[i]; }, [&](double done) { share = done; });
    CHECK_EQ(share, 1.0);
    for (const int n : times) CHECK_EQ(n, 1);
    CHECK(is_refused([&] {
      in_parallel(100, threads, [&](uint64_t i) {
        if (i == 50) throw Refused("50");
      });
    }));
  }
  in_parallel(0, 3, [](uint64_t) { throw Refused("none"); });
}
