# Linkages in assets: `firmtouch bake --device`. Read by tests/cli/run.

pantograph() {
  printf 'linkage five_bar\nbase 25 mm\n'
  printf 'proximal_%s 63 mm\ndistal_%s 75 mm\n' 0 0 1 1
  printf 'counts_%s 13824 counts/turn\nlow_%s 60 deg\nhigh_%s 150 deg\nmax_torque_%s 0.3 N*m\n' 0 0 0 0 1 1 1 1
}

ALinkageIsBakedWithItsPart() {
  box >box.obj
  pantograph >pantograph.txt
  bake box.obj -o plain.fta
  bake box.obj --device pantograph.txt -o a.fta
  says 'linkage of 2 joints' 'needs parts: mesh;linkage'
  f info a.fta
  exits 0
  case $out in *'section 7001        160 bytes  linkage'*) ;; *) fail "$out" ;; esac
  pantograph | sed 's/75 mm/0 mm/' >pantograph.txt
  f bake box.obj --device pantograph.txt -o b.fta
  exits 3
  says 'pantograph.txt:4' distal_0 'outside 0.001 to 10 m'
  absent b.fta
  bend >pantograph.csv
  f bake pantograph.csv --device pantograph.txt -o b.fta; exits 3; says rename; absent b.fta
  f bake box.obj --device box.obj -o b.fta; exits 3; absent b.fta
  f bake box.obj --device pantograph.txt -o pantograph.txt; exits 2; says overwrite
}
