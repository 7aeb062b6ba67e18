# What the firmware's archives (build/PRESET/firmware/libfirmtouch_*.a) need from outside, and what is in them. On every
# target: memcpy and its three kin, and of libgcc only what is listed here by name; no static constructors; no double;
# no fused multiply-add. Needs the presets built. Read by tests/check/run.

presets='host mps2-an500 netduinoplus2'

# tool PRESET NAME: nm or objdump or g++ of that target
tool() {
  case $1 in
    host) echo "$2" ;;
    mps2-an500) echo "arm-none-eabi-$2" ;;
    netduinoplus2) echo "arm-none-eabi-$2" ;;
  esac
}
flags() {
  case $1 in
    host) ;;
    mps2-an500) echo '-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16' ;;
    netduinoplus2) echo '-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16' ;;
  esac
}
allowed() {
  printf '%s\n' memcpy memset memmove memcmp
  case $1 in
    host)
      echo _GLOBAL_OFFSET_TABLE_  # position-independent code needs it, the linker makes it
      echo __stack_chk_fail       # distributions that protect every stack (not Debian)
      ;;
    mps2-an500 | netduinoplus2)
      echo __aeabi_uldivmod  # libgcc: unsigned 64-bit division
      echo __aeabi_ldivmod   # libgcc: signed 64-bit division
      ;;
  esac
}

check() {
  bad=0
  for preset in ${only:-$presets}; do
    set -- "build/$preset/firmware"/libfirmtouch_*.a
    if [ ! -e "$1" ] || [ $# -lt 5 ]; then
      echo "build/$preset/firmware: too few archives: cmake --preset $preset && cmake --build --preset $preset"
      bad=1
      continue
    fi
    nm=$(tool "$preset" nm)
    objdump=$(tool "$preset" objdump)
    # Undefined over the union: what one archive lacks another may have.
    { allowed "$preset" | sed 's/^/allow /'; "$nm" -A "$@" 2>/dev/null; } | awk -v preset="$preset" '
      $1 == "allow" { have[$2] = 1; next }
      NF >= 2 {
        symbol = $NF
        kind = $(NF - 1)
        if (kind == "U") { if (!(symbol in wants)) wants[symbol] = $1 }
        else if (kind ~ /^[TDRBWVuwi]$/ && kind != "w") have[symbol] = 1
        ++seen
      }
      END {
        if (seen < 50) { print preset ": only " seen + 0 " symbols in the archives"; bad = 1 }
        for (symbol in wants) if (!(symbol in have)) {
          object = wants[symbol]; sub(/.*libfirmtouch_/, "libfirmtouch_", object); sub(/:$/, "", object)
          print preset ": " object " wants " symbol; bad = 1
        }
        exit bad
      }' || bad=1
    for archive; do
      sections=$("$objdump" -h "$archive" | grep -oE '\.(init_array|ctors|preinit_array|fini_array)[.0-9]*' | sort -u)
      [ -z "$sections" ] || { echo "$preset: ${archive##*/} has static constructors ($sections)"; bad=1; }
    done
    for archive; do "$objdump" -d "$archive"; done 2>/dev/null | awk -v preset="$preset" '
      / file format / { object = $1; sub(/:$/, "", object) }
      /^[0-9a-f]+ <.*>:$/ { name = $2; sub(/:$/, "", name) }
      function complain(what) { if (!((object, name, what) in told)) print preset ": " object " " name " " what; told[object, name, what] = 1; bad = 1 }
      preset == "host" && /[ \t]v?(add|sub|mul|div|sqrt|cvtss2|cvtsi2|ucomi|comi)[sp]?d[ \t]/ { if ($0 ~ /%xmm/) complain("computes in double") }
      preset == "host" && /[ \t]vf(n?m)(add|sub)[0-9]*[sp][sd][ \t]/ { complain("fuses multiply and add") }
      preset != "host" && /\.f64[ \t]/ { complain("computes in double") }
      # math::product_error() is one: its single rounding is the error of a product.
      preset != "host" && object !~ /^compensated_distance\.cpp/ && /[ \t]v(fma|fms|fnma|fnms)\.f32/ { complain("fuses multiply and add") }
      END { exit bad }' || bad=1
  done
  return $bad
}

copy_tree() {
  for preset in $presets; do
    mkdir -p "$1/build/$preset/firmware"
    cp "$root/build/$preset/firmware"/libfirmtouch_*.a "$1/build/$preset/firmware/"
  done
}
# plant PRESET SOURCE [FLAG...]: one more archive of one function
plant() {
  preset=$1
  source=$2
  only=$1
  shift 2
  printf '%s\n' "$source" >planted.cpp
  # shellcheck disable=SC2046
  $(tool "$preset" g++) $(flags "$preset") -std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti -ffp-contract=off \
    -fno-threadsafe-statics "$@" -c planted.cpp -o planted.o &&
    $(tool "$preset" ar) rcs "build/$preset/firmware/libfirmtouch_planted.a" planted.o
}

plant_new_on_this_machine() {
  plant host 'int* f() { return new int(3); }'
  expect='^host: libfirmtouch_planted.a:planted.o wants _Znwm'
}
plant_new_on_cortex_m7() {
  plant mps2-an500 'int* f() { return new int(3); }'
  expect='^mps2-an500: libfirmtouch_planted.a:planted.o wants _Znwj'
}
plant_sine_on_cortex_m7() {
  plant mps2-an500 'extern "C" float sinf(float); float f(float x) { return sinf(x); }' -fno-builtin
  expect='^mps2-an500: .*planted.o wants sinf'
}
plant_printf_on_cortex_m4() {
  plant netduinoplus2 'extern "C" int printf(const char*, ...); int f() { return printf("%d", 3); }' -fno-builtin
  expect='^netduinoplus2: .*planted.o wants printf'
}
plant_double_on_cortex_m7() {
  plant mps2-an500 'float f(float x) { return static_cast<float>(x * 0.1); }'
  expect='^mps2-an500: .*planted.o wants __aeabi_(f2d|d2f|dmul)'
}
plant_double_on_this_machine() {
  plant host 'float f(float x) { return static_cast<float>(x * 0.1); }'
  expect='^host: planted.o <_Z1ff> computes in double'
}
plant_static_constructor() {
  plant mps2-an500 'int g(); int value = g(); int g() { return 3 + *static_cast<volatile int*>(&value); }'
  expect='^mps2-an500: libfirmtouch_planted.a has static constructors'
}
plant_static_constructor_here() {
  plant host 'int g(); int value = g(); int g() { return 3 + *static_cast<volatile int*>(&value); }'
  expect='^host: libfirmtouch_planted.a has static constructors'
}
plant_guarded_static() {
  plant netduinoplus2 'int g(int); int f(int x) { static int value = g(x); return value; }' -fthreadsafe-statics
  expect='wants __cxa_guard_acquire'
}
plant_contraction() {
  plant netduinoplus2 'float f(float a, float b, float c) { return a * b + c; }' -ffp-contract=fast
  expect='^netduinoplus2: planted.o <_Z1ffff> fuses multiply and add'
}
plant_missing_archives() {
  only=mps2-an500
  rm build/mps2-an500/firmware/libfirmtouch_*.a
  expect='^build/mps2-an500/firmware: too few archives'
}
