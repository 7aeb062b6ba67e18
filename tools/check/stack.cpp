// Worst-case stack of a program, from the call graphs that the compiler writes next to its object
// files (gcc -fcallgraph-info=su,da). Rejects recursion, frames without a bound and indirect calls
// without a name. See `stack --help`.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

const char kHelp[] =
    "stack [OPTION]... FILE.ci...\n"
    "Joins call graphs of gcc -fcallgraph-info=su,da; prints the worst path of each root with its "
    "bytes of stack.\n"
    "Functions are named as in the source (firmtouch::mesh::closest_point) or as the linker names "
    "them; there a\n"
    "* stands for any text (_GLOBAL__sub_I_* are the constructors of a file's variables).\n"
    "  --root NAME            a function that is not begun by a call: main, reset. Default: all "
    "functions are checked,\n"
    "                         no path is printed\n"
    "  --interrupt NAME       a root that may come on top of the others; its exception frame is "
    "added (108 bytes)\n"
    "  --without NAME         a function that is not called in this phase of the program\n"
    "  --calls CALLER=CALLEE  what the indirect calls of CALLER reach (again for several); a "
    "pattern of "
    "callees leaves out\n"
    "                         those that call CALLER\n"
    "  --size NAME=BYTES      stack of a function without a graph (libgcc, assembly)\n"
    "  --limit BYTES          size of the stack: exit 1 if the sum of all roots is larger\n"
    "Exit 1: recursion, a frame of unknown size (alloca, variable-length array), an indirect call "
    "without --calls,\n"
    "a function without a size, more than --limit. Exit 2: usage. Exit 3: a file that cannot be "
    "read.\n";

constexpr uint32_t kExceptionFrame_bytes =
    108;  // with floating-point registers, and 4 to align it (ARM DDI 0403)
const char kIndirect[] = "__indirect_call";

struct Function {
  std::string source_name;  // as the compiler prints it; empty: only called here, defined elsewhere
  std::string place;
  bool is_defined = false;
  bool is_unbounded = false;
  uint32_t own_bytes = 0;
  std::set<std::string> calls;
};

using Graph = std::map<std::string, Function>;

struct Problems {
  uint32_t count = 0;
  void say(const std::string& text) {
    ++count;
    std::fprintf(stderr, "stack: %s\n", text.c_str());
  }
};

std::string quoted(const std::string& line, const std::string& key) {
  const size_t at = line.find(key + ": \"");
  if (at == std::string::npos) return {};
  const size_t from = at + key.size() + 3;
  return line.substr(from, line.find('"', from) - from);
}

// A label: name \n place \n N bytes (static|dynamic|dynamic,bounded) \n N dynamic objects
void take_node(Graph& graph, const std::string& line) {
  Function& function = graph[quoted(line, "title")];
  const std::string label = quoted(line, "label");
  const size_t first = label.find("\\n");
  if (function.source_name.empty()) function.source_name = label.substr(0, first);
  const size_t bytes = label.find(" bytes (");
  if (bytes == std::string::npos) return;
  const size_t number = label.rfind("\\n", bytes) + 2;
  const uint32_t own_bytes =
      static_cast<uint32_t>(std::stoul(label.substr(number, bytes - number)));
  function.own_bytes = std::max(function.own_bytes, own_bytes);
  function.place = label.substr(first + 2, number - first - 4);
  function.is_defined = true;
  const size_t objects = label.rfind("\\n") + 2;
  if (label.compare(bytes, 14, " bytes (static") != 0 || label.compare(objects, 2, "0 ") != 0) {
    function.is_unbounded = true;
  }
}

bool read(Graph& graph, const char* path) {
  std::ifstream file(path);
  if (!file) return false;
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 5, "node:") == 0) take_node(graph, line);
    if (line.compare(0, 5, "edge:") == 0) {
      const std::string callee = quoted(line, "targetname");
      graph[callee];
      graph[quoted(line, "sourcename")].calls.insert(callee);
    }
  }
  return true;
}

bool matches(const char* text, const char* pattern) {
  if (*pattern == '*')
    return matches(text, pattern + 1) || (*text != 0 && matches(text + 1, pattern));
  return *text == *pattern && (*text == 0 || matches(text + 1, pattern + 1));
}

// By the linker's name, or by the source's up to its parameters.
bool is_named(const std::string& title, const Function& function, const std::string& name) {
  if (title == name) return true;
  if (name.find('*') != std::string::npos)  // a local function's title is `file:name`
    return matches(title.c_str() + title.rfind(':') + 1, name.c_str());
  const std::string& text = function.source_name;
  for (size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const size_t end = at + name.size();
    const bool starts =
        at == 0 || text[at - 1] == ' ' || text[at - 1] == '*' || text[at - 1] == '&';
    if (starts && (end == text.size() || text[end] == '(')) return true;
  }
  return false;
}

