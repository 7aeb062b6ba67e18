# NumPy: distances of points to the model of an asset.
#     python3 distances.py scene.fta bone points.csv        points.csv: header x,y,z in metres
import io, subprocess, sys
import numpy

asset, name, points = sys.argv[1:4]
rows = subprocess.run(["firmtouch", "query", asset, name, "distance", "--npy"],
                      stdin=open(points), stdout=subprocess.PIPE, check=True).stdout
answers = numpy.load(io.BytesIO(rows))  # records: answers["distance"], answers["cx"], ...
deepest = answers[answers["distance"].argmin()]
print(len(answers), "points,", (answers["distance"] < 0).sum(), "inside, least distance %.9g" % deepest["distance"])
