#include "bake/objects/clauses.hpp"

#include <cstring>
#include <set>

namespace firmtouch::tools {

std::string read_name(LineReader& words, const char* what, char (&to)[scene::kNameBytes]) {
  const std::string name = words.next(what);
  if (name.size() >= scene::kNameBytes)
    words.refuse("`" + name + "` is longer than " + std::to_string(scene::kNameBytes - 1) +
                 " bytes; shorten the name");
  std::memcpy(to, name.c_str(), name.size());
  if (!scene::is_name(to)) words.refuse("`" + name + "` has a control character; use letters");
  return name;
}

void read_clauses(LineReader& words, const std::function<void(const std::string& word)>& read) {
  std::set<std::string> given;
  while (words.more()) {
    const std::string word = words.next("a word");
    if (!given.insert(word).second) words.refuse("`" + word + "` is given twice; keep one");
    read(word);
  }
}

void read_friction(LineReader& words, float most, float& at_rest, float& sliding) {
  at_rest = static_cast<float>(words.quantity("friction", "", 0, double{most}));
  sliding = words.take("sliding")
                ? static_cast<float>(words.quantity("sliding", "", 0, double{most}))
                : at_rest;
}

}  // namespace firmtouch::tools
