// An asset without a run.
const stage = new View3d(document.getElementById('stage'), JSON.parse(document.getElementById('scene-data').textContent));
stage.useLegend();
