// tools/FORMAT.md lists every reject rule of the firmware once, and no other. Where a layout header
// has an `enum Rule`, number, name and text agree too.
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

/// Name and text of a rule.
struct Line {
  std::string name, text;
};

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Enumerators `kRuleName = number,` of every `enum ...Rule`: the text is the comment above, which
// may take several lines, or the one behind.
std::map<int, Line> lines_of_header(const std::string& header) {
  static const std::regex kEnumerator(R"(^\s*kRule(\w+) = (\d+),\s*(?://(.*))?$)");
  std::map<int, Line> lines;
  std::istringstream rows(header);
  std::string above;
  bool is_inside = false;
  for (std::string row; std::getline(rows, row);) {
    const std::string words = trimmed(row);
    std::smatch found;
    if (words.rfind("enum ", 0) == 0 && words.find("Rule ") != std::string::npos) {
      is_inside = true;
      above.clear();
    } else if (words.rfind("};", 0) == 0) {
      is_inside = false;
    } else if (words.rfind("//", 0) == 0) {
      above += (above.empty() ? "" : " ") + trimmed(words.substr(2));
    } else if (is_inside && std::regex_match(row, found, kEnumerator)) {
      lines[std::stoi(found[2])] = {found[1], above.empty() ? trimmed(found[3]) : above};
      above.clear();
    }
  }
  return lines;
}

std::map<int, Line> lines_of_page(const std::string& page) {
  static const std::regex kRow(R"(\| R(\d+) \| ([^|\n]*) \| ([^|\n]*) \|)");
  std::map<int, Line> lines;
  for (std::sregex_iterator at(page.begin(), page.end(), kRow), end; at != end; ++at)
    lines[std::stoi((*at)[1])] = {(*at)[2], (*at)[3]};
  return lines;
}

// Rules of a header whose name or text differs on the page.
std::set<int> other_words(const std::map<int, Line>& header, const std::map<int, Line>& page) {
  std::set<int> wrong;
  for (const auto& [number, line] : header) {
    const auto at = page.find(number);
    if (at == page.end() || at->second.name != line.name || at->second.text != line.text)
      wrong.insert(number);
  }
  return wrong;
}

// Rules missing on either side, or listed more than once on the page.
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

TEST(FormatPage_ListsEveryRuleOnce) {
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

TEST(FormatPage_StatesNameAndTextOfEveryEnumerator) {
  const std::map<int, Line> page = lines_of_page(text_of(kRoot / "tools" / "FORMAT.md"));
  uint32_t rules = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "firmware")) {
    if (entry.path().extension() != ".hpp") continue;
    const std::map<int, Line> header = lines_of_header(text_of(entry.path()));
    const std::set<int> wrong = other_words(header, page);
    if (!wrong.empty())
      firmtouch::test::note("first with another name or text: rule", *wrong.begin());
    CHECK_EQ(wrong.size(), 0u);
    rules += static_cast<uint32_t>(header.size());
  }
  CHECK_GE(rules, 100u);
}

TEST(OtherNameOrText_IsFound) {
  const std::map<int, Line> header = lines_of_header(
      "enum Rule : uint16_t {\n  // A head\n  // is bent.\n  kRuleBent = 901,\n"
      "  kRuleShort = 902,  // It is short.\n};\n");
  CHECK_EQ(header.size(), 2u);
  const char* const good = "| R901 | Bent | A head is bent. | |\n| R902 | Short | It is short. | |";
  CHECK(other_words(header, lines_of_page(good)).empty());
  CHECK(other_words(header, lines_of_page("| R901 | Bent | A head is bent. | |")) ==
        std::set<int>{902});
  CHECK(other_words(header, lines_of_page(
                                "| R901 | Bent | A head. | |\n| R902 | Long | It is short. | |")) ==
        (std::set<int>{901, 902}));
}

TEST(MissingRuleAndSurplusRow_AreFound) {
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
