#pragma once
#include <string>
#include <vector>

#include "lab/trials.hpp"
#include "spline/spline.hpp"
#include "surface/point.hpp"

namespace firmtouch::lab {

/// An SVG picture of points in space: seen along the z axis (of the plane) or askew (of space); y
/// and z point up. What is drawn later lies over what was drawn before.
class Picture {
 public:
  Picture(tools::Point low, tools::Point high, bool is_askew);

  void line(const std::vector<tools::Point>& points, const char* style);
  void area(const std::vector<tools::Point>& points, const std::string& style);
  void dot(tools::Point p, double radius_px, const char* style);
  /// The edges of a box.
  void box(tools::Point low, tools::Point high, const char* style);
  std::string svg() const;

  /// Greater is nearer to the viewer.
  double depth(tools::Point p) const;

 private:
  void seen(tools::Point p, double& x, double& y) const;
  std::string places(const std::vector<tools::Point>& points) const;

  bool is_askew_;
  double scale_ = 1, left_ = 0, top_ = 0, width_ = 0, height_ = 0;
  std::string body_;
};

// Styles that several pictures share.
constexpr char kShape[] = "stroke=\"black\" stroke-width=\"2.5\"";
constexpr char kNet[] = "stroke=\"black\" stroke-width=\"0.7\"";
constexpr char kPath[] = "stroke=\"#888\" stroke-width=\"1.6\"";
constexpr char kJoin[] = "stroke=\"#36c\" stroke-width=\"0.6\"";
constexpr char kZero[] = "stroke=\"#c33\" stroke-width=\"0.5\" stroke-opacity=\"0.6\"";
constexpr char kFound[] = "fill=\"#fc0\" stroke=\"#850\" stroke-width=\"0.5\"";

/// The surface as `lines` iso-curves and one more, each way.
void draw_net(Picture& picture, const tools::SplineSurface& s, int lines);

/// Writes NAME.svg into the folder `options.figures`. Throws a Problem where it cannot be written.
void write_picture(const Options& options, const std::string& name, const Picture& picture,
                   Report& report);

}  // namespace firmtouch::lab
