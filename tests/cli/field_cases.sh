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

floats() { tail -c "$2" "$1" | od -An -v -t f4 -w4 | tr -d ' '; }  # floats FILE BYTES: the last
ANrrdHasTheDistancesWhereItSaysTheyAre() {
  f make part --triangles 2000 -o part.obj; exits 0
  f voxelize part.obj -n 14 -o part.nrrd; exits 0
  same "$(sed -n 1p part.nrrd)" NRRD0004
  head=$(sed '/^$/q' part.nrrd)
  for line in 'type: float' 'dimension: 3' 'space dimension: 3' 'endian: little' 'encoding: raw'; do
    printf '%s\n' "$head" | grep -qx "$line" || fail "no '$line' in: $head"
  done
  sizes=$(printf '%s\n' "$head" | sed -n 's/^sizes: //p')
  # shellcheck disable=SC2086  # three words
  set -- $sizes
  bytes=$((4 * $1 * $2 * $3))
  same "$(wc -c <part.nrrd)" $((bytes + $(sed '/^$/q' part.nrrd | wc -c)))
  # A point a sample, from origin and directions, x fastest; the distances as a query of the baked mesh has them.
  printf '%s\n' "$head" | tr '(),' '   ' | awk -v a="$1" -v b="$2" -v c="$3" '
    /^space origin/ { for (k = 0; k < 3; ++k) low[k] = $(3 + k) }
    /^space directions/ { step[0] = $3; step[1] = $7; step[2] = $11 }
    END {
      print "x,y,z"
      for (z = 0; z < c; ++z) for (y = 0; y < b; ++y) for (x = 0; x < a; ++x)
        printf "%.9g,%.9g,%.9g\n", low[0] + x * step[0], low[1] + y * step[1], low[2] + z * step[2]
    }' >points.csv
  bake part.obj -o part.fta --keep-triangles
  f query part.fta part distance --cold <points.csv; exits 0
  printf '%s\n' "$out" | sed 1d | cut -d, -f1 >queried
  floats part.nrrd $bytes >written
  same "$(paste written queried | awk '{ d = $1 - $2; if (d * d > 1e-14 || $1 != $1 + 0) ++bad } END { print NR, bad + 0 }')" "$(($1 * $2 * $3)) 0"
  # The .vti has the same floats; those that were not requested are NaN.
  f voxelize part.obj -n 14 -o part.vti; exits 0
  { sed '/^_/,$d' part.vti; printf _; } >before
  tail -c +$(($(wc -c <before) + 9)) part.vti | head -c $bytes >of_vti
  tail -c $bytes part.nrrd | cmp -s - of_vti || fail 'other distances than the .vti'
  f voxelize part.obj -n 14 --interior -o inner.nrrd; exits 0
  same "$(floats inner.nrrd $bytes | grep -c nan)" "$(printf '%s\n' "$err" | sed -n 's/.* inside, \([0-9]*\) outside$/\1/p')"
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
  f voxelize a.obj -n 9 -o a.obj; exits 2; says 'name it .vti or .nrrd'
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