std::vector<std::string> find(const Graph& graph, const std::string& name) {
  std::vector<std::string> titles;
  for (const auto& [title, function] : graph) {
    if (function.is_defined && is_named(title, function, name)) titles.push_back(title);
  }
  return titles;
}

std::string shown(const Graph& graph, const std::string& title) {
  const Function& function = graph.at(title);
  std::string name = function.source_name.empty() ? title : function.source_name;
  name = name.substr(0, name.find('('));
  return name.substr(name.rfind(' ') == std::string::npos ? 0 : name.rfind(' ') + 1);
}

/// Worst path below each function: depth first, with an explicit stack, each function once.
class Traversal {
 public:
  Traversal(const Graph& graph, Problems& problems) : graph_(graph), problems_(problems) {}

  uint32_t worst_bytes(const std::string& title) {
    if (done_.count(title) == 0) visit(title);
    return done_.at(title).bytes;
  }
  void print_path(const std::string& title) {
    for (std::string at = title; !at.empty(); at = done_.at(at).next) {
      std::printf("  %6u  %s\n", graph_.at(at).own_bytes, shown(graph_, at).c_str());
    }
  }

 private:
  struct Worst {
    uint32_t bytes = 0;
    std::string next;
  };
  struct Open {
    std::string title;
    std::set<std::string>::const_iterator call;
    Worst worst;
  };

  void visit(const std::string& root) {
    std::vector<Open> open;
    std::set<std::string> on_path;
    const auto enter = [&](const std::string& title) {
      open.push_back({title, graph_.at(title).calls.begin(), {}});
      on_path.insert(title);
    };
    enter(root);
    while (!open.empty()) {
      Open& top = open.back();
      const Function& function = graph_.at(top.title);
      if (top.call == function.calls.end()) {
        done_[top.title] = {top.worst.bytes + function.own_bytes, top.worst.next};
        on_path.erase(top.title);
        open.pop_back();
        continue;
      }
      const std::string& callee = *top.call;
      if (callee == kIndirect) {
        ++top.call;
      } else if (on_path.count(callee) != 0) {
        report_cycle(open, callee);
        ++top.call;
      } else if (done_.count(callee) == 0) {
        enter(callee);
      } else {
        const uint32_t bytes = done_.at(callee).bytes;
        if (bytes > top.worst.bytes || top.worst.next.empty()) top.worst = {bytes, callee};
        ++top.call;
      }
    }
  }

  void report_cycle(const std::vector<Open>& open, const std::string& callee) {
    std::string text = "recursion: ";
    bool inside = false;
    for (const Open& frame : open) {
      inside = inside || frame.title == callee;
      if (inside) text += shown(graph_, frame.title) + " -> ";
    }
    problems_.say(text + shown(graph_, callee) + ": make it a loop over a fixed array");
  }

  const Graph& graph_;
  Problems& problems_;
  std::map<std::string, Worst> done_;
};

struct Options {
  std::vector<std::string> roots, interrupts, without, files;
  std::vector<std::pair<std::string, std::string>> calls, sizes;
  uint32_t limit_bytes = UINT32_MAX;
};

bool split(const std::string& text, std::vector<std::pair<std::string, std::string>>& pairs) {
  const size_t at = text.find('=');
  if (at == std::string::npos) return false;
  pairs.emplace_back(text.substr(0, at), text.substr(at + 1));
  return true;
}

bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.compare(0, 2, "--") != 0) {
      options.files.push_back(word);
      continue;
    }
    if (++i == argc) return false;
    const std::string value = argv[i];
    if (word == "--root") {
      options.roots.push_back(value);
    } else if (word == "--interrupt") {
      options.interrupts.push_back(value);
    } else if (word == "--without") {
      options.without.push_back(value);
    } else if (word == "--limit") {
      options.limit_bytes = static_cast<uint32_t>(std::strtoul(argv[i], nullptr, 10));
    } else if (word == "--calls" || word == "--size") {
      if (!split(value, word == "--calls" ? options.calls : options.sizes)) return false;
    } else {
      return false;
    }
  }
  return !options.files.empty();
}

void bind_calls(Graph& graph, const Options& options, Problems& problems) {
  for (const auto& [caller, callee] : options.calls) {
    const std::vector<std::string> callers = find(graph, caller), callees = find(graph, callee);
    const bool is_pattern = callee.find('*') != std::string::npos;
    if (callers.empty() || callees.empty()) {
      problems.say("--calls " + caller + "=" + callee + ": no such function: mend the name");
    }
    for (const std::string& from : callers) {
      graph[from].calls.erase(kIndirect);
      for (const std::string& to : callees)  // a pattern may match the caller's own caller
        if (!is_pattern || graph[to].calls.count(from) == 0) graph[from].calls.insert(to);
    }
  }
}

