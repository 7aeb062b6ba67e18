// `answers HASH`: the hash of 6,000 answers about the asset that the board holds, on its debug
// console.
#include "firmtouch/hal/board.hpp"
#include "target/answers.hpp"
#include "target/text.hpp"

namespace target = firmtouch::target;
using firmtouch::hal::board_print;

int main() {
  firmtouch::hal::board_begin();
  const target::Views views = target::open_views(firmtouch::hal::board_asset());
  if (!views.verdict.ok()) {
    board_print("asset rejected by rule ");
    board_print(target::decimal(views.verdict.rule).text);
    board_print("\n");
    return 1;
  }
  board_print("answers ");
  board_print(target::hexadecimal(target::hash_answers(views, 6000)).text);
  board_print("\n");
  return 0;
}
