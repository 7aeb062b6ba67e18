#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "host_sim/controllers/byte_stream.hpp"
#include "host_sim/scenario/scenario.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr int kStartPolls = 2000;  // 20 s: a loaded machine takes seconds to start an emulator
constexpr useconds_t kPoll_us = 10000;

struct Board {
  const char* name;
  const char* asset_address;  // of a flashed asset's slot (hal/BOARD/link.ld)
};
constexpr Board kBoards[] = {{"mps2-an500", "0x60000000"}, {"netduinoplus2", "0x08040000"}};

// Owns the emulator's process and the folder of its FIFOs.
class Emulator : public ByteStream {
 public:
  Emulator(std::string name, std::string folder, pid_t process)
      : ByteStream(-1, -1, std::move(name)), folder_(std::move(folder)), process_(process) {}
  ~Emulator() override {
    if (in_ >= 0) close(in_);
    if (out_ >= 0 && out_ != in_) close(out_);
    in_ = out_ = -1;
    if (process_ > 0) {
      kill(process_, SIGTERM);
      waitpid(process_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  void open_files();

 private:
  // Exit status and output of the emulator, for the message.
  std::string reason_closed() override {
    int status = 0;
    for (int i = 0; i < 50 && process_ > 0; ++i, usleep(kPoll_us))
      if (waitpid(process_, &status, WNOHANG) == process_) process_ = -1;
    std::string text =
        process_ > 0 ? ""
                     : " (the emulator ended with status " +
                           std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : 128) + ")";
    const int log = open((folder_ + "/log").c_str(), O_RDONLY | O_CLOEXEC);
    char said[400];
    const ssize_t count = log < 0 ? 0 : ::read(log, said, sizeof said);
    if (log >= 0) close(log);
    if (count > 0) text += ": " + std::string(said, static_cast<size_t>(count));
    return text;
  }
  void wait_a_little(const char* for_what) {
    if (process_ <= 0 || waitpid(process_, nullptr, WNOHANG) != 0) {
      process_ = -1;
      throw Refused(name_ + ": the emulator ended before " + for_what + reason_closed());
    }
    usleep(kPoll_us);
  }

  std::string folder_;
  pid_t process_;
};

// Same order as the board: link.in first, then link.out (hal/emulator/file_link.hpp).
void Emulator::open_files() {
  in_ = open((folder_ + "/link.out").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  for (int i = 0; i < kStartPolls && out_ < 0; ++i) {
    out_ = open((folder_ + "/link.in").c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (out_ < 0) wait_a_little("it opened its link");
  }
  if (out_ < 0) throw Refused(name_ + ": the program does not open its link; is it firmtouch_app?");
}

std::string escape_commas(const std::string& path) {
  std::string text;
  for (const char c : path) text += c == ',' ? ",," : std::string(1, c);
  return text;
}

pid_t start(const std::vector<std::string>& words, const std::string& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t process = fork();
  if (process != 0) return process;
  const int null = open("/dev/null", O_RDONLY);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(null, 0);
  dup2(out, 1);
  dup2(out, 2);
  execvp(arguments[0], arguments.data());
  const char kMissing[] =
      "qemu-system-arm is missing. On Debian and Ubuntu: apt-get install qemu-system-arm\n";
  if (::write(2, kMissing, sizeof kMissing - 1) < 0) _exit(126);
  _exit(127);
}

}  // namespace

std::unique_ptr<ByteStream> start_emulator(const std::string& board, const std::string& image,
                                           const std::string& asset_path) {
  const Board* found = nullptr;
  for (const Board& known : kBoards)
    if (board == known.name) found = &known;
  if (found == nullptr) {
    std::string list;
    for (const Board& known : kBoards) list += std::string(list.empty() ? "" : ", ") + known.name;
    throw Refused("qemu:" + board + ": no such board; known: " + list);
  }
  if (access(image.c_str(), R_OK) != 0)
    throw Refused("qemu:" + board + ": cannot read " + image + "; build it (cmake --preset " +
                  board + " && cmake --build --preset " + board + ") or name it with --image");
  const char* temporary = std::getenv("TMPDIR");
  std::string folder = std::string(temporary != nullptr ? temporary : "/tmp") + "/firmtouch-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr || mkfifo((folder + "/link.in").c_str(), 0600) != 0 ||
      mkfifo((folder + "/link.out").c_str(), 0600) != 0)
    throw Refused(folder + ": " + std::strerror(errno) +
                  "; TMPDIR must name a folder that can hold FIFOs");
  const pid_t process = start(
      {"qemu-system-arm", "-M", board, "-kernel", image, "-display", "none", "-monitor", "none",
       "-serial", "null", "-icount", "shift=10,sleep=off,align=off", "-semihosting-config",
       "enable=on,target=native,arg=link,arg=" + escape_commas(folder + "/link"), "-device",
       "loader,file=" + escape_commas(asset_path) + ",addr=" + found->asset_address +
           ",force-raw=on"},
      folder + "/log");
  auto emulator = std::make_unique<Emulator>("qemu:" + board, folder, process);
  emulator->open_files();
  return emulator;
}

}  // namespace firmtouch::host_sim