// The compiler calls a constructor or destructor by its "complete" name, C1 or D1, and where both
// are the same code defines only the "base" one, C2 or D2 (Itanium C++ ABI, 5.1.4.3).
void bind_constructors(Graph& graph) {
  for (auto& [title, function] : graph) {
    if (function.is_defined || title == kIndirect) continue;
    for (const char* kind : {"C1E", "D1E"}) {
      const size_t at = title.rfind(kind);
      if (at == std::string::npos) continue;
      std::string base = title;
      base[at + 1] = '2';
      const auto found = graph.find(base);
      if (found == graph.end() || !found->second.is_defined) continue;
      function.is_defined = true;
      function.own_bytes = 0;
      function.calls = {base};
    }
  }
}

// A weak function is titled `file:name` where it is defined and `name` where it is called.
void bind_weak(Graph& graph) {
  std::map<std::string, std::set<std::string>> definitions;
  for (const auto& [title, function] : graph) {
    const size_t colon = title.rfind(':');
    if (function.is_defined && colon != std::string::npos)
      definitions[title.substr(colon + 1)].insert(title);
  }
  for (auto& [title, function] : graph) {
    const auto found = definitions.find(title);
    if (function.is_defined || found == definitions.end()) continue;
    function.is_defined = true;
    function.calls = found->second;
  }
}

void leave_out(Graph& graph, const Options& options, Problems& problems) {
  for (const std::string& name : options.without) {
    const std::vector<std::string> titles = find(graph, name);
    if (titles.empty()) problems.say("--without " + name + ": no such function: mend the name");
    for (const std::string& title : titles) {
      graph[title].calls.clear();
      graph[title].own_bytes = 0;
    }
  }
}

void bind_sizes(Graph& graph, const Options& options) {
  for (auto& [title, function] : graph) {
    if (function.is_defined) continue;
    for (const auto& [name, bytes] : options.sizes) {
      const bool any = !name.empty() && name.back() == '*';
      if (any ? title.compare(0, name.size() - 1, name, 0, name.size() - 1) == 0 : title == name) {
        function.is_defined = true;
        function.own_bytes = static_cast<uint32_t>(std::stoul(bytes));
      }
    }
  }
}

void check_functions(const Graph& graph, Problems& problems) {
  for (const auto& [title, function] : graph) {
    if (title == kIndirect) continue;
    const std::string name = shown(graph, title);
    if (!function.is_defined) {
      problems.say(name + ": called, but its stack is unknown: give its .ci file, or --size");
    }
    if (function.is_unbounded) {
      problems.say(name + " at " + function.place +
                   ": a frame without a bound: use an array of fixed size");
    }
    if (function.calls.count(kIndirect) != 0) {
      problems.say(name + " at " + function.place +
                   ": an indirect call: name its callees with --calls");
    }
  }
}

uint32_t print_root(const Graph& graph, Traversal& paths, const std::string& name,
                    uint32_t extra_bytes, Problems& problems) {
  const std::vector<std::string> titles = find(graph, name);
  if (titles.empty()) problems.say("no function " + name + ": mend the name of the root");
  uint32_t worst_bytes = 0;
  for (const std::string& title : titles) {
    const uint32_t bytes = paths.worst_bytes(title) + extra_bytes;
    worst_bytes = std::max(worst_bytes, bytes);
    std::printf("%8u  from %s%s\n", bytes, name.c_str(),
                extra_bytes != 0 ? ", exception frame included" : "");
    paths.print_path(title);
  }
  return worst_bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") return std::fputs(kHelp, stdout), 0;
  Options options;
  if (!parse(argc, argv, options)) return std::fputs(kHelp, stderr), 2;
  Graph graph;
  for (const std::string& path : options.files) {
    if (!read(graph, path.c_str()))
      return std::fprintf(stderr, "stack: cannot read %s\n", path.c_str()), 3;
  }
  Problems problems;
  graph[kIndirect];
  bind_constructors(graph);
  bind_weak(graph);
  bind_calls(graph, options, problems);
  leave_out(graph, options, problems);
  bind_sizes(graph, options);
  check_functions(graph, problems);
  Traversal paths(graph, problems);
  for (const auto& [title, function] : graph) paths.worst_bytes(title);

  uint32_t sum_bytes = 0;
  for (const std::string& name : options.roots)
    sum_bytes += print_root(graph, paths, name, 0, problems);
  for (const std::string& name : options.interrupts) {
    sum_bytes += print_root(graph, paths, name, kExceptionFrame_bytes, problems);
  }
  if (!options.roots.empty()) std::printf("%8u  bytes of stack at worst\n", sum_bytes);
  if (sum_bytes > options.limit_bytes) {
    problems.say("more than the limit of " + std::to_string(options.limit_bytes) + " bytes");
  }
  return problems.count == 0 ? 0 : 1;
}
