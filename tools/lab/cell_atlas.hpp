#pragma once
#include <cstdint>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::lab {

/// A quadtree over the plane of a curve whose cells list the parts of it that may be nearest to a
/// point in them: to be measured beside the tree that the firmware has. All its bounds are of
/// polynomials that are affine in the query, so what holds at the corners of a cell holds in it.
class CellAtlas {
 public:
  struct Options {
    int levels = 6;          // of the quadtree
    size_t max_entries = 2;  // of a cell, if it need not be cut further
    double margin = 0.25;    // beyond the control points, of the longest side
  };
  /// Pre: the curve lies in a plane of one z; degree <= 5.
  CellAtlas(const tools::SplineCurve& curve, const Options& options);

  /// What a query leaves for the next one.
  struct Last {
    uint32_t piece = UINT32_MAX;
    double t = 0, pace = 0;  // where it was, and how far it goes in as much motion again
    double x = 0, y = 0;
  };
  struct Answer {
    double distance_m = 0;
    uint32_t entries = 0, evaluations = 0;
    bool is_inside = true;  // of the cells
  };
  /// Newton's method on each entry of the cell, guarded, until it is as near as `slack_m`.
  Answer closest(double x, double y, double slack_m, Last& last) const;

  size_t leaves() const;
  size_t bytes() const;  // 4 a cell, 4 an entry
  /// Shares of the area of cells with one, two and more entries, and with one that is not certified
  /// convex.
  struct Shares {
    double one = 0, two = 0, more = 0, uncertain = 0;
  };
  Shares shares() const;

 private:
  static constexpr int kAtoms = 16;  // parts of a piece that entries are made of

  /// A polynomial by Bernstein coefficients, affine in the query: constant + x of_x + y of_y.
  struct Form {
    std::vector<double> constant, of_x, of_y;
    double least(double x, double y) const;
    double most(double x, double y) const;
  };
  struct Atom {
    uint32_t piece;
    double t0, t1;
    std::vector<double> nx, ny, w;  // the numerator and the weight over it
    Form slope, bend;               // of D^2 / 2, times powers of the weight
    bool is_first, is_last;         // of a whole curve that is not closed
  };
  struct Entry {
    uint32_t piece;
    double t0, t1;
    bool is_certain;  // one foot-point at most
    bool is_point;    // an end
  };
  struct Cell {
    uint32_t first = 0, count = 0;  // entries of a leaf
    uint32_t child = 0;             // four in a row; 0: a leaf
    int level = 0;
  };
  struct Square {
    double x, y, side;
  };
  enum class Keep { kNo, kYes, kAsPoint };

  Form distance_beyond(const Atom& atom, double x, double y) const;
  Keep keeps(const Atom& atom, const Square& cell) const;
  bool is_convex(const Atom& atom, const Square& cell) const;
  void fill(uint32_t cell, const Square& square, std::vector<uint32_t> atoms);
  std::vector<Entry> entries_of(const Square& cell, const std::vector<uint32_t>& atoms,
                                const std::vector<Keep>& kept) const;
  struct Foot {
    double t, distance2, pace_x, pace_y;
  };
  Foot solve(const Entry& entry, double start, double x, double y, double slack_m,
             uint32_t& evaluations) const;

  Options options_;
  std::vector<tools::BezierCurve> pieces_;
  std::vector<Atom> atoms_;
  std::vector<Cell> cells_;
  std::vector<Entry> entries_;
  Square whole_{};
};

}  // namespace firmtouch::lab
