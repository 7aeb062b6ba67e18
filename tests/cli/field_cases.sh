# Cases of tests/cli/run about closed holes, voxels and distance fields.

HolesAreClosedWhenAskedFor() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' >open.obj
  f bake open.obj -o a.fta; exits 3; says '3 open edges around 1 hole' 'or with --close-holes'; absent a.fta
  f bake open.obj --close-holes -o a.fta; exits 0
  says 'closed 1 hole with 1 triangle, numbered from 3 on' 'a hole of 3 edges about (0, 0.5, 0.5 m)'
  f query a.fta open distance <<-END
	x,y,z
	-1,0.2,0.2
	END
  printf '%s\n' "$out" | grep -q '^1,1,0,0.2.*,3,face,' || fail "not the cap: $out"
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >sheet.obj
  f bake sheet.obj --close-holes -o b.fta; exits 3; says 'a hole of 3 edges' 'without folding back'; absent b.fta
}

VoxelizeTellsCountsAndWritesAFileThatParaViewOpens() {
  f make part --triangles 2000 -o part.obj; exits 0
  f voxelize part.obj -n 24 --interior -o part.vti; exits 0
  says '24 x ' 'agree on the sign of every voxel' 'part.vti:'
  head -c 400 part.vti | grep -q 'VTKFile type="ImageData"' || fail 'no ImageData'
  cp part.vti one.vti
  f voxelize part.obj -n 24 --interior -o part.vti --threads 3; exits 0; says 'by 3 threads'
  cmp -s part.vti one.vti || fail 'threads change the result'
  f voxelize part.obj -n 24; exits 0; same "$out" ''
}

VoxelizeTakesSeveralModelsAndClosesTheirHoles() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' >open.obj
  printf 'v 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >shut.obj
  f voxelize open.obj shut.obj -n 40 -o v.vti; exits 3; says 'open.obj: has 3 open edges'; absent v.vti
  f voxelize open.obj shut.obj -n 40 --close-holes -o v.vti; exits 0
  says 'open.obj: mended: closed 1 hole with 1 triangle' '40 x 10 x 10 voxels of 0.1 m'
}

VoxelizeRefusesWhatItCannotDo() {
  printf 'v 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >a.obj
  f voxelize a.obj; exits 2; says '-n LONG_AXIS_CELLS'
  f voxelize a.obj -n 0; exits 2; says '-n'
  f voxelize a.obj -n 4096; exits 2; says 'voxels of these models; choose less'
  f voxelize a.obj -n 9 -o a.obj; exits 2; says 'name it .vti'
  f voxelize missing.obj -n 9; exits 3; says missing.obj
}

ADistanceMapIsBakedProvenAndShown() {
  f make part --triangles 2000 -o part.obj; exits 0
  f bake part.obj -o a.fta --distance-map 16; exits 0; says 'distance field of 18 x ' 'proven with'
  f info a.fta; exits 0
  printf '%s\n' "$out" | grep -q 'distance field bounds' || fail "$out"
  f bake part.obj -o b.fta --distance-map 16; cmp -s a.fta b.fta || fail 'another map the second time'
  f bake part.obj -o c.fta; exits 0
  [ "$(wc -c <c.fta)" -lt "$(wc -c <a.fta)" ] || fail 'no map in the asset'
  f bake part.obj -o d.fta --distance-map 900; exits 3; says 'choose fewer'; absent d.fta
}
