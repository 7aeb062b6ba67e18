// IGES: what is taken, where it lies, and what a CAD kernel writes.
#include <cmath>

#include "harness/test.hpp"
#include "iges_text.hpp"

namespace {

using namespace firmtouch;
using namespace firmtouch::spline_test;
using tools::Point;
using tools::SplineModel;

SplineModel cad_file(const char* name) {
  return tools::read_spline_file(std::string(FIRMTOUCH_CAD_FILES) + "/" + name, 0);
}

double apart(Point a, Point b) { return tools::length(a - b); }

}  // namespace

TEST(ACurveIsReadAsItStands) {
  const SplineModel model = read_entities({{126, arch()}});
  CHECK(model.problem.empty());
  CHECK_EQ(model.curves.size(), 1u);
  const tools::SplineCurve& c = model.curves[0];
  CHECK_EQ(c.degree, 3);
  CHECK_EQ(c.knots.size(), 8u);
  CHECK_EQ(c.points[2].x, 0.2);
  CHECK_EQ(c.points[2].w, 1.0);
  CHECK_EQ(c.t1, 1.0);
  CHECK(c.is_planar);
  CHECK(has(c.where, "entity 126 in line 3"));
  CHECK_EQ(model.notes.size(), 0u);
}

TEST(ASurfaceIsReadWithUFastest) {
  const SplineModel model = read_entities({{128, sheet()}});
  CHECK(model.problem.empty());
  CHECK_EQ(model.surfaces.size(), 1u);
  const tools::SplineSurface& s = model.surfaces[0];
  CHECK_EQ(s.points[1].x, 0.1);
  CHECK_EQ(s.points[2].y, 0.2);
  CHECK_LE(apart(point_at(s, 1, 0.5), {0.1, 0.1, 0.025}), 1e-17);
}

TEST(PiecesAreNumberedInTheOrderOfTheFile) {
  const SplineModel model =
      read_entities({{126, arch()}, {314, "314,1.,2.,3.;"}, {128, sheet()}, {126, arch()}});
  CHECK(model.problem.empty());
  CHECK_EQ(model.curves[0].piece, 0);
  CHECK_EQ(model.surfaces[0].piece, 1);
  CHECK_EQ(model.curves[1].piece, 2);
  CHECK_EQ(model.notes.size(), 1u);  // a colour
}

TEST(UnitsOfTheFileCountUnlessOneIsGiven) {
  const struct {
    const char* fields;
    double unit_m;
  } kCases[] = {{"1,2HIN", 0.0254}, {"2,2HMM", 0.001}, {"10,2HCM", 0.01},
                {"3,2HKM", 1000},   {"6,", 1},         {",", 0.0254}};
  for (const auto& c : kCases) {
    const std::string global =
        std::string("1H,,1H;,,5Ht.igs,3Hgen,1H1,32,38,6,308,15,1Ht,1.,") + c.fields + ";";
    const std::string text = IgesText({{126, arch()}}, global).text();
    const SplineModel own = tools::read_spline_bytes(text, "part.igs", 0);
    CHECK(own.problem.empty());
    CHECK_LE(std::fabs(own.curves[0].points[3].x - 0.3 * c.unit_m), 1e-16 * c.unit_m);
    const SplineModel given = tools::read_spline_bytes(text, "part.igs", 0.5);
    CHECK_LE(std::fabs(given.curves[0].points[3].x - 0.15), 1e-16);
  }
}

TEST(AUnitOrScaleThatIsNotUsableIsRefusedUnlessAUnitIsGiven) {
  for (const char* fields : {"1.,3,7Hfurlong", "1.,12,", "0.,2,2HMM"}) {
    const std::string global =
        std::string("1H,,1H;,,5Ht.igs,3Hgen,1H1,32,38,6,308,15,1Ht,") + fields + ";";
    const std::string text = IgesText({{126, arch()}}, global).text();
    const SplineModel own = tools::read_spline_bytes(text, "part.igs", 0);
    CHECK(own.problem.find("give --unit") != own.problem.npos);
    const SplineModel given = tools::read_spline_bytes(text, "part.igs", 0.5);
    CHECK(given.problem.empty());
    CHECK_LE(std::fabs(given.curves.at(0).points[3].x - 0.15), 1e-16);
  }
}

