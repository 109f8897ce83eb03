#!/bin/sh
# take_object.sh BUILD COMPILER ARGUMENT...: compiles, as a compiler launcher of CMake. An object that the build in the
# folder BUILD has made of the same file of this project is taken from there: so a test of how the library is built into
# another project does not compile the library once more.
build=$1
shift
output='' dependencies='' before=''
for argument in "$@"; do
  case $before in
    -o) output=$argument ;;
    -MF) dependencies=$argument ;;
  esac
  before=$argument
done
own=$build/${output#deliso/}
case $output in
  *deliso_*.dir/*)
    if [ -f "$own" ]; then
      cp "$own" "$output"
      if [ -n "$dependencies" ]; then printf '%s:\n' "$output" > "$dependencies"; fi
      exit 0
    fi
    ;;
esac
exec "$@"
