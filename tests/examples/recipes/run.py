# ParaView: the largest force of a run, out of its files over time.
#     firmtouch-sim export run.ftl run && pvpython run.py run
import math, sys
from paraview.simple import *
from paraview.servermanager import Fetch

run = PVDReader(FileName=sys.argv[1] + "/run.pvd")
forces = []
for time in run.TimestepValues:
    run.UpdatePipeline(time)
    tip = Fetch(run).GetBlock(1).GetBlock(0).GetPointData().GetArray("force_N").GetTuple3(0)
    forces.append(math.sqrt(sum(x * x for x in tip)))
print(len(forces), "pictures, largest force %.6f N" % max(forces))
