# Cases of tests/cli/run about materials of triangles.

# A box of 12 triangles, the upper 2 of group or material `lid`.
box_obj() {  # box_obj KEYWORD
  printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n'
  printf '%s side\nf 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n%s lid\nf 5 6 7 8\n' "$1" "$1"
}

feel() { printf '# soft on top\nmaterial side friction 0.5 sliding 0.3\nmaterial lid stiffness 2 N/mm viscous 3 Ns/m\n'; }

MaterialsOfAModelAreBakedByName() {
  feel >feel.txt
  for word in usemtl g; do
    box_obj $word >box.obj
    bake box.obj -o $word.fta --materials feel.txt
    says 'materials: 0 triangles without, 10 side, 2 lid' 'needs parts: mesh;materials'
  done
  cmp -s usemtl.fta g.fta && fail 'the provenance is the same'
  f info usemtl.fta; exits 0
  printf '%s\n' "$out" | grep -q 'section 1012 *12 bytes' || fail "no bytes of triangles: $out"
  bake usemtl.fta -o again.fta
  cmp -s usemtl.fta again.fta || fail 'taken as it is, it is another'
  # Who bakes without materials needs no part more.
  bake box.obj -o plain.fta
  says 'needs parts: mesh (FIRMTOUCH_APP)'
}

MaterialNumbersOfAFileAreThoseOfTheTriangles() {
  box_obj usemtl >box.obj; feel >feel.txt
  printf '1 1 1 1 1 1 1 1 1 1\n2 2 # the lid\n' >numbers.txt
  bake box.obj -o a.fta --materials feel.txt --material-numbers numbers.txt
  says '0 triangles without, 10 side, 2 lid'
  bake box.obj -o b.fta --materials feel.txt
  f info a.fta; a=$(printf '%s\n' "$out" | grep 'section 1012')
  f info b.fta; same "$a" "$(printf '%s\n' "$out" | grep 'section 1012')"
}

AToolOfSpheresTouchesOneMaterial() {
  box_obj usemtl >box.obj; feel >feel.txt
  for name in tip end; do printf 'sphere 0 0 0 mm radius 5 mm\n' >$name.tool; done
  f bake box.obj tip.tool -o none.fta --materials feel.txt --unit m; exits 3
  says 'tip.tool: a tool of spheres touches one mesh of one material: leave it out, or --materials'
  absent none.fta
  echo 'object a of box' >scene.objects
  f bake box.obj tip.tool scene.objects -o none.fta --unit m; exits 3
  says 'leave it out, or the file .objects'
  bake box.obj tip.tool end.tool -o two.fta --unit m
  says 'a controller uses tool `end`, not `tip`; bake one alone'
}

WavesOfAMaterialAreBaked() {
  box_obj usemtl >box.obj; feel >feel.txt
  bake box.obj -o smooth.fta --materials feel.txt
  f info smooth.fta; printf '%s\n' "$out" | grep -q 'section 1013' && fail "a smooth one has textures: $out"
  printf 'material side\nmaterial lid waves 0.1 mm every 1 mm along 1 0 0 and 0 2 0 friction 0.5\n' >grid.txt
  bake box.obj -o grid.fta --materials grid.txt
  f info grid.fta; printf '%s\n' "$out" | grep -q 'section 1013 *64 bytes' || fail "not two textures: $out"
}

# A picture of 4 by 4 that is white except one dark sample.
pgm() { printf 'P2\n# a dot\n%s\n255\n255 255 255 255 255 200 255 255 255 255 255 255 255 255 255 %s\n' "${1:-4 4}" "${2:-255}"; }

HeightMapsOfMaterialsAreBaked() {
  box_obj usemtl >box.obj; mkdir -p looks; pgm >looks/dot.pgm
  printf 'material side\nmaterial lid map dot.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0 waves 0.1 mm every 2 mm along 1 0 0\n' >looks/dots.txt
  bake box.obj -o dots.fta --materials looks/dots.txt
  f info dots.fta
  printf '%s\n' "$out" | grep -q 'section 1014 *88 bytes' || fail "not two maps: $out"
  printf '%s\n' "$out" | grep -q 'section 1015 *16 bytes' || fail "not 16 samples: $out"
  # As bytes it is the same picture.
  { printf 'P5 4 4 255\n'; printf '\377\377\377\377\377\310'; printf '\377\377\377\377\377\377\377\377\377\377'; } >binary.pgm
  mv looks/dot.pgm text.pgm; cp binary.pgm looks/dot.pgm
  bake box.obj -o same.fta --materials looks/dots.txt
  cmp -s dots.fta same.fta || fail 'P2 and P5 differ'
  map() { printf 'material side\nmaterial lid map %s\n' "$2" >map.txt; f bake box.obj --materials map.txt -o bad.fta; exits 3; says "$1"; absent bad.fta; }
  map 'none.pgm: cannot be opened' 'none.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  map 'box.obj: is no PGM picture' 'box.obj 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  pgm '4 5' >wide.pgm; map 'wide.pgm: is 4 by 5; scale it' 'wide.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  pgm '8 8' >short.pgm; map 'short.pgm: a number of the picture is missing' 'short.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  pgm '4 4' 256 >bright.pgm; map 'bright.pgm: sample 15 of 16 is missing or above 255' 'bright.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  head -c 20 binary.pgm >cut.pgm; map 'cut.pgm: sample 9 of 16 is missing' 'cut.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  sed 's/^255$/65535/' text.pgm >deep.pgm; map 'deep.pgm: its white is 65535' 'deep.pgm 0.2 mm every 4 mm along 1 0 0 and 0 1 0'
  map 'the texture is up to' 'text.pgm 0.2 mm every 0.2 mm along 1 0 0 and 0 1 0'
  map '`map` = ' 'text.pgm 2.1 mm every 400 mm along 1 0 0 and 0 1 0'
  map 'a map along 0 0 0 has no direction' 'text.pgm 0.2 mm every 4 mm along 1 0 0 and 0 0 0'
  map 'the line ends where `and` is expected' 'text.pgm 0.2 mm every 4 mm along 1 0 0'
  map 'the line ends where' ''
}

