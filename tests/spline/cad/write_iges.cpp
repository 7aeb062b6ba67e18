// Writes the .igs files of this folder with OpenCASCADE's own writer; README.md says how.
#include <BRepBuilderAPI_MakeFace.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>
#include <vector>

namespace {

void write(const char* unit, const std::vector<Handle(Standard_Transient)>& shapes,
           const char* file) {
  IGESControl_Writer writer(unit, 0);
  for (const Handle(Standard_Transient) & shape : shapes) writer.AddGeom(shape);
  writer.ComputeModel();
  writer.Write(file);
}

Handle(Geom_BSplineCurve) wave() {
  const double at[][3] = {{0, 0, 0}, {20, 10, 5}, {40, -10, 15}, {60, 10, 0}, {80, 0, 10}};
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 5);
  for (int i = 0; i < 5; ++i) points->SetValue(i + 1, gp_Pnt(at[i][0], at[i][1], at[i][2]));
  GeomAPI_Interpolate through(points, false, 1e-9);
  through.Perform();
  return through.Curve();
}

}  // namespace

int main() {
  IGESControl_Controller::Init();
  const gp_Ax2 flat(gp_Pnt(10, 5, 0), gp_Dir(0, 0, 1));
  const gp_Ax2 leaning(gp_Pnt(0, 0, 20), gp_Dir(1, 2, 2), gp_Dir(0, 1, -1));
  Handle(Geom_Curve) circle = GeomConvert::CurveToBSplineCurve(new Geom_Circle(flat, 40));
  Handle(Geom_Curve) ellipse = GeomConvert::CurveToBSplineCurve(new Geom_Ellipse(leaning, 30, 20));
  write("MM", {circle, ellipse}, "circle-and-ellipse.igs");
  write("IN", {wave()}, "wave-in-inches.igs");
  const gp_Ax3 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  write("MM", {GeomConvert::SurfaceToBSplineSurface(new Geom_ToroidalSurface(axis, 50, 20))},
        "torus.igs");
  IGESControl_Writer faces("MM", 0);
  const gp_Pln plane(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  faces.AddShape(BRepBuilderAPI_MakeFace(plane, 0, 10, 0, 20).Face());
  faces.ComputeModel();
  faces.Write("trimmed-face.igs");
  return 0;
}
