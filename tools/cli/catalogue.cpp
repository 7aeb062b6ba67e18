#include "cli/catalogue.hpp"

#include <cstdio>
#include <map>
#include <new>
#include <optional>
#include <sstream>

#include "batch/parallel.hpp"
#include "batch/results.hpp"
#include "cli/baked_asset.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/files.hpp"
#include "cli/progress.hpp"
#include "cli/version.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/core/hash.hpp"

namespace firmtouch::cli {
namespace {

constexpr uint32_t kMaxJobs = 1024;
constexpr const char* kHeader = "result,asset,bytes,crc,why";
constexpr const char *kBaked = "baked", *kRefused = "refused";

// The words of a line; "a b" is one. A word that begins with # begins a comment.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  bool is_quoted = false, is_in_word = false;
  for (const char c : line) {
    if (c == '"') {
      if (!is_in_word) words.emplace_back();
      is_quoted = !is_quoted;
      is_in_word = true;
    } else if (!is_quoted && (c == ' ' || c == '\t' || c == '\r')) {
      is_in_word = false;
    } else if (!is_in_word && c == '#') {
      break;
    } else {
      if (!is_in_word) words.emplace_back();
      words.back() += c;
      is_in_word = true;
    }
  }
  if (is_quoted) fail_usage("a \" has no end");
  return words;
}

// What a line says; none where an input of it is bad, which is a matter of its row.
std::optional<BakeRequest> request_of(const Arguments& line) {
  try {
    return bake_request(line);
  } catch (const Failure& failure) {
    if (failure.exit_code == kUsage) throw;
  }
  return {};
}

Arguments read_line(const std::string& text) {
  const Arguments line(bake_command(), words_of(text));
  if (line.text("-o", "").empty()) fail_usage("say where to write: -o SCENE.fta");
  if (line.text("-o", "") == "-") fail_usage("-o - is no file");
  for (const char* const option : {"--catalogue", "--shard", "--jobs", "--json", "--cpp"})
    if (line.has(option)) fail_usage(std::string(option) + " is not for a line of a catalogue");
  if (line.positionals().empty()) fail_usage("something to bake is missing");
  return line;
}

struct Catalogue {
  std::vector<Arguments> lines;
  core::Hash hash;  // of what the lines say, and of this program
};

Catalogue read_catalogue(const std::string& path) {
  const std::vector<uint8_t> bytes = read_file(path);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  Catalogue catalogue;
  std::map<std::string, int> outputs;
  std::string line;
  for (const char c : std::string(kToolVersion)) catalogue.hash.add(static_cast<unsigned char>(c));
  for (int number = 1; std::getline(text, line); ++number) {
    try {
      if (words_of(line).empty()) continue;
      catalogue.lines.push_back(read_line(line));
      const std::string output = catalogue.lines.back().text("-o", "");
      if (const auto added = outputs.emplace(output, number); !added.second)
        fail_usage(output + " is written by line " + std::to_string(added.first->second) + ", too");
      if (const auto request = request_of(catalogue.lines.back()))
        for (const std::string& file : request->files()) forbid_overwriting(output, file);
    } catch (const Failure& failure) {
      throw Failure{failure.exit_code,
                    path + ":" + std::to_string(number) + ": " + failure.message};
    }
    for (const char c : line + "\n") catalogue.hash.add(static_cast<unsigned char>(c));
  }
  if (catalogue.lines.empty()) fail_input(path + ": it has no line; write INPUT... -o SCENE.fta");
  return catalogue;
}

std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? "\"\"" : std::string(1, c == '\n' ? ' ' : c);
  return all + "\"";
}

// An output that cannot be written ends the batch: that is no matter of the model.
std::string row_of(const Arguments& line) {
  const std::string output = line.text("-o", "");
  const auto refused = [&](const std::string& why) {
    return std::string(kRefused) + "," + quoted(output) + ",0,," + quoted(why);
  };
  BakedAsset baked;
  try {
    BakeRequest request = bake_request(line);
    request.options.is_quiet = true;
    baked = bake_asset(std::move(request), output);
  } catch (const Failure& failure) {
    return refused(failure.message);
  } catch (const std::bad_alloc&) {
    return refused("not enough memory for it");
  }
  write_file(output, baked.bytes.data(), baked.bytes.size());
  asset::Container container;
  (void)asset::open({baked.bytes.data(), static_cast<uint32_t>(baked.bytes.size())}, container);
  char crc[16];
  std::snprintf(crc, sizeof crc, "%08x", container.crc());
  return std::string(kBaked) + "," + quoted(output) + "," + std::to_string(baked.bytes.size()) +
         "," + crc + ",";
}

// Of the rows of a whole file.
uint64_t count_refused(const std::string& path) {
  const std::vector<uint8_t> bytes = read_file(path);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  uint64_t count = 0;
  for (std::string row; std::getline(text, row);) {
    size_t at = 0;
    for (int column = 0; column < 3; ++column) at = row.find(',', at) + 1;
    count += row.compare(at, 8, std::string(kRefused) + ",") == 0 ? 1u : 0u;
  }
  return count;
}

}  // namespace

int bake_catalogue(const Arguments& arguments) {
  const std::string list = arguments.text("--catalogue", ""), path = arguments.text("-o", "");
  if (path.empty() || path == "-")
    fail_usage("bake: say where to write the results: -o RESULTS.csv");
  for (const Option& option : bake_command().options) {
    const std::string name = option.name;
    const bool is_ours =
        name == "--catalogue" || name == "-o" || name == "--shard" || name == "--jobs";
    if (arguments.has(name) && !is_ours)
      fail_usage("bake: with --catalogue " + name + " stands in its lines, not here");
  }
  if (!arguments.positionals().empty())
    fail_usage("bake: with --catalogue what to bake stands in its lines, not here");
  forbid_overwriting(path, list);
  const tools::Shard shard =
      arguments.has("--shard") ? tools::shard_of(arguments.text("--shard", "")) : tools::Shard{};
  const uint32_t jobs = arguments.count("--jobs", tools::processors(), 1, kMaxJobs);
  const Catalogue catalogue = read_catalogue(list);
  const tools::BatchIdentity batch{catalogue.lines.size(), catalogue.hash.value()};
  uint64_t count = 0;
  {
    tools::BatchResults results(path, kHeader, batch, shard);
    const uint64_t had = results.had();
    count = shard.runs(batch.runs);
    if (had > 0)
      std::fprintf(stderr, "%s: has %llu of %llu assets; going on\n", path.c_str(),
                   static_cast<unsigned long long>(had), static_cast<unsigned long long>(count));
    Progress progress(static_cast<double>(count - had));
    tools::in_parallel(
        count - had, jobs,
        [&](uint64_t i) { results.add(had + i, row_of(catalogue.lines[shard.run(had + i)])); },
        [&, done = had](double) mutable {
          progress.stage(std::to_string(++done) + " of " + std::to_string(count) + " assets");
        });
  }
  const uint64_t refused = count_refused(path);
  std::fprintf(stderr, "%s: %llu assets, %llu of them refused\n", path.c_str(),
               static_cast<unsigned long long>(count), static_cast<unsigned long long>(refused));
  return refused == 0 ? kDone : kAnswerIsNo;
}

}  // namespace firmtouch::cli