MaterialsThatDoNotFitAreRefusedByName() {
  box_obj usemtl >box.obj; feel >feel.txt
  refuse() {  # refuse TEXT ARGUMENT...
    text=$1; shift
    f bake "$@" -o bad.fta; exits 3; says "$text"; absent bad.fta
  }
  printf 'material lid\n' >few.txt
  refuse 'box.obj: material `side` is not in few.txt, which has lid' box.obj --materials few.txt
  : >none.txt
  refuse 'none.txt: it has no material' box.obj --materials none.txt
  i=0; while [ $i -lt 300 ]; do echo "material m$i"; i=$((i + 1)); done >many.txt
  refuse 'many.txt:256: a mesh has at most 255 materials' box.obj --materials many.txt
  printf 'material lid\nmaterial lid\n' >twice.txt
  refuse 'twice.txt:2: there are two materials `lid`' box.obj --materials twice.txt
  printf 'material lid stiffness 0 N/m\n' >soft.txt
  refuse 'soft.txt:1: ' box.obj --materials soft.txt
  printf 'material lid friction -1\n' >negative.txt
  refuse 'negative.txt:1: ' box.obj --materials negative.txt
  printf 'material lid friction nan\n' >nan.txt
  refuse 'nan.txt:1: ' box.obj --materials nan.txt
  printf 'material lid colour red\n' >colour.txt
  refuse 'unknown word `colour`' box.obj --materials colour.txt
  refuse 'cannot be opened' box.obj --materials nowhere.txt
  # Waves.
  wave() { printf 'material side\nmaterial lid waves %s\n' "$2" >wave.txt; refuse "wave.txt:2: $1" box.obj --materials wave.txt; }
  wave 'the waves are higher than 0.238 of their length' '0.24 mm every 1 mm along 1 0 0'
  wave '`waves` = ' '2.1 mm every 100 mm along 1 0 0'
  wave '`waves` = ' '-0.1 mm every 1 mm along 1 0 0'
  wave '`waves` needs a number' 'nan mm every 1 mm along 1 0 0'
  wave '`every` = ' '0 mm every 0 mm along 1 0 0'
  wave '`along` needs a number' '0.1 mm every 1 mm along x'
  wave 'waves along 0 0 0 have no direction' '0.1 mm every 1 mm along 0 0 0'
  wave 'the line ends where `along` is expected' '0.1 mm every 1 mm'
  wave 'unknown word `and`' '0.1 mm every 1 mm along 1 0 0 and 0 1 0 and 0 0 1'
  # Numbers.
  printf '1 2 1' >short.txt
  refuse 'short.txt: has 3 numbers, the model 12 triangles' box.obj --materials feel.txt --material-numbers short.txt
  printf '1 1 1 1 1 1\n1 1 1 1 1 3\n' >high.txt
  refuse 'high.txt:2: material 3 is not in feel.txt' box.obj --materials feel.txt --material-numbers high.txt
  printf '1 1 1 1 1 1 1 1 1 1 1 -1' >low.txt
  refuse 'low.txt:1: material -1 is not in feel.txt' box.obj --materials feel.txt --material-numbers low.txt
  printf 'one' >word.txt
  refuse 'word.txt:1: `one`' box.obj --materials feel.txt --material-numbers word.txt
  # A model without any, and a PLY index behind the end of the table.
  grep -v usemtl box.obj >plain.obj
  refuse 'plain.obj: no triangle has a material' plain.obj --materials feel.txt
  { printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 4\nproperty list uchar int vertex_indices\nproperty int material_index\nend_header\n'
    printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 1\n3 0 1 3 2\n3 1 2 3 3\n3 0 3 2 0\n'; } >tetra.ply
  refuse 'tetra.ply: triangle 2 (from 0): material 3 is not in feel.txt, which has 2 (side, lid)' tetra.ply --materials feel.txt
  sed 's/^3 1 2 3 3/3 1 2 3 -1/' tetra.ply >minus.ply
  refuse 'minus.ply:17: face 2 (from 0): ' minus.ply --materials feel.txt
  sed 's/^3 1 2 3 3/3 1 2 3 2/' tetra.ply >good.ply
  bake good.ply -o good.fta --materials feel.txt
  says '1 triangles without, 1 side, 2 lid'
}

MaterialOptionsThatContradictAreRefused() {
  box_obj usemtl >box.obj; cp box.obj other.obj; feel >feel.txt; printf '1' >numbers.txt
  printf 'object a of box\n' >room.objects
  for words in 'box.obj --material-numbers numbers.txt' 'box.obj --materials feel.txt --wrap 1%' \
    'box.obj room.objects --materials feel.txt' 'box.obj --materials feel.txt --hull-faces 12 --no-tree' \
    'box.obj other.obj --materials feel.txt --material-numbers numbers.txt'; do
    # shellcheck disable=SC2086
    f bake $words -o bad.fta; exits 2; absent bad.fta
  done
  f bake box.obj --materials feel.txt -o feel.txt; exits 2
  grep -q 'soft on top' feel.txt || fail 'the input is overwritten'
}
