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

InfoPrintsTheStiffestWallsOfALinkage() {
  box >box.obj
  pantograph >pantograph.txt
  bake box.obj --device pantograph.txt -o a.fta
  f info a.fta; exits 0
  case $out in *stiffest_wall*) fail "$out" ;; esac  # without masses nothing is known
  printf 'tip_mass 60 g\nrotor_0 1e-6 kg*m2\nrotor_1 1e-6 kg*m2\n' >>pantograph.txt
  bake box.obj --device pantograph.txt -o a.fta
  f info a.fta; exits 0
  # The exact discrete model: 2 D / T (1 - d) / (1 + d) with d = D T / 2 m.
  printf '%s\n' "$out" | awk '
    $1 == "least_mass_kg" { m = $2 } $1 == "wall_damping_N_s_per_m" { D = $2 }
    /^ *stiffest_wall/ && match($1, /_at_[0-9]+_kHz/) {
      T = 1e-3 / substr($1, RSTART + 4); d = D * T / 2 / m; want = 2 * D / T * (1 - d) / (1 + d)
      if ($2 > 1.002 * want || $2 < 0.998 * want) exit 1
      ++walls
    }
    END { exit !(walls == 3 && m > 0.05 && m < 0.07) }' || fail "$out"
  f info a.fta --json; exits 0; well_formed
  # Without damping, passive: 2 b / T (Colgate and Schenkel). An arm yields most where it is stretched most, by the largest
  # singular value of its Jacobian.
  { printf 'linkage serial_arm 2\nlink_0 100 mm\nlink_1 100 mm\ntip_mass 60 g\nlow_0 0 deg\nhigh_0 90 deg\nlow_1 30 deg\nhigh_1 150 deg\n'
    printf 'counts_%s 5000 counts/rad\nmax_torque_%s 1 N*m\nrotor_%s 1e-6 kg*m2\nviscous_%s 0.01 N*m*s/rad\n' 0 0 0 0 1 1 1 1; } >arm.txt
  for homing in '' 'home stops'; do
    echo "$homing" >>arm.txt
    bake box.obj --device arm.txt -o a.fta
    f info a.fta; exits 0
    printf '%s\n' "$out" | awk '
      /^ *passive_wall/ && match($1, /_at_[0-9]+_kHz/) {
        a = 0.02 + 0.02 * sqrt(3) / 2; b = 0.01 + 0.01 * sqrt(3) / 2; c = 0.01
        largest = (a + c + sqrt((a - c) ^ 2 + 4 * b * b)) / 2
        want = 2 * 0.01 / largest * 1e3 * substr($1, RSTART + 4)
        if ($2 > 1.001 * want || $2 < 0.999 * want) exit 1
        ++walls
      }
      END { exit walls != 3 }' || fail "$out"
    case $out in *stiffest_wall*) ;; *) fail "$out" ;; esac
  done
}

ALinkageIsCalibrated() {
  # An arm of links 130 and 120 mm, shoulder on the axis; counts are milliradians. The file says 135 and 115 mm.
  awk 'BEGIN {
    print "count_0,count_1,count_2,x,y,z,nx,ny,nz,radius"
    for (i = 0; i < 40; ++i) {
      a = i * 37 % 1000 - 500; b = i * 53 % 900; c = -300 - i * 71 % 1500
      out = .13 * cos(b / 1e3) + .12 * cos((b + c) / 1e3); up = .13 * sin(b / 1e3) + .12 * sin((b + c) / 1e3)
      x = out * cos(a / 1e3); y = out * sin(a / 1e3)
      if (i % 3 == 0) printf "%d,%d,%d,%.7f,%.7f,%.7f,0,0,0,0\n", a, b, c, x, y, up
      if (i % 3 == 1) printf "%d,%d,%d,%.7f,0,0,1,0,0,0\n", a, b, c, x
      if (i % 3 == 2) printf "%d,%d,%d,%.7f,%.7f,%.7f,0,0,0,0.02\n", a, b, c, x, y, up + 0.02
    }
  }' >touches.csv
  printf 'linkage serial_arm 3\nlink_0 135 mm\nlink_1 115 mm\n' >arm.txt
  for k in 0 1 2; do printf 'counts_%s 1000 counts/rad\nlow_%s -2 rad\nhigh_%s 2 rad\nmax_torque_%s 1 N*m\n' $k $k $k $k; done >>arm.txt
  f calibrate arm.txt touches.csv -o found.txt
  exits 0
  f calibrate found.txt touches.csv; exits 0
  for link in 'link_0 .* 0\.13[0-9]* ' 'link_1 .* 0\.12[0-9]* '; do printf '%s' "$out" | grep -q "$link" || fail "$out"; done
  f calibrate found.txt touches.csv --json; exits 0
  well_formed
  printf '%s' "$out" | grep -qE '"name": "link_0", "before": [0-9.]+, "value": 0\.1(3|2999)[0-9]*, "deviation": [0-9.e-]+, "unit": "m"' || fail "$out"
  # Height and zero of the turntable are open where only plates of one direction are touched.
  sed -n '1p; /,1,0,0,0$/p' touches.csv >x_plates.csv
  f calibrate arm.txt x_plates.csv; exits 0
  case $out in *'do not determine'*height*) ;; *) fail "$out" ;; esac
  f calibrate arm.txt x_plates.csv --json; exits 0
  case $out in *'"name": "height", '*'"deviation": null'*) ;; *) fail "$out" ;; esac
  f calibrate arm.txt touches.csv --noise 1e-9; exits 1; says 'do not fit'
  sed '2s/,0$/,nan/' touches.csv >bad.csv
  f calibrate arm.txt bad.csv; exits 3; says 'bad.csv:2' 'not finite'
  f calibrate arm.txt; exits 2
  f calibrate arm.txt --plan 0; exits 2
  f calibrate arm.txt --plan 40; exits 0
  printf '%s\n' "$out" >plan.csv
  [ "$(wc -l <plan.csv)" = 41 ] || fail 'a plan of 40 touches'
  f calibrate arm.txt plan.csv; exits 0  # what is planned can be made
  f calibrate touch_like --study --runs 200; exits 0
  case $out in *'200, converged 200'*) ;; *) fail "$out" ;; esac
}
