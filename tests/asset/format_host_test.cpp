// Every rule that the firmware rejects by stands in tools/FORMAT.md exactly once, and the other way
// round.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "harness/test.hpp"

namespace {

const std::filesystem::path kRoot = FIRMTOUCH_ROOT;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void find_all(const std::string& text, const char* pattern, std::map<int, int>& counts) {
  const std::regex rule(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), rule), end; at != end; ++at) {
    ++counts[std::stoi((*at)[1])];
  }
}

std::map<int, int> rules_of_sources(const std::string& text) {
  std::map<int, int> rules;
  find_all(text, R"(\b(?:reject|fail)\(\s*(\d+))", rules);
  find_all(text, R"(\bkRule\w+\s*=\s*(\d+))", rules);
  return rules;
}

std::map<int, int> rules_of_page(const std::string& text) {
  std::map<int, int> rules;
  find_all(text, R"(\| R(\d+) \|)", rules);
  return rules;
}

// Rules missing on either side, or told more than once by the page.
std::set<int> differences(const std::map<int, int>& used, const std::map<int, int>& reported) {
  std::set<int> wrong;
  for (const auto& rule : used) {
    if (reported.count(rule.first) == 0) wrong.insert(rule.first);
  }
  for (const auto& rule : reported) {
    if (used.count(rule.first) == 0 || rule.second != 1) wrong.insert(rule.first);
  }
  return wrong;
}

}  // namespace

TEST(EveryRuleOfTheFirmwareStandsInTheFormatPageOnce) {
  std::string sources;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "firmware")) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".cpp" || extension == ".hpp") sources += text_of(entry.path());
  }
  const std::map<int, int> used = rules_of_sources(sources);
  const std::map<int, int> reported = rules_of_page(text_of(kRoot / "tools" / "FORMAT.md"));
  CHECK_GE(used.size(), 60u);
  const std::set<int> wrong = differences(used, reported);
  if (!wrong.empty()) firmtouch::test::note("first without its other half: rule", *wrong.begin());
  CHECK_EQ(wrong.size(), 0u);
}

TEST(ARuleWithoutItsLineAndALineWithoutItsRuleAreFound) {
  const std::map<int, int> used =
      rules_of_sources("return reject(1); fail(22, i); kRuleBent = 901;");
  CHECK_EQ(used.size(), 3u);
  CHECK(differences(used, rules_of_page("| R1 | a |\n| R22 | b |\n| R901 | c |")).empty());
  CHECK(differences(used, rules_of_page("| R1 | a |\n| R22 | b |")) == std::set<int>{901});
  CHECK(differences(used, rules_of_page("| R1 | a |\n| R22 | b |\n| R901 | c |\n| R3 | d |")) ==
        std::set<int>{3});
  CHECK(differences(used, rules_of_page("| R1 | a |\n| R22 | b |\n| R22 | b |\n| R901 | c |")) ==
        std::set<int>{22});
}
