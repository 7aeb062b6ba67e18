# ParaView: the largest force of a run and how deep its hand was, out of its files over time.
#     firmtouch-sim export run.ftl run && pvpython run.py run
import math, sys
from paraview.simple import *
from paraview.servermanager import Fetch

run = PVDReader(FileName=sys.argv[1] + "/run.pvd")
forces, depths = [], []
for time in run.TimestepValues:
    run.UpdatePipeline(time)
    tick = Fetch(run).GetBlock(1).GetBlock(0)
    forces.append(math.hypot(*tick.GetPointData().GetArray("force_N").GetTuple3(0)))
    depths.append(tick.GetFieldData().GetArray("penetration_m").GetValue(0))
print(len(forces), "pictures, largest force %.6f N, %.4f mm deep" % (max(forces), 1e3 * max(depths)))
