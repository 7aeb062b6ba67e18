#pragma once
#include <string>
#include <vector>

#include "host_sim/report/score.hpp"

namespace firmtouch::host_sim {

/// A figure of a score with its bar: met if value <= bar.
struct ScoreRow {
  std::string figure;
  double value;
  std::string unit;
  double bar;
  bool is_met() const { return value <= bar; }  // NaN meets none
};

/// The bars of any run. Buzz: 2.5 % of the force limit, the chatter of a report.
std::vector<ScoreRow> rows_of(const Score& score, const ScoreSettings& settings);

/// "figure,value,unit,bar,met" and a line a row.
std::string csv_of(const std::vector<ScoreRow>& rows);
/// The same as a JSON list of objects.
std::string json_of(const std::vector<ScoreRow>& rows);

/// One HTML page: the rows, and charts of force, turn, energy and depth over time.
std::string score_page(const std::string& title, const std::vector<ScoreRow>& rows,
                       const std::vector<ScoredTick>& ticks, const ScoreSettings& settings);

}  // namespace firmtouch::host_sim
