#pragma once
#include <sys/types.h>

#include <string>

namespace firmtouch::live_test {

/// A headless Chromium, spoken to over two pipes (its remote debugging protocol): no package
/// between. It is ended with this object. Every call gives up after its time: nothing hangs.
class Browser {
 public:
  Browser(const std::string& program, const std::string& folder);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Opens a further page and turns to it. Result: false where it did not start or gave no page
  /// within 20 s.
  bool open(const std::string& url, int width, int height);
  /// The page that the calls below go to, for use().
  const std::string& page() const { return session_; }
  /// In front: a page behind another one draws nothing.
  void use(const std::string& page) {
    session_ = page;
    call("Page.bringToFront", "{}", 5000);
  }
  /// Exceptions and errors on the console of all pages, a line each.
  const std::string& errors() const { return errors_; }
  /// Presses, moves and releases pointers, or turns the wheel: one event of the protocol's Input.
  void input(const std::string& method, const std::string& parameters) {
    call("Input." + method, parameters, 10000);
  }
  void resize(int width, int height);
  /// What `expression` is in the page, as text; empty where it threw or no answer came in 10 s.
  std::string evaluate(const std::string& expression);
  /// Result: false where no picture came.
  bool picture(const std::string& path);

 private:
  void note(const std::string& event);
  std::string call(const std::string& method, const std::string& parameters, int timeout_ms);

  pid_t process_ = -1;
  int to_ = -1, from_ = -1;
  int last_id_ = 0;
  std::string session_, errors_;
  std::string waiting_;  // bytes of an answer that is not whole yet
};

}  // namespace firmtouch::live_test
