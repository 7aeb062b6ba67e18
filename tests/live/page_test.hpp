#pragma once
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "live/browser.hpp"

namespace firmtouch::live_test {

/// A test of a page in a browser: claims, each printed with its verdict.
struct PageTest {
  Browser browser;
  std::string pictures;  // the folder they are saved in; empty: none is
  int passed = 0, failed = 0;

  /// `words`: the command line: PROGRAM BROWSER, two of the test, FOLDER [PICTURES].
  explicit PageTest(char** words)
      : browser(words[1], words[4]), pictures(words[5] == nullptr ? "" : words[5]) {}
  /// Whether `expression` becomes true in the page within the time.
  bool becomes(const std::string& expression, double max_s = 10) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(max_s);
    do {
      if (browser.evaluate(expression) == "true") return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    } while (Clock::now() < end);
    return false;
  }
  bool check(const char* claim, bool holds) {
    std::printf("%s  %s\n", holds ? "ok  " : "FAIL", claim);
    std::fflush(stdout);
    ++(holds ? passed : failed);
    return holds;
  }
  double number(const std::string& expression) {
    return std::strtod(browser.evaluate(expression).c_str(), nullptr);
  }
  void picture(const char* name) {
    if (!pictures.empty()) browser.picture(pictures + "/" + name + ".png");
  }
  /// The last claim, and the sums. Result: the exit code.
  int finish() {
    const std::string errors = browser.errors();
    if (!check("no error on the console", errors.empty())) std::printf("%s", errors.c_str());
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed == 0 ? 0 : 1;
  }
};

}  // namespace firmtouch::live_test
