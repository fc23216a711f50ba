#!/usr/bin/env bash
# Makes the .deb, unpacks it, and uses only what is in it: the program, a Python script and a CMake
# project. With --installed instead of BUILD_DIR, uses the package that is installed.
# usage: run_package.sh BUILD_DIR|--installed WORK_DIR SOURCE_DIR PYTHON
set -eu
build=$1 work=$2 source=$3 python=$4
rm -rf "$work"
mkdir -p "$work"
fail() { echo "FAILED: $*"; exit 1; }

if [ "$build" = --installed ]; then
  root=
else
  (cd "$build" && cpack -G DEB -B "$work" >"$work/cpack.log" 2>&1) || { cat "$work/cpack.log"; exit 1; }
  deb=$(echo "$work"/camber_*.deb)
  root=$work/root
  dpkg-deb -x "$deb" "$root"
  fields=$(dpkg-deb -f "$deb")
  echo "$fields"
  for needed in libc6 libtbb libfmt libocct-data-exchange libocct-foundation 'python3 (>=' python3-numpy; do
    grep -q "^Depends:.*$needed" <<<"$fields" || fail "the package does not depend on $needed"
  done
fi

for file in bin/camber include/camber/pipeline/curve.hpp lib/python3/dist-packages/camber/__init__.py \
    lib/python3/dist-packages/camber/py.typed share/doc/Camber/docs/python.md share/man/man1/camber.1 \
    share/bash-completion/completions/camber; do
  [ -f "$root/usr/$file" ] || fail "$file is not in the package"
done
[ -n "$(find "$root/usr/lib" -name CamberConfig.cmake)" ] || fail "no CMake package"
[ -n "$(find "$root/usr/lib" -name libcamber_pipeline.a)" ] || fail "no library"
[ -z "$(find "$root/usr" -path '*camber*' -name '*.pyc' -o -path '*/camber/detail/*' 2>/dev/null)" ] ||
  fail "files that nobody should get"

native=$(echo "$root"/usr/lib/python3/dist-packages/camber/_camber.*.so)
for binary in "$root/usr/bin/camber" "$native"; do
  ldd "$binary" >"$work/ldd.txt"
  ! grep "not found" "$work/ldd.txt" || fail "$binary misses libraries"
  ! readelf -d "$binary" | grep -E 'R(UN)?PATH' || fail "$binary looks for libraries in a folder of its own"
done

cd "$work"
mesh=$source/cases/wing/linear.msh cad=$source/cases/wing/body.step
"$root/usr/bin/camber" curve "$mesh" -g "$cad" -o program.msh -q
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/usr/lib/python3/dist-packages "$python" - "$mesh" "$cad" <<'PY'
import sys
import camber
result = camber.curve(camber.read(sys.argv[1]), camber.Geometry(sys.argv[2]), order=4)
result.write("python.msh")
print(camber.__file__, result)
PY
cmp program.msh python.msh || fail "program and Python write different meshes"

cmake -S "$source/tests/consumer/program" -B consumer -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$root/usr" >consumer.log
grep "^Camber_DIR:PATH=$root/usr/" consumer/CMakeCache.txt || fail "another Camber was found"
cmake --build consumer >>consumer.log
consumer/one_module
consumer/whole_library "$mesh" "$cad"
echo "the package works"