TEST(TheModelScaleDividesTheUnit) {
  const std::string global = "1H,,1H;,,5Ht.igs,3Hgen,1H1,32,38,6,308,15,1Ht,.5,6,1HM;";
  const SplineModel model =
      tools::read_spline_bytes(IgesText({{126, arch()}}, global).text(), "part.igs", 0);
  CHECK_LE(std::fabs(model.curves[0].points[3].x - 0.6), 1e-16);
}

TEST(OtherDelimitersExponentsAndLineEndsAreTaken) {
  std::string data = arch();
  for (char& c : data) c = c == ',' ? '/' : c == ';' ? '#' : c;
  data.replace(data.find("0.3/"), 4, "3.D-1/");
  const std::string global = "1H//1H#/1Ht/5H,,;;;/3Hgen/1H1/32/38/6/308/15/1Ht/1./6/1HM#";
  IgesText file({{126, data}}, global);
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const SplineModel model = tools::read_spline_bytes(file.text(end), "part.IGES", 0);
    CHECK(model.problem.empty());
    CHECK_EQ(model.curves[0].points[3].x, 0.3);
  }
}

TEST(TransformationsPlaceAndChain) {
  // A quarter turn about z and a shift, then a shift of the result.
  const SplineModel model = read_entities({{126, arch(), 3},
                                           {124, "124,0.,-1.,0.,10.,1.,0.,0.,20.,0.,0.,1.,30.;", 5},
                                           {124, "124,1.,0.,0.,1.,0.,1.,0.,2.,0.,0.,1.,3.;"}});
  CHECK(model.problem.empty());
  const tools::ControlPoint& p = model.curves[0].points[1];  // (0.1, 0.2, 0) in the entity
  CHECK_LE(apart({p.x, p.y, p.z}, {10 - 0.2 + 1, 20 + 0.1 + 2, 33}), 1e-14);
}

// A composite curve and an untrimmed 144 place what they are made of, after its own transformation.
TEST(TransformationsOfAParentPlaceItsDependents) {
  const char* const turn = "124,0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.;";
  const char* const shift = "124,1.,0.,0.,1.,0.,1.,0.,2.,0.,0.,1.,3.;";
  const SplineModel curve =
      read_entities({{126, arch(), 5, 10000}, {102, "102,1,1;", 7}, {124, turn}, {124, shift}});
  CHECK(curve.problem.empty());
  const tools::ControlPoint& p = curve.curves.at(0).points[1];  // (0.1, 0.2, 0) in the entity
  CHECK_LE(apart({p.x, p.y, p.z}, {-0.2 + 1, 0.1 + 2, 3}), 1e-14);
  const SplineModel surface = read_entities(
      {{144, "144,3,0,0,0;", 7}, {128, sheet(), 5, 30000}, {124, turn}, {124, shift}});
  CHECK(surface.problem.empty());
  const tools::ControlPoint& q = surface.surfaces.at(0).points[3];  // (0.1, 0.2, 0.05)
  CHECK_LE(apart({q.x, q.y, q.z}, {-0.2 + 1, 0.1 + 2, 3.05}), 1e-14);
}

TEST(PlanarCurvesAreFoundFromTheirPoints) {
  std::string bent = arch();
  bent.replace(bent.find("0.2,0.2,0.,"), 11, "0.2,0.2,.1,");
  const SplineModel model = read_entities(
      {{126, bent}, {126, arch(), 5}, {124, "124,.6,0.,.8,0.,0.,1.,0.,0.,-.8,0.,.6,0.;"}});
  CHECK(!model.curves[0].is_planar);  // the file's own flag says that it is
  CHECK(model.curves[1].is_planar);   // in a leaning plane
}

TEST(AnUntrimmedTrimmedSurfaceIsItsSurface) {
  CHECK(read_entities({{128, sheet()}, {144, "144,1,0,0,0;"}}).problem.empty());
}

