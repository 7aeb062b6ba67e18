#include "host_sim/scenario/moves.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kMaxSpeed_mps = 10;
constexpr double kMaxTime_s = 3600;
constexpr double kStartle_s = 0.5;

}  // namespace

bool is_move(const std::string& name) {
  return name == "move" || name == "hold" || name == "press" || name == "follow" ||
         name == "startle" || name == "let_go";
}

Move read_move(const std::string& name, tools::LineReader& words) {
  Move move;
  if (name == "move") {
    move.kind = Move::Kind::kMove;
    words.expect("to");
    move.to_m = words.point("move");
    words.expect("at");
    move.speed_mps = words.quantity("move ... at", "m/s", 1e-6, kMaxSpeed_mps);
    return move;
  }
  if (name == "startle") {
    move.kind = Move::Kind::kStartle;
    move.to_m = words.point("startle");
    move.time_s = kStartle_s;
    return move;
  }
  if (name == "let_go") {
    move.kind = Move::Kind::kLetGo;
  } else if (name == "press") {
    move.kind = Move::Kind::kPress;
    move.to_m = words.point("press");
  } else if (name == "follow") {
    move.kind = Move::Kind::kFollow;
    words.expect("guide");
    words.expect("at");
    move.speed_mps = words.quantity("follow ... at", "m/s", 1e-6, kMaxSpeed_mps);
  }
  words.expect("for");
  move.time_s = words.quantity(name + " ... for", "s", 0.001, kMaxTime_s);
  if (move.kind == Move::Kind::kFollow && words.take("pressing"))
    move.press_m = words.quantity("pressing", "m", 0, 1);
  return move;
}

}  // namespace firmtouch::host_sim
