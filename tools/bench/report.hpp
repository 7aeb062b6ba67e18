#pragma once
#include <functional>
#include <string>
#include <vector>

namespace firmtouch::bench {

/// A number as a bench prints it: as many digits as mean something; "nan" where it is none.
std::string number_text(double value);

/// What a bench has measured, in the order of the report.
class Report {
 public:
  enum class Goal { kNone, kAtMost, kAtLeast };
  struct Figure {
    std::string what, model;
    double value;
    std::string unit, remark;
    Goal goal_is;
    double goal;
    bool is_absent;  // not measured; the remark says why

    /// A bar that is met. NaN meets none.
    bool ok() const;
  };
  struct Table {
    std::vector<std::string> heads;
    std::vector<std::vector<std::string>> rows;
  };
  /// A heading, a table or a figure: what is not empty.
  struct Entry {
    std::string heading;
    Table table;
    std::vector<Figure> figure;  // none or one
  };

  void heading(const std::string& text);
  /// Every row has as many cells as there are heads.
  void table(const std::vector<std::string>& heads,
             const std::vector<std::vector<std::string>>& rows);
  /// A value that no bar is about.
  void figure(const std::string& what, const std::string& model, double value,
              const std::string& unit, const std::string& remark = "");
  /// A bar: met where value <= goal.
  void bar(const std::string& what, const std::string& model, double value, const std::string& unit,
           double goal, const std::string& remark = "");
  /// A bar: met where value >= goal.
  void bar_at_least(const std::string& what, const std::string& model, double value,
                    const std::string& unit, double goal, const std::string& remark = "");
  /// What was not measured, and why: `peer absent`.
  void absent(const std::string& what, const std::string& model, const std::string& why);

  /// What begins now, for whoever watches; not a result.
  void stage(const std::string& what) const {
    if (on_stage) on_stage(what);
  }
  std::function<void(const std::string&)> on_stage;

  const std::vector<Entry>& entries() const { return entries_; }
  size_t bars_not_met() const;

 private:
  std::vector<Entry> entries_;
};

/// The report as text: headings, tables with aligned columns, figures one a line with `goal` and
/// `met` or `NOT MET`.
std::string to_text(const Report& report);

/// The members of a bench's JSON object: "figures": [...], "tables": [...]. Every figure has what,
/// model, value (null: not measured), unit and remark; a bar has goal, goal_is and ok besides.
std::string to_json_members(const Report& report);

}  // namespace firmtouch::bench