TEST(PiecesWithoutLength_AreReported) {
  const auto note_on = [](int type, const char* text) {
    const SplineModel model = read_entities({{type, text}});
    CHECK(model.problem.empty());
    CHECK_EQ(model.notes.size(), 1u);
    return model.notes.at(0);
  };
  const std::string curve = note_on(
      126,
      "126,4,1,1,0,1,0,0.,0.,1.,2.,3.,4.,4.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,1.,0.,0.,2.,0.,"
      "0.,3.,0.,0.,0.,4.;");
  CHECK(has(curve, "entity 126 in line 3: left out 1 piece"));
  // Of four patches the one whose four corners are one point.
  const std::string sheet = note_on(
      128,
      "128,2,2,1,1,0,0,1,0,0,0.,0.,1.,2.,2.,0.,0.,1.,2.,2.,1.,1.,1.,1.,1.,1.,1.,1.,1.,0.,0.,0.,"
      "0.,0.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,1.,1.,0.,0.,1.,0.,0.5,1.,0.,1.,2.,0.,0.,2.,0.,2.;");
  CHECK(has(sheet, "entity 128 in line 3: left out 1 piece that has no extent"));
}

TEST(ACircleOfACadKernelIsRound) {
  const SplineModel model = cad_file("circle-and-ellipse.igs");
  CHECK(model.problem.empty());
  CHECK_EQ(model.curves.size(), 2u);
  double worst = 0;
  for (int k = 0; k <= 1000; ++k) {
    const tools::SplineCurve& circle = model.curves[0];
    const double t = circle.t0 + (circle.t1 - circle.t0) * k / 1000;
    worst = std::fmax(worst, std::fabs(apart(point_at(circle, t), {0.01, 0.005, 0}) - 0.04));
    // The ellipse: distances from both foci add up to its long axis.
    const tools::SplineCurve& e = model.curves[1];
    const Point centre{0, 0, 0.02}, along{0, std::sqrt(0.5), -std::sqrt(0.5)};
    const double focus = std::sqrt(0.03 * 0.03 - 0.02 * 0.02);
    const Point p = point_at(e, e.t0 + (e.t1 - e.t0) * k / 1000);
    const double sum = apart(p, centre + along * focus) + apart(p, centre - along * focus);
    worst = std::fmax(worst, std::fabs(sum - 0.06));
  }
  CHECK_LE(worst, 3e-12);  // the file has 9 decimals of a millimetre
  CHECK(model.curves[0].is_planar);
  CHECK(model.curves[1].is_planar);
}

TEST(AFileInInchesLiesWhereItsMillimetresSay) {
  const SplineModel model = cad_file("wave-in-inches.igs");
  CHECK(model.problem.empty());
  const tools::SplineCurve& c = model.curves[0];
  const double parameter[] = {0, 22.912878475, 52.912878475, 84.928499662, 109.42339709};
  const Point at[] = {{0, 0, 0}, {20, 10, 5}, {40, -10, 15}, {60, 10, 0}, {80, 0, 10}};
  for (int i = 0; i < 5; ++i) CHECK_LE(apart(point_at(c, parameter[i]), at[i] * 0.001), 1e-10);
  CHECK(!c.is_planar);
}

TEST(ATorusOfACadKernelSatisfiesItsEquation) {
  const SplineModel model = cad_file("torus.igs");
  CHECK(model.problem.empty());
  CHECK_EQ(model.surfaces.size(), 1u);
  const tools::SplineSurface& s = model.surfaces[0];
  double worst = 0;
  for (int i = 0; i <= 50; ++i) {
    for (int j = 0; j <= 50; ++j) {
      const Point p = point_at(s, s.u0 + (s.u1 - s.u0) * i / 50, s.v0 + (s.v1 - s.v0) * j / 50);
      const double ring = std::sqrt(p.x * p.x + p.y * p.y) - 0.05;
      worst = std::fmax(worst, std::fabs(std::sqrt(ring * ring + p.z * p.z) - 0.02));
    }
  }
  CHECK_LE(worst, 3e-12);
}

TEST(ATrimmedFaceIsRefusedByEntityAndLine) {
  const std::string problem = cad_file("trimmed-face.igs").problem;
  CHECK(has(problem, "trimmed-face.igs:6: entity 144 in line 6: trimmed surfaces are not read"));
  CHECK(has(problem, "untrimmed NURBS surfaces (128)"));
}
