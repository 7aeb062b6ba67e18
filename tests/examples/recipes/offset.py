# ParaView: the surface at a distance from a model, out of its distance field.
#     firmtouch voxelize bone.obj -n 64 -o field.vti && pvpython offset.py field.vti 0.002 offset.stl
import sys
from paraview.simple import *

field, distance, output = sys.argv[1:4]
voxels = XMLImageDataReader(FileName=[field])
shell = Contour(Input=voxels, ContourBy=["POINTS", "distance"], Isosurfaces=[float(distance)])
surface = ExtractSurface(Input=shell)
triangles = Triangulate(Input=surface)
SaveData(output, proxy=triangles, FileType="Ascii")
print(triangles.GetDataInformation().GetNumberOfCells(), "triangles")
