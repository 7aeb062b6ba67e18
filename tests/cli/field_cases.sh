# Cases of tests/cli/run about closed holes, voxels and distance maps.

HolesAreClosedWhenAskedFor() {
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' >open.obj
  f bake open.obj -o a.fta; exits 3; told '3 open edges around 1 hole' 'or with --close-holes'; absent a.fta
  f bake open.obj --close-holes -o a.fta; exits 0
  told 'closed 1 hole with 1 triangle, numbered from 3 on' 'a hole of 3 edges about (0, 0.5, 0.5 m)'
  f query a.fta open distance <<-END
	x,y,z
	-1,0.2,0.2
	END
  printf '%s\n' "$out" | grep -q '^1,1,0,0.2.*,3,face,' || fail "not the cap: $out"
  printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >sheet.obj
  f bake sheet.obj --close-holes -o b.fta; exits 3; told 'a hole of 3 edges' 'without folding back'; absent b.fta
}
